#pragma once

#include <sherd/kinematics/invariant_derivatives.h>
#include <sherd/material/split/thickness_weight.h>

#include <array>
#include <cmath>

namespace sherd
{

/// First derivatives of the coefficients of a LayerStretch by a_ab and b_ab, shape=(3).
struct LayerStretchGradient
{
  std::array<Voigt, 3> a, b;
};

/// Second derivatives of the coefficients, shape=(3). Rows: first letter, columns: second letter.
struct LayerStretchHessian
{
  std::array<Voigt4, 3> aa, ab, bb;
};

/// First derivatives of the thickness weight by a_ab and b_ab: dw = a : da + b : db.
struct WeightGradient
{
  Voigt a, b;
};

/// Second derivatives of the thickness weight. Rows: first letter, columns: second letter.
struct WeightHessian
{
  Voigt4 aa, ab, bb;
};

namespace internal
{
/// The coefficients of both layer metrics are F - 1, first (F H - H_0), second (F kappa - kappa_0) with F = J or J^2.
struct LayerFactors
{
  double F, F_J, F_JJ; ///< F and its derivatives by J
  double first, second;
};

inline LayerFactors layer_factors(const double J, const double thickness, const LayerMetric metric)
{
  const double half = .5 * thickness;
  if (metric == LayerMetric::full)
    return {J, 1., 0., -2. * half, half * half};
  return {J * J, 2. * J, 2., -4. * half, 4. * half * half};
}
} // namespace internal

/// Derivatives of layer_stretch(point, thickness, metric), theory B.4 (2).
inline LayerStretchGradient layer_stretch_gradient(const SurfacePoint<3> &point, const double thickness,
                                                   const LayerMetric metric)
{
  const auto   f   = internal::layer_factors(point.J, thickness, metric);
  const auto   I   = invariant_gradients(point);
  const Voigt  F_a = f.F_J * I.J_a;
  const double H = point.mean_curvature, kappa = point.gauss_curvature;
  return {{F_a, f.first * (H * F_a + f.F * I.H_a), f.second * (kappa * F_a + f.F * I.kappa_a)},
          {Voigt::Zero(), f.first * f.F * I.H_b, f.second * f.F * I.kappa_b}};
}

/// Second derivatives of layer_stretch(point, thickness, metric).
inline LayerStretchHessian layer_stretch_hessian(const SurfacePoint<3> &point, const double thickness,
                                                 const LayerMetric metric)
{
  const auto   f    = internal::layer_factors(point.J, thickness, metric);
  const auto   I    = invariant_gradients(point);
  const auto   II   = invariant_hessians(point);
  const Voigt  F_a  = f.F_J * I.J_a;
  const Voigt4 F_aa = f.F_J * II.J_aa + f.F_JJ * I.J_a * I.J_a.transpose();
  const Voigt4 FH = F_a * I.H_a.transpose(), Fkappa = F_a * I.kappa_a.transpose();
  const double H = point.mean_curvature, kappa = point.gauss_curvature;
  return {{F_aa, f.first * (H * F_aa + FH + FH.transpose() + f.F * II.H_aa),
           f.second * (kappa * F_aa + Fkappa + Fkappa.transpose() + f.F * II.kappa_aa)},
          {Voigt4::Zero(), f.first * (F_a * I.H_b.transpose() + f.F * II.H_ab),
           f.second * (F_a * I.kappa_b.transpose() + f.F * II.kappa_ab)},
          {Voigt4::Zero(), Voigt4::Zero(), f.second * f.F * II.kappa_bb}};
}

/// w_z = sum over cuts of 3/2 s^2 q_z / |q'|, theory B.4 (2) in s = 2 xi / T. Zero without cuts.
inline WeightGradient weight_gradient(const ThicknessWeight &weight, const LayerStretch &stretch,
                                      const LayerStretchGradient &q)
{
  WeightGradient gradient{Voigt::Zero(), Voigt::Zero()};
  for (int i = 0; i < weight.n_cuts; ++i)
    {
      const double s = weight.cuts[i], factor = 1.5 * s * s / std::abs(stretch.slope(s));
      gradient.a += factor * (q.a[0] + s * (q.a[1] + s * q.a[2]));
      gradient.b += factor * (q.b[0] + s * (q.b[1] + s * q.b[2]));
    }
  return gradient;
}

/// w_zy = sum over cuts of 3/2 sign(q') [s^2 q_zy / q' - (2 s q_z q_y + s^2 (q'_z q_y + q_z q'_y)) / q'^2 +
/// s^2 q'' q_z q_y / q'^3], theory B.4 (2). Zero without cuts.
inline WeightHessian weight_hessian(const ThicknessWeight &weight, const LayerStretch &stretch,
                                    const LayerStretchGradient &q, const LayerStretchHessian &qq)
{
  WeightHessian hessian{Voigt4::Zero(), Voigt4::Zero(), Voigt4::Zero()};
  for (int i = 0; i < weight.n_cuts; ++i)
    {
      const double s = weight.cuts[i], inverse = 1. / stretch.slope(s), ss = s * s;
      const double factor  = 1.5 * std::abs(inverse);
      const double product = ss * 2. * stretch.q[2] * inverse - 2. * s;
      const Voigt  a = q.a[0] + s * (q.a[1] + s * q.a[2]), slope_a = q.a[1] + 2. * s * q.a[2];
      const Voigt  b = q.b[0] + s * (q.b[1] + s * q.b[2]), slope_b = q.b[1] + 2. * s * q.b[2];
      const auto   add = [&](Voigt4 &sum, const Voigt &z, const Voigt &slope_z, const Voigt &y, const Voigt &slope_y,
                           const std::array<Voigt4, 3> &zy) {
        const Voigt left = product * z - ss * slope_z;
        sum += factor * (ss * (zy[0] + s * (zy[1] + s * zy[2])) +
                         inverse * (left * y.transpose() - ss * z * slope_y.transpose()));
      };
      add(hessian.aa, a, slope_a, a, slope_a, qq.aa);
      add(hessian.ab, a, slope_a, b, slope_b, qq.ab);
      add(hessian.bb, b, slope_b, b, slope_b, qq.bb);
    }
  return hessian;
}

} // namespace sherd
