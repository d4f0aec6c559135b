#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <sherd/geometry/shapes.h>

/// Phase fields of prescribed cracks for the tests of this room.
namespace test
{

using Vector = Eigen::Vector2d;

inline double distance_to_segment(const Vector &p, const Vector &a, const Vector &b)
{
  const Vector edge = b - a;
  const double t    = std::min(std::max((p - a).dot(edge) / edge.squaredNorm(), 0.), 1.);
  return (p - a - t * edge).norm();
}

/// Cracks along straight segments with the optimal profile of the fourth-order density,
/// phi = 1 - (1 + d/l0) exp(-d/l0) with the distance d to the closest segment (theory C.1).
struct Cracks
{
  double                                 length_scale;
  std::vector<std::pair<Vector, Vector>> segments;

  double operator()(const Vector &p) const
  {
    double d = 1e300;
    for (const auto &[a, b] : segments)
      d = std::min(d, distance_to_segment(p, a, b));
    const double s = d / length_scale;
    return 1. - (1. + s) * std::exp(-s);
  }

  /// Distance from a segment at which phi = threshold.
  double half_width(double threshold = 0.1) const
  {
    double low = 0., high = 10.;
    for (int k = 0; k < 60; ++k)
      {
        const double s                                          = 0.5 * (low + high);
        (1. - (1. + s) * std::exp(-s) < threshold ? low : high) = s;
      }
    return low * length_scale;
  }
};

/// Control values of a field on a plate: its values at the control points, which lie at the Greville abscissae
/// (second order in the element size).
template <int degree, int spacedim>
Eigen::VectorXd control_values(const sherd::Surface<degree, spacedim> &plate, const std::function<double(Vector)> &f)
{
  const auto      X = plate.control_points();
  Eigen::VectorXd c(X.rows());
  for (int i = 0; i < X.rows(); ++i)
    c[i] = f(Vector(X(i, 0), X(i, 1)));
  return c;
}

} // namespace test
