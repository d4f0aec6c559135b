#pragma once

#include <cmath>

#include <sherd/geometry/shapes.h>
#include <sherd/state/snapshot.h>

namespace test
{

/// A quarter of a cylinder of radius 1 and length 1 as one exact quadratic NURBS patch.
inline sherd::Surface<2, 3> quarter_cylinder()
{
  using namespace sherd;
  const std::vector<double> knots{0., 0., 0., 1., 1., 1.};
  LRBasis<2>                basis(knots, knots);
  ControlValues<3>          points(9, 3);
  Eigen::VectorXd           weights(9);
  const double              x[] = {1., 1., 0.}, y[] = {0., 1., 1.};
  for (int i = 0; i < 9; ++i)
    {
      // Greville abscissae 0, 1/2, 1 in both directions.
      const auto &k = basis.function(i).knots;
      const int   a = static_cast<int>(std::lround(k[0][1] + k[0][2])),
                b   = static_cast<int>(std::lround(k[1][1] + k[1][2]));
      points.row(i) << x[a], y[a], 0.5 * b;
      weights[i] = a == 1 ? std::sqrt(0.5) : 1.;
    }
  return {{Patch<2, 3>{std::move(basis), std::move(points), std::move(weights)}}, {}};
}

/// The same with its functions near (u, v) = (0, 0) refined twice.
inline sherd::Surface<2, 3> refined_quarter_cylinder()
{
  auto surface = quarter_cylinder();
  surface.refine({0, 1, 2, 3, 4, 5, 6, 7, 8}, sherd::SpanTarget{{0.5, 0.5}});
  std::vector<int> near;
  const auto      &basis = surface.patch(0).basis;
  for (int i = 0; i < basis.n_functions(); ++i)
    if (basis.function(i).knots[0].front() == 0. && basis.function(i).knots[1].front() == 0. &&
        basis.function(i).knots[0].back() < 1. && basis.function(i).knots[1].back() < 1.)
      near.push_back(i);
  surface.refine(near, sherd::SpanTarget{{0.25, 0.25}});
  return surface;
}

/// Snapshot of a surface moved by x = factor X, with v = X and phi = 1.
template <int degree, int spacedim>
sherd::Snapshot<spacedim> scaled(const sherd::Surface<degree, spacedim> &surface, double factor, double time)
{
  const auto X = surface.control_points();
  return {time, factor * X, X, Eigen::VectorXd::Ones(X.rows())};
}

} // namespace test
