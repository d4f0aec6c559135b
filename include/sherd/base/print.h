#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Numbers as text, independent of the locale.
namespace sherd
{

/// The shortest decimal text that reads back bitwise equal ("0.1", "1e-06", "inf", "nan").
std::string print(double value);

/// The number that is the whole of @p text (blanks around it and a leading '+' allowed; "inf", ".inf" and "nan" are
/// numbers), nothing if it is none or out of the range of double.
std::optional<double> parse_double(std::string_view text);

/// The whole number that is all of @p text, nothing if it is none ("2.0" and "1e3" are none) or out of range.
std::optional<int> parse_int(std::string_view text);

} // namespace sherd
