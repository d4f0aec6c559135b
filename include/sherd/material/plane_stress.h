#pragma once

#include <sherd/kinematics/metric.h>
#include <sherd/material/moduli.h>

namespace sherd::material
{

/// Tensor of the quadratic form K/2 (tr T)^2 + G dev T : dev T of a symmetric surface tensor T_ab,
///
///   C^abcd = (K - G) A^ab A^cd + G (A^ac A^bd + A^ad A^bc)
///
/// with K - G = E nu / (1 - nu^2) (theory B.5).
inline Voigt4 plane_stress_tensor(const Moduli &moduli, const Metric &reference)
{
  const Voigt &A = reference.contravariant;
  return (moduli.bulk - moduli.shear) * A * A.transpose() - 2. * moduli.shear * inverse_derivative(reference);
}

} // namespace sherd::material
