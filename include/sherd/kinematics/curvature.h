#pragma once

#include <sherd/kinematics/metric.h>

namespace sherd
{

/// H = a^ab b_ab / 2 [1/length], theory A.1. Positive where the surface bends towards its normal.
/// @param b  b_ab, covariant components (11, 22, 12).
inline double mean_curvature(const Metric &metric, const Voigt &b)
{
  return .5 * contract(metric.contravariant, b);
}

/// kappa = det b_ab / det a_ab [1/length^2], theory A.1.
inline double gauss_curvature(const Metric &metric, const Voigt &b)
{
  return (b[0] * b[1] - b[2] * b[2]) / metric.determinant;
}

/// b^ab = a^ac b_cd a^db, theory A.1.
inline Voigt raised(const Metric &metric, const Voigt &b)
{
  const double a11 = metric.contravariant[0], a22 = metric.contravariant[1], a12 = metric.contravariant[2];
  return {a11 * a11 * b[0] + 2. * a11 * a12 * b[2] + a12 * a12 * b[1],
          a12 * a12 * b[0] + 2. * a12 * a22 * b[2] + a22 * a22 * b[1],
          a11 * a12 * b[0] + (a11 * a22 + a12 * a12) * b[2] + a12 * a22 * b[1]};
}

/// Cofactor of the curvature 2 H a^ab - b^ab, which is the adjoint of b_ab over det a_ab (theory A.1).
inline Voigt curvature_cofactor(const Metric &metric, const Voigt &b)
{
  return Voigt(b[1], b[0], -b[2]) / metric.determinant;
}

} // namespace sherd
