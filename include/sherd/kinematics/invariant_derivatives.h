#pragma once

#include <sherd/kinematics/surface_point.h>

namespace sherd
{

/// First derivatives of J, H and kappa by a_ab and b_ab, theory A.1. Contravariant components (11, 22, 12) of tensors:
/// dJ = J_a : da, with 12 counted twice.
struct InvariantGradients
{
  Voigt J_a;     ///< J/2 a^ab
  Voigt H_a;     ///< -b^ab / 2
  Voigt H_b;     ///< a^ab / 2
  Voigt kappa_a; ///< -kappa a^ab
  Voigt kappa_b; ///< 2 H a^ab - b^ab
};

/// Second derivatives of J, H and kappa, theory A.1. Rows: first letter, columns: second letter, without weights; those
/// not listed vanish.
struct InvariantHessians
{
  Voigt4 J_aa;     ///< J/4 a^ab a^cd + J/2 a^abcd
  Voigt4 H_aa;     ///< (a^ac b^bd + b^ac a^bd + a^ad b^bc + b^ad a^bc) / 4
  Voigt4 H_ab;     ///< a^abcd / 2, which is H_ba as well
  Voigt4 kappa_aa; ///< kappa (a^ab a^cd - a^abcd)
  Voigt4 kappa_ab; ///< -a^ab (2 H a^cd - b^cd)
  Voigt4 kappa_bb; ///< a^ab a^cd + a^abcd
};

inline InvariantGradients invariant_gradients(const SurfacePoint<3> &point)
{
  const Voigt &a = point.metric.contravariant;
  return {.5 * point.J * a, -.5 * raised(point.metric, point.curvature), .5 * a, -point.gauss_curvature * a,
          curvature_cofactor(point.metric, point.curvature)};
}

namespace internal
{
/// (X^ac Y^bd + Y^ac X^bd + X^ad Y^bc + Y^ad X^bc) / 4 of two symmetric tensors. Rows (ab), columns (cd).
inline Voigt4 symmetric_product(const Voigt &X, const Voigt &Y)
{
  const double xy_1 = .5 * (X[0] * Y[2] + X[2] * Y[0]), xy_2 = .5 * (X[1] * Y[2] + X[2] * Y[1]);
  return symmetric_voigt4(X[0] * Y[0], X[2] * Y[2], xy_1, X[1] * Y[1], xy_2,
                          .25 * (X[0] * Y[1] + X[1] * Y[0]) + .5 * X[2] * Y[2]);
}
} // namespace internal

inline InvariantHessians invariant_hessians(const SurfacePoint<3> &point)
{
  const Voigt &a       = point.metric.contravariant;
  const double J       = point.J;
  const Voigt4 aa      = a * a.transpose();
  const Voigt4 inverse = inverse_derivative(point.metric);
  return {.25 * J * aa + .5 * J * inverse,
          internal::symmetric_product(a, raised(point.metric, point.curvature)),
          .5 * inverse,
          point.gauss_curvature * (aa - inverse),
          -a * curvature_cofactor(point.metric, point.curvature).transpose(),
          aa + inverse};
}

} // namespace sherd
