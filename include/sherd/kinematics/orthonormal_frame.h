#pragma once

#include <sherd/kinematics/metric.h>

#include <cmath>

namespace sherd
{

/// Orthonormal frame of a tangent plane, expressed in its tangents: e_i = P_ai A_a with e_i . e_j = delta_ij.
///
/// P is the inverse transpose of the Cholesky factor of A_ab, hence upper triangular (theory B.4 (3)). In this frame
/// indices need not be raised, and invariants are sums of squares instead of differences.
class OrthonormalFrame
{
public:
  OrthonormalFrame() = default;

  /// @param metric  A_ab, positive definite.
  explicit OrthonormalFrame(const Metric &metric)
  {
    const double L11 = std::sqrt(metric.covariant[0]), L21 = metric.covariant[2] / L11;
    const double L22 = std::sqrt(metric.determinant) / L11;
    p11_             = 1. / L11;
    p12_             = -L21 / (L11 * L22);
    p22_             = 1. / L22;
  }

  /// Cartesian components T_ij = P_ai T_ab P_bj of a tensor given by covariant components T_ab.
  Voigt pull(const Voigt &T) const
  {
    return {p11_ * p11_ * T[0], p12_ * p12_ * T[0] + 2. * p12_ * p22_ * T[2] + p22_ * p22_ * T[1],
            p11_ * (p12_ * T[0] + p22_ * T[2])};
  }

  /// Contravariant components T^ab = P_ai T_ij P_bj of a tensor given by Cartesian components T_ij.
  Voigt push(const Voigt &T) const
  {
    return {p11_ * p11_ * T[0] + 2. * p11_ * p12_ * T[2] + p12_ * p12_ * T[1], p22_ * p22_ * T[1],
            p22_ * (p11_ * T[2] + p12_ * T[1])};
  }

private:
  double p11_ = 1., p12_ = 0., p22_ = 1.;
};

} // namespace sherd
