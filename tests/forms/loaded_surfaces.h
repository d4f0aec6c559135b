#pragma once

#include <Eigen/Geometry>

#include <geometry/sample_surfaces.h>

/// Curved surfaces in space for tests of forms.
namespace sherd::test
{

/// Elements of sample surfaces.
enum class Shape
{
  distorted,
  overloaded, ///< LR elements of more than (degree + 1)^2 functions
  rational    ///< weights that vary in both directions
};

/// The surface with every control point moved by a smooth map that bends and twists it.
template <int degree>
Surface<degree, 3> bulged(const Surface<degree, 3> &surface)
{
  std::vector<Patch<degree, 3>> patches;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      auto patch = surface.patch(p);
      for (int i = 0; i < patch.control_points.rows(); ++i)
        {
          const Eigen::RowVector3d X = patch.control_points.row(i);
          patch.control_points.row(i) += Eigen::RowVector3d(.03 * X[1] * X[1], -.02 * X[0] * X[1],
                                                            .2 * X[0] - .1 * X[0] * X[0] + .07 * X[0] * X[1]);
        }
      patches.push_back(std::move(patch));
    }
  return {std::move(patches), surface.edges()};
}

/// Surface with elements of size about 1, curved edges, curved and skew inside.
template <int degree>
Surface<degree, 3> curved_surface(Shape shape)
{
  if (shape == Shape::rational)
    {
      auto cone = quarter_turn<degree, 3>(1., 0., 3., 1.);
      refine_everywhere(cone, 1);
      auto         patch = cone.patch(0);
      std::mt19937 random(23);
      for (auto &weight : patch.weights)
        weight *= 1. + .2 * symmetric(random);
      return bulged<degree>({{std::move(patch)}, cone.edges()});
    }
  auto surface = bulged(distorted(shapes::plate<degree, 3>({4., 4.}, {4, 4}), .15));
  if (shape == Shape::overloaded)
    refine_at_random(surface, 3, 4, 73);
  return surface;
}

/// The surface with the parameters of its patches exchanged, which turns its normal over. Edges keep their names.
/// @param surface   tensor-product patches
template <int degree>
Surface<degree, 3> turned_over(const Surface<degree, 3> &surface, int n_u, int n_v)
{
  const auto      &patch = surface.patch(0);
  Patch<degree, 3> other{LRBasis<degree>(shapes::uniform_knots<degree>(n_v), shapes::uniform_knots<degree>(n_u)),
                         patch.control_points, patch.weights};
  const int        rows_u = n_u + degree, rows_v = n_v + degree;
  for (int j = 0; j < rows_v; ++j)
    for (int i = 0; i < rows_u; ++i)
      {
        other.control_points.row(i * rows_v + j) = patch.control_points.row(j * rows_u + i);
        other.weights[i * rows_v + j]            = patch.weights[j * rows_u + i];
      }
  const auto exchanged = [](Side side) {
    switch (side)
      {
      case Side::u_min:
        return Side::v_min;
      case Side::u_max:
        return Side::v_max;
      case Side::v_min:
        return Side::u_min;
      default:
        return Side::u_max;
      }
  };
  auto edges = surface.edges();
  for (auto &[name, sides] : edges)
    for (auto &edge : sides)
      edge.side = exchanged(edge.side);
  return {{std::move(other)}, std::move(edges)};
}

/// Rows of @p values that belong to @p points.
inline ControlValues<3> rows_of(const ControlValues<3> &values, const std::vector<int> &points)
{
  ControlValues<3> rows(points.size(), 3);
  for (std::size_t A = 0; A < points.size(); ++A)
    rows.row(A) = values.row(points[A]);
  return rows;
}

/// Every control value moved by up to @p amount in each direction.
inline ControlValues<3> disturbed(ControlValues<3> values, double amount, unsigned seed)
{
  std::mt19937 random(seed);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values.data()[i] += amount * symmetric(random);
  return values;
}

/// A rotation about no axis of the frame.
inline Eigen::Matrix3d rotation()
{
  return Eigen::AngleAxisd(1.1, Eigen::Vector3d(1., -2., .5).normalized()).toRotationMatrix();
}

} // namespace sherd::test
