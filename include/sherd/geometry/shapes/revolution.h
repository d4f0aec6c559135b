#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/arc.h>

namespace sherd::shapes
{

/// Surface of revolution about the z axis, X = (r cos(azimuth), r sin(azimuth), z).
///
/// u runs with the azimuth, v along the profile, elements likewise; a profile that rises on the outside has its normal
/// A_1 x A_2 outward. Edges "left", "right" (azimuth at its begin, end) and those of @p profile_begin and
/// @p profile_end. At a full turn left and right lie on each other but are not joined: the surface has a slit.
/// @param profile   t in [0, 1] -> (w r, w z, w), w > 0 and r > 0
/// @throws InvalidParameter   less than one element, an azimuth that does not fit
template <int degree, class Profile>
Surface<degree, 3> revolution(const std::string &shape, const Profile &profile, const std::array<double, 2> &azimuth,
                              const std::array<int, 2> &elements, Fit fit, const std::string &profile_begin = "bottom",
                              const std::string &profile_end = "top")
{
  internal::check_elements(shape, elements);
  const internal::Arc ring(shape + ": azimuth", azimuth, fit);
  return interpolate<degree, 3>(
      uniform_knots<degree>(elements[0]), uniform_knots<degree>(elements[1]),
      [&](double u, double v) -> Eigen::Vector4d {
        const Eigen::Vector3d c = ring(u / elements[0]), p = profile(v / elements[1]);
        return {p[0] * c[0], p[0] * c[1], p[1] * c[2], p[2] * c[2]};
      },
      name_sides("left", "right", profile_begin, profile_end));
}

/// Upper half of a sphere about the origin with a hole about the pole, or a part of it.
///
/// u runs with the azimuth about the z axis, v from the equator up to the hole; normal outward. Edges "equator",
/// "hole", and the meridians "left", "right" (azimuth at its begin, end), not joined at a full turn.
/// @param hole_angle   of the hole's rim at the centre, measured from the z axis [rad]; between 0 and 90 degrees
/// @param azimuth      begin and end [rad], at most a full turn; less than half a turn unless Fit::smooth
/// @throws InvalidParameter   a radius that is not positive, less than one element, angles that do not fit
template <int degree>
Surface<degree, 3> hemisphere_with_hole(double radius, double hole_angle, const std::array<double, 2> &azimuth,
                                        const std::array<int, 2> &elements, Fit fit = Fit::exact)
{
  internal::check_length("hemisphere_with_hole: radius", radius);
  if (!(hole_angle > 0. && hole_angle < .5 * M_PI))
    throw InvalidParameter("hemisphere_with_hole: hole_angle = " + print(hole_angle) +
                           ", expected more than 0 and less than pi/2");
  const internal::Arc meridian("hemisphere_with_hole: latitude", {0., .5 * M_PI - hole_angle}, fit);
  return revolution<degree>(
      "hemisphere_with_hole",
      [&](double t) -> Eigen::Vector3d {
        const auto c = meridian(t);
        return {radius * c[0], radius * c[1], c[2]};
      },
      azimuth, elements, fit, "equator", "hole");
}

/// Torus about the z axis or a part of it, X = ((R + r cos(b)) cos(a), (R + r cos(b)) sin(a), r sin(b)).
///
/// u runs with the azimuth a about the z axis, v with the angle b about the centre line of the tube, 0 on the outside
/// and 90 degrees on top; normal outward. Edges "left", "right" (a at its begin, end) and "bottom", "top" (b at its
/// begin, end), not joined where a full turn makes them meet.
/// @param ring_radius   R, of the centre line
/// @param tube_radius   r < R
/// @param azimuth       range of a [rad], at most a full turn; less than half a turn unless Fit::smooth
/// @param tube_angles   range of b, likewise
/// @throws InvalidParameter   not 0 < r < R, less than one element, angles that do not fit
template <int degree>
Surface<degree, 3> torus(double ring_radius, double tube_radius, const std::array<double, 2> &azimuth,
                         const std::array<double, 2> &tube_angles, const std::array<int, 2> &elements,
                         Fit fit = Fit::exact)
{
  internal::check_length("torus: ring_radius", ring_radius);
  internal::check_length("torus: tube_radius", tube_radius);
  if (!(tube_radius < ring_radius))
    throw InvalidParameter("torus: tube_radius = " + print(tube_radius) +
                           ", expected less than ring_radius = " + print(ring_radius));
  const internal::Arc tube("torus: tube_angles", tube_angles, fit);
  return revolution<degree>(
      "torus",
      [&](double t) -> Eigen::Vector3d {
        const auto c = tube(t);
        return {ring_radius * c[2] + tube_radius * c[0], tube_radius * c[1], c[2]};
      },
      azimuth, elements, fit);
}

/// Hyperboloid of one sheet about the z axis or a part of it, (x^2 + y^2) / waist_radius^2 - z^2 / shape^2 = 1 with
/// z in [-height/2, height/2]; the radius grows like |z| waist_radius / shape far from the waist.
///
/// u runs with the azimuth, v upwards; normal outward. Edges "left", "right" (azimuth at its begin, end), not joined at
/// a full turn, and "bottom", "top" (z at its minimum, maximum).
/// @param azimuth   begin and end [rad], at most a full turn; less than half a turn unless Fit::smooth
/// @throws InvalidParameter   lengths that are not positive, less than one element, angles that do not fit
template <int degree>
Surface<degree, 3> hyperboloid(double waist_radius, double shape, double height, const std::array<double, 2> &azimuth,
                               const std::array<int, 2> &elements, Fit fit = Fit::exact)
{
  internal::check_length("hyperboloid: waist_radius", waist_radius);
  internal::check_length("hyperboloid: shape", shape);
  internal::check_length("hyperboloid: height", height);
  // Rational: r = a cosh(s), z = c sinh(s) in terms of tanh(s/2), the quadratic arc that is symmetric about the waist.
  const double end = std::tanh(.5 * std::asinh(.5 * height / shape));
  return revolution<degree>(
      "hyperboloid",
      [&](double t) -> Eigen::Vector3d {
        if (fit == Fit::smooth)
          {
            const double z = (t - .5) * height;
            return {waist_radius * std::hypot(1., z / shape), z, 1.};
          }
        const double tau = (2. * t - 1.) * end;
        return {waist_radius * (1. + tau * tau), 2. * shape * tau, 1. - tau * tau};
      },
      azimuth, elements, fit);
}

} // namespace sherd::shapes
