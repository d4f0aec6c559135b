#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <sherd/base/exceptions.h>

namespace sherd
{

/// One array of numbers, row by row, or a text. An empty shape: a single value.
struct StoredArray
{
  std::vector<std::size_t>                                                  shape;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::string> values;
};

/// Arrays by name; the name is a path ("state/phase"), as in the file they go to.
class StoredArrays
{
public:
  /// @throws InvalidParameter   a name that is taken
  void add(const std::string &name, StoredArray array);

  /// @throws FileError   if there is none of this name
  const StoredArray &find(const std::string &name) const;

  bool contains(const std::string &name) const { return arrays_.count(name) > 0; }

  const std::map<std::string, StoredArray> &all() const { return arrays_; }

private:
  std::map<std::string, StoredArray> arrays_;
};

/// What a type looks like as an array, and back. A specialisation offers
///   StoredArray store(value),
///   bool        restore(array, value)   false if the array is of another kind or shape.
/// Doubles come back bitwise.
template <class T>
struct StoredType;

template <>
struct StoredType<double>
{
  static StoredArray store(double value) { return {{}, std::vector<double>{value}}; }
  static bool        restore(const StoredArray &array, double &value)
  {
    const auto *values = std::get_if<std::vector<double>>(&array.values);
    if (!values || !array.shape.empty())
      return false;
    value = values->front();
    return true;
  }
};

template <std::integral T>
struct StoredType<T>
{
  static StoredArray store(T value) { return {{}, std::vector<std::int64_t>{value}}; }
  static bool        restore(const StoredArray &array, T &value)
  {
    const auto *values = std::get_if<std::vector<std::int64_t>>(&array.values);
    if (!values || !array.shape.empty())
      return false;
    value = static_cast<T>(values->front());
    return std::int64_t(value) == values->front();
  }
};

template <>
struct StoredType<std::string>
{
  static StoredArray store(const std::string &value) { return {{}, value}; }
  static bool        restore(const StoredArray &array, std::string &value)
  {
    const auto *text = std::get_if<std::string>(&array.values);
    if (text)
      value = *text;
    return text;
  }
};

template <>
struct StoredType<std::vector<double>>
{
  static StoredArray store(const std::vector<double> &value) { return {{value.size()}, value}; }
  static bool        restore(const StoredArray &array, std::vector<double> &value)
  {
    const auto *values = std::get_if<std::vector<double>>(&array.values);
    if (!values || array.shape.size() != 1)
      return false;
    value = *values;
    return true;
  }
};

template <>
struct StoredType<std::vector<int>>
{
  static StoredArray store(const std::vector<int> &value)
  {
    return {{value.size()}, std::vector<std::int64_t>(value.begin(), value.end())};
  }
  static bool restore(const StoredArray &array, std::vector<int> &value)
  {
    const auto *values = std::get_if<std::vector<std::int64_t>>(&array.values);
    if (!values || array.shape.size() != 1)
      return false;
    value.assign(values->begin(), values->end());
    return true;
  }
};

/// Vectors and matrices: shape=(n) or (rows, columns), row by row.
template <int rows, int columns, int options>
struct StoredType<Eigen::Matrix<double, rows, columns, options>>
{
  using Matrix   = Eigen::Matrix<double, rows, columns, options>;
  using RowMajor = Eigen::Matrix<double, rows, columns, columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

  static StoredArray store(const Matrix &value)
  {
    const RowMajor           by_rows = value;
    std::vector<std::size_t> shape{static_cast<std::size_t>(value.rows())};
    if constexpr (columns != 1)
      shape.push_back(value.cols());
    return {std::move(shape), std::vector<double>(by_rows.data(), by_rows.data() + by_rows.size())};
  }
  static bool restore(const StoredArray &array, Matrix &value)
  {
    const auto *values = std::get_if<std::vector<double>>(&array.values);
    const auto &shape  = array.shape;
    if (!values || shape.size() != (columns == 1 ? 1 : 2))
      return false;
    const auto n_rows    = static_cast<Eigen::Index>(shape[0]);
    const auto n_columns = columns == 1 ? 1 : static_cast<Eigen::Index>(shape.back());
    if ((rows != Eigen::Dynamic && rows != n_rows) || (columns != Eigen::Dynamic && columns != n_columns))
      return false;
    value = Eigen::Map<const RowMajor>(values->data(), n_rows, n_columns);
    return true;
  }
};

/// Puts named values into arrays. With ArrayReader it lets one function list the members of a type for both ways:
/// @code
/// template <class Archive>
/// void exchange(Archive &archive, Totals &totals) { archive("steps", totals.steps); }
/// @endcode
class ArrayWriter
{
public:
  static constexpr bool is_reader = false;

  explicit ArrayWriter(StoredArrays &arrays, std::string group = "") : arrays_(&arrays), group_(std::move(group)) {}

  template <class T>
  void operator()(const std::string &name, const T &value)
  {
    arrays_->add(group_ + name, StoredType<T>::store(value));
  }

  /// The same below a group.
  ArrayWriter in(const std::string &group) const { return ArrayWriter(*arrays_, group_ + group + "/"); }

private:
  StoredArrays *arrays_;
  std::string   group_;
};

/// Takes named values out of arrays.
class ArrayReader
{
public:
  static constexpr bool is_reader = true;

  explicit ArrayReader(const StoredArrays &arrays, std::string group = "") : arrays_(&arrays), group_(std::move(group))
  {
  }

  /// @throws FileError   if it is missing or of another kind or shape
  template <class T>
  void operator()(const std::string &name, T &value)
  {
    if (!StoredType<T>::restore(arrays_->find(group_ + name), value))
      throw FileError(group_ + name + " is not of the kind or shape expected");
  }

  /// Whether there is a value of this name.
  bool contains(const std::string &name) const { return arrays_->contains(group_ + name); }

  ArrayReader in(const std::string &group) const { return ArrayReader(*arrays_, group_ + group + "/"); }

private:
  const StoredArrays *arrays_;
  std::string         group_;
};

} // namespace sherd
