#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/split/thickness_weight.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace sherd
{

/// Gauss rule for the thickness weight, theory B.4 (2): w = 3/2 sum w_g s_g^2 [q(s_g) >= 0].
///
/// A step function of the deformation, with an error of order 1/n: stress jumps whenever a layer changes sign. It is
/// for comparison with the closed form of thickness_weight().
class GaussThickness
{
public:
  /// @param n_points  at least 2; fewer do not integrate xi^2.
  /// @throws InvalidParameter  for fewer.
  explicit GaussThickness(const int n_points)
  {
    if (n_points < 2)
      throw InvalidParameter("thickness weight: " + print(n_points) +
                             " Gauss points given, at least 2 are needed; 0 chooses the closed form");
    for (int i = 0; i < n_points; ++i)
      {
        // Newton's method on the Legendre polynomial from the usual asymptotic root.
        double s = std::cos(std::numbers::pi * (i + .75) / (n_points + .5)), slope = 0.;
        for (int iteration = 0; iteration < 8; ++iteration)
          {
            double last = 1., value = s;
            for (int k = 2; k <= n_points; ++k)
              {
                const double next = ((2. * k - 1.) * s * value - (k - 1.) * last) / k;
                last              = value;
                value             = next;
              }
            slope = n_points * (s * value - last) / (s * s - 1.);
            s -= value / slope;
          }
        points_.push_back(s);
        shares_.push_back(3. * s * s / ((1. - s * s) * slope * slope));
      }
  }

  double weight(const LayerStretch &stretch) const
  {
    if (stretch.is_stress_free())
      return 1.;
    double sum = 0.;
    for (std::size_t g = 0; g < points_.size(); ++g)
      if (stretch.value(points_[g]) >= 0.)
        sum += shares_[g];
    return sum;
  }

private:
  std::vector<double> points_; ///< s_g
  std::vector<double> shares_; ///< 3/2 w_g s_g^2; they sum to 1
};

} // namespace sherd
