#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/checks.h>

namespace sherd::shapes
{

/// Flat regular polygon about the origin from one patch a corner, all of which meet at the centre: 3, 5 or more patches
/// around a point. Each patch is bilinear between centre, middle of a side, corner, middle of the next side, with n x n
/// elements; normal upward (z = 0). The outline is the edge "outer".
/// @param radius   of the circle through the corners, the first of which lies on the x axis
/// @param sides    at least 3
/// @throws InvalidParameter   a radius that is not positive, less than 3 sides, less than one element
template <int degree, int spacedim = 3>
Surface<degree, spacedim> polygon(double radius, int sides, int n)
{
  internal::check_length("polygon: radius", radius);
  internal::check_elements("polygon", {n, n});
  if (sides < 3)
    throw InvalidParameter("polygon: sides = " + std::to_string(sides) + ", expected at least 3");
  const auto corner = [&](int k) {
    const double    angle = 2. * M_PI * (k % sides) / sides;
    Point<spacedim> X     = Point<spacedim>::Zero();
    X[0]                  = radius * std::cos(angle);
    X[1]                  = radius * std::sin(angle);
    return X;
  };
  std::vector<Patch<degree, spacedim>> patches;
  std::vector<Interface>               interfaces;
  std::vector<Edge>                    outer;
  for (int k = 0; k < sides; ++k)
    {
      const Point<spacedim> before = .5 * (corner(k + sides - 1) + corner(k)), after = .5 * (corner(k) + corner(k + 1));
      patches.push_back(interpolate<degree, spacedim>(uniform_knots<degree>(n), uniform_knots<degree>(n),
                                                      [&](double u, double v) -> Point<spacedim> {
                                                        const double s = u / n, t = v / n;
                                                        return s * (1. - t) * before + s * t * corner(k) +
                                                               (1. - s) * t * after;
                                                      })
                            .patch(0));
      interfaces.push_back({{k, Side::u_min}, {(k + 1) % sides, Side::v_min}, false});
      outer.push_back({k, Side::u_max});
      outer.push_back({k, Side::v_max});
    }
  return {std::move(patches), {{"outer", std::move(outer)}}, std::move(interfaces)};
}

} // namespace sherd::shapes
