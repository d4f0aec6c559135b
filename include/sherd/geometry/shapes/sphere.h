#pragma once

#include <Eigen/LU>

#include <sherd/geometry/join.h>
#include <sherd/geometry/shapes/sphere_patch.h>
#include <sherd/geometry/split.h>

namespace sherd::shapes
{

/// Fit::exact where the degree can do it, else Fit::rational.
template <int degree>
inline constexpr Fit best_sphere_fit = degree == 4 ? Fit::exact : Fit::rational;

namespace internal
{

/// Rotations that take the face +z of a cube to +z, -z, +x, +y, -x, -y.  theory I.1
inline std::array<Eigen::Matrix3d, 6> cube_faces()
{
  std::array<Eigen::Matrix3d, 6> faces;
  faces[0] << 1., 0., 0., 0., 1., 0., 0., 0., 1.;
  faces[1] << 1., 0., 0., 0., -1., 0., 0., 0., -1.;
  faces[2] << 0., 0., 1., 1., 0., 0., 0., 1., 0.;
  faces[3] << 0., 1., 0., 0., 0., 1., 1., 0., 0.;
  faces[4] << 0., 0., -1., 1., 0., 0., 0., -1., 0.;
  faces[5] << 0., 1., 0., 0., 0., -1., -1., 0., 0.;
  return faces;
}

/// @throws InvalidParameter   unless R^T R = 1 and det R = 1 but for rounding
inline void check_rotation(const std::string &what, const Eigen::Matrix3d &rotation)
{
  const double defect = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(defect < 1e-10))
    throw InvalidParameter(what + ": |R^T R - 1| = " + print(defect) + ", expected an orthogonal matrix");
  if (rotation.determinant() < 0.)
    throw InvalidParameter(what + ": a reflection (determinant -1), which would turn the normals inward; expected a " +
                           "rotation");
}

/// The same surface after X -> R X.
template <int degree>
Surface<degree, 3> rotated(const Surface<degree, 3> &surface, const Eigen::Matrix3d &rotation)
{
  std::vector<Patch<degree, 3>> patches;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      patches.push_back(surface.patch(p));
      patches.back().control_points = (patches.back().control_points * rotation.transpose()).eval();
    }
  return {std::move(patches), surface.edges(), surface.interfaces()};
}

} // namespace internal

/// Sphere about the origin from six equal patches, the faces of a cube seen from its centre (+z, -z, +x, +y, -x, -y),
/// each of n x n elements and joined along the twelve edges of the cube; three patches meet at each corner. Normals
/// outward. A closed surface: it has no edges.
///
/// Fit::exact (degree 4): the sphere, smooth across the interfaces. Fit::rational and Fit::smooth interpolate (theory
/// I.2): the patches meet without gaps, but the radius is in error and the normal has a kink at the interfaces, which
/// refinement afterwards keeps. The largest of both, of Fit::rational with radius 1:
///
/// |  n | radius, degree 2 | degree 3 | kink [degrees], degree 2 | degree 3 |
/// |---:|-----------------:|---------:|-------------------------:|---------:|
/// |  2 |          1.05e-3 |   9.4e-5 |                    0.563 |    0.326 |
/// |  4 |           8.2e-5 |   1.5e-5 |                    0.180 |   0.0362 |
/// |  8 |           8.6e-6 |   9.4e-7 |                    0.053 |  0.00448 |
/// | 16 |           9.4e-7 |   8.0e-8 |                   0.0142 |  0.00056 |
///
/// Take n >= 8 at degree 2. Fit::smooth at degree 2 has 13 to 27 times the radius error and 7 to 9 times the kink.
///
/// Source: theory I.1, I.2; the paper's quadratic NURBS sphere is Fit::rational or Fit::smooth at degree 2.
/// @param rotation   turns the whole, X -> R X: other places for interfaces and corners
/// @throws InvalidParameter   a radius that is not positive, less than one element, Fit::exact below degree 4, a matrix
///                            that is no rotation
template <int degree>
Surface<degree, 3> sphere(double radius, int n, Fit fit = best_sphere_fit<degree>,
                          const Eigen::Matrix3d &rotation = Eigen::Matrix3d::Identity())
{
  internal::check_rotation("sphere: rotation", rotation);
  const auto                      face = sphere_patch<degree>(radius, {n, n}, fit);
  std::vector<Surface<degree, 3>> faces;
  for (const auto &turn : internal::cube_faces())
    {
      auto patch           = face.patch(0);
      patch.control_points = (patch.control_points * turn.transpose()).eval();
      faces.push_back(Surface<degree, 3>({std::move(patch)}, {}));
    }
  return internal::rotated(join(faces), rotation);
}

/// Upper half of sphere(): the patch at the pole of n x n elements and four of n x n/2 around it, cut at the equator,
/// where their sides are the edge "equator". Radius errors and kinks as there.
/// @throws InvalidParameter   as sphere(), and an n that is not even
template <int degree>
Surface<degree, 3> hemisphere(double radius, int n, Fit fit = best_sphere_fit<degree>)
{
  if (n < 2 || n % 2 != 0)
    throw InvalidParameter("hemisphere: n = " + std::to_string(n) +
                           ", expected an even number of elements, at least 2");
  const auto                    whole = split_patches(sphere<degree>(radius, n, fit), 2, Direction::v, .5 * n);
  std::vector<Patch<degree, 3>> upper;
  std::vector<Edge>             equator;
  for (int p = 0; p < whole.n_patches(); ++p)
    {
      if (!(whole.patch(p).control_points.col(2).minCoeff() > -1e-6 * radius))
        continue;
      upper.push_back(whole.patch(p));
      const Surface<degree, 3> alone({upper.back()}, {});
      for (const Side side : {Side::u_min, Side::u_max, Side::v_min, Side::v_max})
        {
          double highest = 0.;
          for (const int i : points_along(alone, {0, side}))
            highest = std::max(highest, alone.patch(0).control_points(i, 2));
          if (highest < 1e-6 * radius)
            equator.push_back({static_cast<int>(upper.size()) - 1, side});
        }
    }
  auto interfaces = find_interfaces(upper);
  return {std::move(upper), {{"equator", std::move(equator)}}, std::move(interfaces)};
}

} // namespace sherd::shapes
