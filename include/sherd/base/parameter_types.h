#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sherd/base/exceptions.h>
#include <sherd/base/formula.h>
#include <sherd/base/print.h>
#include <sherd/base/range.h>
#include <sherd/base/types.h>

/// How the types of parameters are written and read.
namespace sherd
{

/// A value as text: one word, or a list of values.
struct ParameterText
{
  std::string                word;
  std::vector<ParameterText> items;
  bool                       is_list = false;
};

/// Text of values of type T. A specialisation offers
///   describe(example, range)   what is allowed, in words; `example` has the variables of formulas,
///   write(value)               the text that read() turns into an equal value (numbers bitwise),
///   read(text, range, value)   assigns what the text says; false, with value in any state, if it is not allowed.
template <class T>
struct ParameterType;

template <>
struct ParameterType<bool>
{
  static std::string   describe(bool, const Range &) { return "true or false"; }
  static ParameterText write(bool value) { return {value ? "true" : "false", {}}; }
  static bool          read(const ParameterText &text, const Range &, bool &value)
  {
    value = text.word == "true";
    return !text.is_list && (value || text.word == "false");
  }
};

template <>
struct ParameterType<int>
{
  static std::string   describe(int, const Range &range) { return "a whole number in " + range.text(); }
  static ParameterText write(int value) { return {std::to_string(value), {}}; }
  static bool          read(const ParameterText &text, const Range &range, int &value)
  {
    const auto number = parse_int(text.word);
    value             = number.value_or(0);
    return !text.is_list && number && range.contains(value);
  }
};

template <>
struct ParameterType<double>
{
  static std::string   describe(double, const Range &range) { return "a value in " + range.text(); }
  static ParameterText write(double value);
  static bool          read(const ParameterText &text, const Range &range, double &value)
  {
    const auto number = parse_double(text.word);
    value             = number.value_or(0.);
    return !text.is_list && number && range.contains(value);
  }
};

template <>
struct ParameterType<std::string>
{
  static std::string   describe(const std::string &, const Range &) { return "a text"; }
  static ParameterText write(const std::string &value) { return {value, {}}; }
  static bool          read(const ParameterText &text, const Range &, std::string &value)
  {
    value = text.word;
    return !text.is_list;
  }
};

/// The text is a new expression of the variables the value already has.
template <>
struct ParameterType<Formula>
{
  static std::string   describe(const Formula &example, const Range &);
  static ParameterText write(const Formula &value) { return {value.expression(), {}}; }
  static bool          read(const ParameterText &text, const Range &, Formula &value)
  {
    if (text.is_list)
      return false;
    value = Formula(text.word, value.variables());
    return true;
  }
};

/// A value or the word none.
template <class T>
struct ParameterType<std::optional<T>>
{
  static std::string describe(const std::optional<T> &example, const Range &range)
  {
    return ParameterType<T>::describe(example.value_or(T{}), range) + " or none";
  }
  static ParameterText write(const std::optional<T> &value)
  {
    return value ? ParameterType<T>::write(*value) : ParameterText{"none", {}};
  }
  static bool read(const ParameterText &text, const Range &range, std::optional<T> &value)
  {
    if (!text.is_list && text.word == "none")
      {
        value.reset();
        return true;
      }
    T          inner{};
    const bool allowed = ParameterType<T>::read(text, range, inner);
    value              = std::move(inner);
    return allowed;
  }
};

/// Lists of given length: what std::array and Point share.
template <class List, class T, int n>
struct FixedListType
{
  static std::string describe(const List &example, const Range &range)
  {
    return "a list of " + std::to_string(n) + ", each " + ParameterType<T>::describe(example[0], range);
  }
  static ParameterText write(const List &value)
  {
    ParameterText text{"", {}, true};
    for (int i = 0; i < n; ++i)
      text.items.push_back(ParameterType<T>::write(value[i]));
    return text;
  }
  static bool read(const ParameterText &text, const Range &range, List &value)
  {
    bool allowed = text.is_list && text.items.size() == n;
    for (int i = 0; allowed && i < n; ++i)
      allowed = ParameterType<T>::read(text.items[i], range, value[i]);
    return allowed;
  }
};

template <class T, std::size_t n>
struct ParameterType<std::array<T, n>> : FixedListType<std::array<T, n>, T, static_cast<int>(n)>
{
};

template <int n>
struct ParameterType<Eigen::Matrix<double, n, 1>> : FixedListType<Eigen::Matrix<double, n, 1>, double, n>
{
};

/// A list of any length; of points for polylines.
template <class T>
struct ParameterType<std::vector<T>>
{
  static std::string describe(const std::vector<T> &, const Range &range)
  {
    return "a list, each item " + ParameterType<T>::describe(example(), range);
  }
  static ParameterText write(const std::vector<T> &value)
  {
    ParameterText text{"", {}, true};
    for (const auto &item : value)
      text.items.push_back(ParameterType<T>::write(item));
    return text;
  }
  static bool read(const ParameterText &text, const Range &range, std::vector<T> &value)
  {
    value.assign(text.items.size(), example());
    bool allowed = text.is_list;
    for (std::size_t i = 0; allowed && i < value.size(); ++i)
      allowed = ParameterType<T>::read(text.items[i], range, value[i]);
    return allowed;
  }

private:
  static T example()
  {
    if constexpr (requires { T::Zero(); })
      return T::Zero();
    else
      return T{};
  }
};

} // namespace sherd
