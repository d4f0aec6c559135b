#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/base/types.h>

#include <cmath>
#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

namespace sherd
{

namespace internal
{
template <class Field, int spacedim>
concept FunctionOfCoordinates = (spacedim == 2 && std::invocable<Field, double, double>) ||
                                (spacedim == 3 && std::invocable<Field, double, double, double>);

/// Whether a field can be made from it: a function of the position X or of its coordinates.
template <class Field, int spacedim>
concept FunctionOfPosition = std::invocable < Field,
        const Point<spacedim>
& > || FunctionOfCoordinates<Field, spacedim>;
} // namespace internal

/// A positive quantity on the reference surface: a constant or a function of position.
///
/// Every value is checked where it is taken. Meant to be evaluated once at each quadrature point, not in kernels, and
/// by one thread at a time if the function it was made from asks for that (Formula does).
template <int spacedim>
class PositiveField
{
public:
  /// @param name  of the quantity, for messages.
  /// @throws InvalidParameter  unless @p constant is positive and finite.
  PositiveField(const std::string &name, const double constant)
      : name_(name), field_([constant](const Point<spacedim> &) { return constant; })
  {
    if (!is_valid(constant))
      throw InvalidParameter(name + ' ' + print(constant) + " must be positive and finite");
  }

  /// @param field  a function of the reference position X, or a function or formula of its coordinates (x, y) or
  ///               (x, y, z).
  template <internal::FunctionOfPosition<spacedim> Field>
  PositiveField(const std::string &name, Field &&field) : name_(name)
  {
    if constexpr (std::invocable<Field, const Point<spacedim> &>)
      field_ = std::forward<Field>(field);
    else
      field_ = [field = std::forward<Field>(field)](const Point<spacedim> &X) {
        if constexpr (spacedim == 2)
          return field(X[0], X[1]);
        else
          return field(X[0], X[1], X[2]);
      };
  }

  /// Value at the reference position X.
  /// @throws InvalidParameter  naming the position, unless the value is positive and finite.
  double operator()(const Point<spacedim> &X) const
  {
    const double value = field_(X);
    if (!is_valid(value))
      {
        std::string position = print(X[0]);
        for (int i = 1; i < spacedim; ++i)
          position += ", " + print(X[i]);
        throw InvalidParameter(name_ + ' ' + print(value) + " at X = (" + position + ") must be positive and finite");
      }
    return value;
  }

private:
  static bool is_valid(const double value) { return std::isfinite(value) && value > 0.; }

  std::string                                    name_;
  std::function<double(const Point<spacedim> &)> field_;
};

} // namespace sherd
