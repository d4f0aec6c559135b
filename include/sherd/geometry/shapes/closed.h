#pragma once

#include <sherd/geometry/join.h>
#include <sherd/geometry/shapes/cylinder.h>
#include <sherd/geometry/shapes/revolution.h>

namespace sherd::shapes
{

namespace internal
{

/// Begin and end of part @p k of @p n equal parts of a full turn [rad]; equal angles are equal numbers.
inline std::array<double, 2> part_of_turn(int k, int n)
{
  return {2. * M_PI * k / n, 2. * M_PI * (k + 1) / n};
}

/// @throws InvalidParameter   too few patches for the arcs of @p fit
inline void check_arcs(const std::string &what, int n_arcs, Fit fit)
{
  const int least = fit == Fit::smooth ? 1 : 3;
  if (n_arcs < least)
    throw InvalidParameter(what + " = " + std::to_string(n_arcs) + ", expected at least " + std::to_string(least) +
                           (fit == Fit::smooth ? "" : ", so that a rational arc stays below 180 degrees"));
}

} // namespace internal

/// Whole cylinder about the x axis from @p patches equal arcs, joined along the straight lines between them: X =
/// (x, radius sin(angle), radius cos(angle)) with x in [0, length], the first arc begins on top. A circle of one knot
/// vector has C0 lines inside; here these lines are interfaces, and inside the patches all is smooth.
///
/// u runs along the axis, v with the angle; the normal points outward. Edges "left", "right" (x = 0, length).
/// @param elements   of each patch, along the axis and along its arc
/// @param patches    at least 3; Fit::smooth takes one or two too (the seam of one patch is joined to itself)
/// @throws InvalidParameter   lengths that are not positive, less than one element, too few patches
template <int degree>
Surface<degree, 3> closed_cylinder(double radius, double length, int patches, const std::array<int, 2> &elements,
                                   Fit fit = Fit::exact)
{
  internal::check_arcs("closed_cylinder: patches", patches, fit);
  std::vector<Surface<degree, 3>> arcs;
  for (int k = 0; k < patches; ++k)
    arcs.push_back(cylinder<degree>(radius, length, internal::part_of_turn(k, patches), elements, fit));
  return join(arcs);
}

/// Whole torus about the z axis (torus()) from patches[0] x patches[1] equal patches, joined along the circles between
/// them; without edges. u runs with the azimuth, v with the angle about the centre line of the tube, normal outward.
/// @param patches    along the azimuth and around the tube, at least 3 each; Fit::smooth takes one or two too
/// @param elements   of each patch, likewise
/// @throws InvalidParameter   not 0 < tube_radius < ring_radius, less than one element, too few patches
template <int degree>
Surface<degree, 3> closed_torus(double ring_radius, double tube_radius, const std::array<int, 2> &patches,
                                const std::array<int, 2> &elements, Fit fit = Fit::exact)
{
  for (int d = 0; d < 2; ++d)
    internal::check_arcs("closed_torus: patches[" + std::to_string(d) + "]", patches[d], fit);
  std::vector<Surface<degree, 3>> parts;
  for (int j = 0; j < patches[1]; ++j)
    for (int i = 0; i < patches[0]; ++i)
      parts.push_back(torus<degree>(ring_radius, tube_radius, internal::part_of_turn(i, patches[0]),
                                    internal::part_of_turn(j, patches[1]), elements, fit));
  return join(parts);
}

} // namespace sherd::shapes
