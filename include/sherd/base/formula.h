#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// Functions that a user writes as text.
namespace sherd
{

/// A real function of named variables given as text, for example Formula("0.1 * sin(2 * pi * t) * x", {"x", "t"}).
///
/// Operators + - * / ^ < <= > >= == != && || and `condition ? a : b`; functions sin, cos, tan, asin, acos, atan, atan2,
/// sinh, cosh, tanh, exp, ln, log10, sqrt, abs, sign, rint, min, max and others of muParser 2; the constants pi and e.
///
/// Copies are independent. An object must not be evaluated by two threads at a time; give each thread its copy.
class Formula
{
public:
  /// @throws InvalidParameter  if @p expression is no single formula of @p variables; the message says where, or if a
  ///                           variable's name is not a new name of letters, digits and underscores.
  Formula(std::string expression, std::vector<std::string> variables);
  /// A constant.
  explicit Formula(double value);

  Formula(const Formula &other);
  Formula(Formula &&) noexcept;
  Formula &operator=(const Formula &other);
  Formula &operator=(Formula &&) noexcept;
  ~Formula();

  /// The value at @p arguments, one for each variable in their order.
  /// @throws DimensionMismatch  for another number of arguments,
  /// @throws InvalidParameter   if the value is not finite; the message holds the arguments.
  double evaluate(std::span<const double> arguments) const;

  /// The same with arguments one by one: f(x, y, t).
  template <std::convertible_to<double>... Arguments>
  double operator()(Arguments... arguments) const
  {
    const double values[] = {static_cast<double>(arguments)..., 0.};
    return evaluate({values, sizeof...(Arguments)});
  }

  const std::string              &expression() const { return expression_; }
  const std::vector<std::string> &variables() const { return variables_; }

private:
  struct Evaluator;

  std::string                expression_;
  std::vector<std::string>   variables_;
  std::unique_ptr<Evaluator> evaluator_;
};

} // namespace sherd
