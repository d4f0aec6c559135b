#pragma once

#include <sherd/kinematics/surface_point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sherd
{

/// Metric of a layer at the distance xi from the mid surface, theory A.3.
enum class LayerMetric
{
  full,  ///< a_ab - 2 xi b_ab + xi^2 b_ac a^cd b_db: exact for a shell without thickness stretch
  linear ///< a_ab - 2 xi b_ab: the usual thin-shell simplification
};

/// Quadratic q(s) = q[0] + q[1] s + q[2] s^2 over the thickness, s = 2 xi / T in [-1, 1], with the sign of the layer
/// stretch less 1: a layer is stretched where q >= 0 (theory B.4 (2)).
struct LayerStretch
{
  std::array<double, 3> q;

  double value(const double s) const { return q[0] + s * (q[1] + s * q[2]); }
  double slope(const double s) const { return q[1] + 2. * s * q[2]; }

  /// The undeformed surface counts as stretched, rounding included, so that rounding does not toggle the bending
  /// stiffness of an unloaded crack.
  static constexpr double tolerance = 1e-12;

  bool is_stress_free() const { return std::abs(q[0]) + std::abs(q[1]) + std::abs(q[2]) < tolerance; }
};

/// The table of theory B.4 (2), without cancellation in J - 1.
///
/// Precondition: no layer of either state is turned inside out, T |kappa_i| < 2 for both principal curvatures with the
/// full metric and < 1 with the linear one.
/// @param thickness  T [length].
inline LayerStretch layer_stretch(const SurfacePoint<3> &point, const double thickness, const LayerMetric metric)
{
  const double half = .5 * thickness, J = point.J, H_0 = point.reference_mean_curvature;
  const double H = point.mean_curvature, kappa = point.gauss_curvature, kappa_0 = point.reference_gauss_curvature;
  if (metric == LayerMetric::full)
    return {point.J_minus_1, -2. * half * (J * H - H_0), half * half * (J * kappa - kappa_0)};
  return {point.J_minus_1 * (2. + point.J_minus_1), -4. * half * (J * J * H - H_0),
          4. * half * half * (J * J * kappa - kappa_0)};
}

/// Share of the bending energy in stretched layers, and the layers where the sign changes.
struct ThicknessWeight
{
  double                value;  ///< w in [0, 1]
  int                   n_cuts; ///< 0, 1 or 2
  std::array<double, 2> cuts;   ///< roots of q in (-1, 1), ascending; q' is not 0 there
};

/// w = 12 / T^3 int xi^2 [q >= 0] dxi over the thickness in closed form, theory B.4 (2); paper Eq. (11).
///
/// w is 1 in tension, 0 in compression, 1/2 for pure bending of a flat sheet.
inline ThicknessWeight thickness_weight(const LayerStretch &stretch)
{
  if (stretch.is_stress_free())
    return {1., 0, {}};

  // A root that only touches zero cuts nothing. Of the two roots of a quadratic, the one without cancellation is
  // computed directly and the other from their product.
  const auto &[q0, q1, q2] = stretch.q;
  ThicknessWeight weight{0., 0, {}};
  const auto      add_root = [&weight](const double s) {
    if (-1. < s && s < 1.)
      weight.cuts[weight.n_cuts++] = s;
  };
  if (std::abs(q2) < 1e-14 * std::max(std::abs(q0), std::abs(q1)))
    {
      if (q1 != 0.)
        add_root(-q0 / q1);
    }
  else if (const double discriminant = q1 * q1 - 4. * q0 * q2; discriminant > 0.)
    {
      const double t = -.5 * (q1 + std::copysign(std::sqrt(discriminant), q1));
      add_root(t / q2);
      add_root(q0 / t);
    }
  if (weight.n_cuts == 2 && weight.cuts[1] < weight.cuts[0])
    std::swap(weight.cuts[0], weight.cuts[1]);

  // q keeps its sign between cuts. Its mean, by Simpson's rule, has it even where q touches zero at the mid point.
  double below = -1.;
  for (int i = 0; i <= weight.n_cuts; ++i)
    {
      const double above = i < weight.n_cuts ? weight.cuts[i] : 1.;
      if (stretch.value(below) + 4. * stretch.value(.5 * (below + above)) + stretch.value(above) >= 0.)
        weight.value += .5 * (above * above * above - below * below * below);
      below = above;
    }
  return weight;
}

} // namespace sherd
