#pragma once

#include <sherd/material/split/thickness_rule.h>
#include <sherd/material/split/thickness_weight.h>

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
  explicit GaussThickness(const int n_points) : rule_(n_points, "thickness weight (0 chooses the closed form)") {}

  double weight(const LayerStretch &stretch) const
  {
    if (stretch.is_stress_free())
      return 1.;
    double sum = 0.;
    for (std::size_t g = 0; g < rule_.points.size(); ++g)
      if (const double s = rule_.points[g]; stretch.value(s) >= 0.)
        sum += 1.5 * rule_.weights[g] * s * s;
    return sum;
  }

private:
  ThicknessRule rule_;
};

} // namespace sherd
