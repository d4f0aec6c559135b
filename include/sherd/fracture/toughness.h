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
}

/// Fracture toughness Gc [energy/length] as a field on the reference surface: a constant or a function of position.
///
/// Every value is checked where it is taken. Meant to be evaluated once at each quadrature point, not in kernels, and
/// by one thread at a time if the function it was made from asks for that (Formula does).
template <int spacedim>
class Toughness
{
public:
  /// @throws InvalidParameter  unless @p constant is positive and finite.
  Toughness(const double constant) : field_([constant](const Point<spacedim> &) { return constant; })
  {
    if (!is_valid(constant))
      throw InvalidParameter("fracture toughness " + print(constant) + " must be positive and finite");
  }

  /// @param field  Gc(X), a function of the reference position.
  template <std::invocable<const Point<spacedim> &> Field>
  requires(!std::same_as<std::remove_cvref_t<Field>, Toughness>) Toughness(Field &&field)
      : field_(std::forward<Field>(field))
  {
  }

  /// @param field  Gc(x, y) or Gc(x, y, z), a function or formula of the coordinates of X.
  template <class Field>
  requires(!std::invocable<Field, const Point<spacedim> &> && internal::FunctionOfCoordinates<Field, spacedim>)
      Toughness(Field &&field)
      : field_([field = std::forward<Field>(field)](const Point<spacedim> &X) {
          if constexpr (spacedim == 2)
            return field(X[0], X[1]);
          else
            return field(X[0], X[1], X[2]);
        })
  {
  }

  /// Gc at the reference position X.
  /// @throws InvalidParameter  naming the position, unless the value is positive and finite.
  double operator()(const Point<spacedim> &X) const
  {
    const double value = field_(X);
    if (!is_valid(value))
      {
        std::string position = print(X[0]);
        for (int i = 1; i < spacedim; ++i)
          position += ", " + print(X[i]);
        throw InvalidParameter("fracture toughness " + print(value) + " at X = (" + position +
                               ") must be positive and finite");
      }
    return value;
  }

private:
  static bool is_valid(const double value) { return std::isfinite(value) && value > 0.; }

  std::function<double(const Point<spacedim> &)> field_;
};

} // namespace sherd
