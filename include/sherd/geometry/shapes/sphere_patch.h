#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/arc.h>

namespace sherd::shapes
{

/// Face +z of the unit sphere cut along the projected edges of a cube, over [0, 1]^2: (w x, w y, w z, w), polynomials
/// of degree 4 in s and in t, corners (-1, -1, 1)/sqrt(3) at (0, 0) to (1, 1, 1)/sqrt(3) at (1, 1) with w = 1; the
/// sides are arcs of great circles.
///
/// In the stereographic projection from the south pole, (X, Y) = (x, y)/(1 + z), the sides are arcs of circles, and the
/// face is the biquadratic Coons patch of its homogeneous sides; the lift back to the sphere is
/// (2 X W, 2 Y W, W^2 - X^2 - Y^2, W^2 + X^2 + Y^2).
///
/// Source: theory I.1.
inline Eigen::Vector4d sphere_face(double s, double t)
{
  const double corner = .5 * (std::sqrt(3.) - 1.);             // of the projection
  const double cosine = .25 * (std::sqrt(6.) + std::sqrt(2.)); // of 15 degrees, half the opening of a side
  const double middle = (2. * std::sqrt(3.) - 3.) * cosine;    // w times the distance of its middle control point
  const double a[]    = {(1. - s) * (1. - s), 2. * s * (1. - s), s * s};
  const double b[]    = {(1. - t) * (1. - t), 2. * t * (1. - t), t * t};
  const double X      = (a[2] - a[0]) * (corner * (b[0] + b[2]) + middle * b[1]);
  const double Y      = (b[2] - b[0]) * (corner * (a[0] + a[2]) + middle * a[1]);
  const double W      = (a[0] + a[2]) * (b[0] + b[2]) + cosine * (a[1] * (b[0] + b[2]) + (a[0] + a[2]) * b[1]) +
                   (2. * cosine - 1.) * a[1] * b[1];
  return Eigen::Vector4d(2. * X * W, 2. * Y * W, W * W - X * X - Y * Y, W * W + X * X + Y * Y) / (3. - std::sqrt(3.));
}

/// One of six equal patches of a sphere about the origin: the part around the z axis that a cube's upper face covers,
/// seen from the centre. The other five are rotations of it.
///
/// u runs along x, v along y, elements likewise; normal outward. Edges "left", "right" (the arcs in the planes z = -x,
/// z = x) and "bottom", "top" (z = -y, z = y). Fit::exact needs degree 4; Fit::rational is the same at degree 4 and of
/// order degree + 1 below, with a hundredth to a tenth of the radius error of Fit::smooth.
///
/// Source: theory I.1, I.2.
/// @throws InvalidParameter   a radius that is not positive, less than one element, Fit::exact below degree 4
template <int degree>
Surface<degree, 3> sphere_patch(double radius, const std::array<int, 2> &elements, Fit fit)
{
  internal::check_length("sphere_patch: radius", radius);
  internal::check_elements("sphere_patch", elements);
  if (fit == Fit::exact && degree < 4)
    throw InvalidParameter("sphere_patch: Fit::exact at degree " + std::to_string(degree) +
                           ", expected degree 4; use Fit::rational or Fit::smooth");
  return interpolate<degree, 3>(uniform_knots<degree>(elements[0]), uniform_knots<degree>(elements[1]),
                                [&](double u, double v) -> Eigen::Vector4d {
                                  Eigen::Vector4d X = sphere_face(u / elements[0], v / elements[1]);
                                  if (fit == Fit::smooth)
                                    X /= X[3];
                                  X.head<3>() *= radius;
                                  return X;
                                });
}

} // namespace sherd::shapes
