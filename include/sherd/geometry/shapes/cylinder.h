#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/arc.h>

namespace sherd::shapes
{

/// Cylinder about the x axis or a part of it, X = (x, radius sin(angle), radius cos(angle)) with x in [0, length]: a
/// plate over the xy plane rolled about the axis, at angle 0 on top.
///
/// u runs along the axis, v with the angle, elements likewise; the normal A_1 x A_2 points outward. Edges "left",
/// "right" (x = 0, length) and "bottom", "top" (angle at its begin, end). At a full turn these two lie on each other
/// but are not joined: the surface has a slit.
/// @param angles   begin and end [rad], at most a full turn; less than half a turn unless Fit::smooth
/// @throws InvalidParameter   lengths that are not positive, less than one element, angles that do not fit
template <int degree>
Surface<degree, 3> cylinder(double radius, double length, const std::array<double, 2> &angles,
                            const std::array<int, 2> &elements, Fit fit = Fit::exact)
{
  internal::check_length("cylinder: radius", radius);
  internal::check_length("cylinder: length", length);
  internal::check_elements("cylinder", elements);
  const internal::Arc arc("cylinder: angles", angles, fit);
  return interpolate<degree, 3>(uniform_knots<degree>(elements[0]), uniform_knots<degree>(elements[1]),
                                [&](double u, double v) -> Eigen::Vector4d {
                                  const auto   c = arc(v / elements[1]);
                                  const double x = u / elements[0] * length;
                                  return {x * c[2], radius * c[1], radius * c[0], c[2]};
                                });
}

/// Which part of a shape with two planes of symmetry.
enum class Part
{
  whole,
  quarter
};

/// Cylindrical (Scordelis-Lo) roof: its axis is the x axis, z points up, the opening is symmetric about the plane
/// y = 0; X = (x, radius sin(angle), radius cos(angle)), normal upward.
///
/// Whole: x in [0, length], angle in [-half_angle, half_angle]; edges "left", "right": the curved ends x = 0, length;
/// "bottom", "top": the straight sides y < 0, y > 0. Quarter: x in [0, length/2], angle in [0, half_angle]; "left" is
/// the curved end, "top" the straight side, and "right" (x = length/2) and "bottom" (y = 0) lie on the planes of
/// symmetry. @p elements count those of the part, along x and along the arc.
/// @param half_angle   [rad]; below 90 degrees, or 180 with Fit::smooth
/// @throws InvalidParameter   lengths that are not positive, less than one element, an angle that does not fit
template <int degree>
Surface<degree, 3> roof(double radius, double length, double half_angle, const std::array<int, 2> &elements,
                        Fit fit = Fit::exact, Part part = Part::whole)
{
  const double limit = fit == Fit::smooth ? M_PI : .5 * M_PI;
  if (!(half_angle > 0. && half_angle < limit))
    throw InvalidParameter("roof: half_angle = " + print(half_angle) + ", expected more than 0 and less than " +
                           (fit == Fit::smooth ? "pi" : "pi/2 (rational; less than pi with Fit::smooth)"));
  return part == Part::whole ? cylinder<degree>(radius, length, {-half_angle, half_angle}, elements, fit)
                             : cylinder<degree>(radius, .5 * length, {0., half_angle}, elements, fit);
}

} // namespace sherd::shapes
