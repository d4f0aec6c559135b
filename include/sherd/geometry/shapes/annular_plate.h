#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/arc.h>

namespace sherd::shapes
{

/// Flat annulus about the origin or a part of it, X = r (cos(angle), sin(angle)) (z = 0), r in [inner, outer].
///
/// u runs along the radius, v with the angle, elements likewise; the normal is the z axis. Edges "inner", "outer" (the
/// radii) and "begin", "end" (the angles). At a full turn these two lie on each other but are not joined: the plate has
/// a slit.
/// @param angles   begin and end [rad], at most a full turn; less than half a turn unless Fit::smooth
/// @throws InvalidParameter   not 0 < inner < outer, less than one element, angles that do not fit
template <int degree, int spacedim = 3>
Surface<degree, spacedim> annular_plate(double inner, double outer, const std::array<double, 2> &angles,
                                        const std::array<int, 2> &elements, Fit fit = Fit::exact)
{
  internal::check_length("annular_plate: inner", inner);
  internal::check_length("annular_plate: outer", outer);
  if (!(inner < outer))
    throw InvalidParameter("annular_plate: inner = " + print(inner) + ", outer = " + print(outer) +
                           ", expected inner < outer");
  internal::check_elements("annular_plate", elements);
  const internal::Arc arc("annular_plate: angles", angles, fit);
  return interpolate<degree, spacedim>(
      uniform_knots<degree>(elements[0]), uniform_knots<degree>(elements[1]),
      [&](double u, double v) -> Point<spacedim + 1> {
        const auto          c = arc(v / elements[1]);
        const double        r = inner + u / elements[0] * (outer - inner);
        Point<spacedim + 1> X = Point<spacedim + 1>::Zero();
        X[0]                  = r * c[0];
        X[1]                  = r * c[1];
        X[spacedim]           = c[2];
        return X;
      },
      name_sides("inner", "outer", "begin", "end"));
}

} // namespace sherd::shapes
