#pragma once

#include <sherd/kinematics/orthonormal_frame.h>
#include <sherd/material/moduli.h>
#include <sherd/material/split/split.h>

namespace sherd
{

/// Answer of one part of a strain energy, in Cartesian components (11, 22, 12) of an orthonormal frame.
struct StrainResponse
{
  double energy;  ///< psi(E)
  Voigt  stress;  ///< s_ij = d psi / d E_ij
  Voigt4 tangent; ///< C_ijkl = d s_ij / d E_kl, no weights inside

  static StrainResponse zero() { return {0., Voigt::Zero(), Voigt4::Zero()}; }
};

/// A strain energy in two parts (theory B.4). Their sum is Lambda/2 (tr E)^2 + mu E : E with Lambda = K - G and mu = G.
struct StrainParts
{
  StrainResponse active, passive;

  static StrainParts zero() { return {StrainResponse::zero(), StrainResponse::zero()}; }
};

/// Strains count as tensile down to minus this, so that rounding does not toggle the stiffness of an unloaded crack.
inline constexpr double strain_tolerance = 1e-12;

/// Strain eps_ij in the orthonormal frame of the reference surface, without cancellation.
inline Voigt cartesian_strain(const SurfacePoint<2> &point)
{
  return point.reference.frame.pull(.5 * (point.metric.covariant - point.reference.metric.covariant));
}

/// Contravariant components of a Cartesian tensor of fourth order: C^abcd = P_ai P_bj C_ijkl P_ck P_dl.
inline Voigt4 push(const OrthonormalFrame &frame, const Voigt4 &C)
{
  Voigt4 half, full;
  for (int k = 0; k < 3; ++k)
    half.col(k) = frame.push(Voigt(C.col(k)));
  for (int k = 0; k < 3; ++k)
    full.row(k) = frame.push(Voigt(half.row(k).transpose())).transpose();
  return full;
}

/// The split response of a membrane with the strain energy of the two parts.
inline SplitResponse<2> membrane_response(const OrthonormalFrame &frame, const StrainParts &parts)
{
  const Stress<2> active{frame.push(parts.active.stress)}, passive{frame.push(parts.passive.stress)};
  return {parts.active.energy,
          parts.passive.energy,
          active,
          passive,
          {push(frame, parts.active.tangent)},
          {push(frame, parts.passive.tangent)},
          active};
}

} // namespace sherd
