#include <sherd/base/print.h>

#include <array>
#include <charconv>

namespace sherd
{
namespace
{

std::string_view without_blanks(std::string_view text)
{
  const auto first = text.find_first_not_of(" \t");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <class Number>
std::optional<Number> parse(std::string_view text)
{
  text = without_blanks(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  Number     value{};
  const auto end            = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (text.empty() || status != std::errc() || stop != end)
    return std::nullopt;
  return value;
}

} // namespace

std::string print(double value)
{
  std::array<char, 32> text;
  const auto           end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::optional<double> parse_double(std::string_view text)
{
  // YAML writes infinity as .inf.
  std::string number(without_blanks(text));
  const auto  digits = number.find_first_not_of("+-");
  if (digits != number.npos && number.compare(digits, std::string::npos, ".inf") == 0)
    number.erase(digits, 1);
  return parse<double>(number);
}

std::optional<int> parse_int(std::string_view text)
{
  return parse<int>(text);
}

} // namespace sherd
