#pragma once

#include <algorithm>
#include <utility>

#include <sherd/geometry/place.h>
#include <sherd/state/state.h>

namespace sherd::test
{

/// Radius of a sphere of neo-Hooke and Canham under a pressure from t = 0 on, R = 1, rho = 1: lambda'' = p lambda^2 -
/// dPsi/dlambda (theory J.5), by the classical Runge-Kutta method.
class Breathing
{
public:
  Breathing(double K, double c, double pressure) : K_(K), c_(c), pressure_(pressure) {}

  double stretch(double time) const
  {
    const int    n = 2000;
    const double h = time / n;
    double       x = 1., v = 0.;
    for (int i = 0; i < n; ++i)
      {
        const double k1 = v, l1 = acceleration(x);
        const double k2 = v + .5 * h * l1, l2 = acceleration(x + .5 * h * k1);
        const double k3 = v + .5 * h * l2, l3 = acceleration(x + .5 * h * k2);
        const double k4 = v + h * l3, l4 = acceleration(x + h * k3);
        x += h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
        v += h / 6. * (l1 + 2. * l2 + 2. * l3 + l4);
      }
    return x;
  }

private:
  double acceleration(double x) const { return pressure_ * x * x - K_ * (x * x * x - 1. / x) - 2. * c_ * (x - 1.); }

  double K_, c_, pressure_;
};

/// Smallest and largest |x| / |X| on a grid over all patches of n x n elements, their borders included.
inline std::pair<double, double> stretches(const Surface<2, 3> &surface, const State<2, 3> &state, int n)
{
  const auto                x = snapshot(state).position;
  const auto                X = surface.control_points();
  std::pair<double, double> range{1e300, 0.};
  for (int p = 0; p < surface.n_patches(); ++p)
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j)
        {
          const auto at     = evaluate(surface, SurfacePlace{p, i * n / 8., j * n / 8.});
          Point<3>   before = Point<3>::Zero(), now = before;
          for (std::size_t A = 0; A < at.points.size(); ++A)
            {
              before += at.value[A] * X.row(at.points[A]).transpose();
              now += at.value[A] * x.row(at.points[A]).transpose();
            }
          range.first  = std::min(range.first, now.norm() / before.norm());
          range.second = std::max(range.second, now.norm() / before.norm());
        }
  return range;
}

} // namespace sherd::test
