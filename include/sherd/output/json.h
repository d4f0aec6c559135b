#pragma once

#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sherd
{

/// Text of a value in JSON. Numbers read back exactly; those that are not finite become null, as JSON has none.
std::string json(double value);
std::string json(bool value);
std::string json(std::string_view text);
template <std::integral Integer>
requires(!std::same_as<Integer, bool>) std::string json(Integer value)
{
  return std::to_string(value);
}
inline std::string json(const char *text)
{
  return json(std::string_view(text));
}

/// A JSON object that keeps the order of its members; values are numbers, truth values, strings, lists or objects.
/// @code
/// JsonObject().add("steps", 120).add("wall", JsonObject().add("assembly", 1.5)).add("tips", std::vector{1., 2.})
/// @endcode
class JsonObject
{
public:
  /// Appends a member. @throws InvalidParameter   if there is one of this name already
  template <class Value>
  JsonObject &add(const std::string &name, const Value &value)
  {
    insert(name, text_of(value));
    return *this;
  }

  /// Indented text, without a line end behind it.
  std::string text() const;

private:
  static std::string text_of(const JsonObject &object) { return object.text(); }

  template <class Value>
  static std::string text_of(const std::vector<Value> &list)
  {
    std::string result;
    for (const auto &value : list)
      result += (result.empty() ? "" : ", ") + text_of(value);
    return "[" + result + "]";
  }

  template <class Value>
  static std::string text_of(const Value &value)
  {
    return json(value);
  }

  void insert(const std::string &name, std::string value);

  std::vector<std::pair<std::string, std::string>> members_;
};

/// Writes DIR/summary.json, replacing it in one step. @throws FileError   if it cannot be written
void write_summary(const std::filesystem::path &directory, const JsonObject &summary);

} // namespace sherd
