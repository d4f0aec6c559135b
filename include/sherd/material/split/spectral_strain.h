#pragma once

#include <sherd/material/split/strain_parts.h>

#include <algorithm>
#include <cmath>

namespace sherd
{

/// Strain energy split by its principal strains lambda_1 >= lambda_2, theory B.4 (3):
///
///   psi+- = Lambda/2 <tr E>+-^2 + mu (<lambda_1>+-^2 + <lambda_2>+-^2),   Lambda = K - G, mu = G.
///
/// Neither part is negative for any positive K and G. Equal principal strains are no special case: principal
/// directions are needed only where the strains have different signs, and then they are apart.
/// @param E  Cartesian components.
inline StrainParts spectral_parts(const material::Moduli &moduli, const Voigt &E)
{
  const double Lambda = moduli.bulk - moduli.shear, mu = moduli.shear;
  const double trace = E[0] + E[1], half = .5 * (E[0] - E[1]), radius = std::sqrt(half * half + E[2] * E[2]);
  const double upper = .5 * trace + radius, lower = .5 * trace - radius;
  StrainParts  parts = StrainParts::zero();

  if (lower >= -strain_tolerance || upper < -strain_tolerance)
    {
      auto &part   = lower >= -strain_tolerance ? parts.active : parts.passive;
      part.energy  = mu * contract(E, E);
      part.stress  = 2. * mu * E;
      part.tangent = Voigt(2. * mu, 2. * mu, mu).asDiagonal();
    }
  else
    {
      // N_1 and N_2 project on the principal directions, S turns them into each other: s_12 = s_21 = 1 / sqrt 2.
      const double c = half / radius, s = E[2] / radius, root = std::sqrt(.5);
      const Voigt  N_1(.5 * (1. + c), .5 * (1. - c), .5 * s), N_2(N_1[1], N_1[0], -N_1[2]);
      const Voigt  S(-root * s, root * s, root * c);
      const double share   = std::max(0., upper) / (upper - lower);
      parts.active.energy  = mu * upper * upper;
      parts.passive.energy = mu * lower * lower;
      parts.active.stress  = 2. * mu * upper * N_1;
      parts.passive.stress = 2. * mu * lower * N_2;

      parts.active.tangent  = 2. * mu * (N_1 * N_1.transpose() + share * S * S.transpose());
      parts.passive.tangent = 2. * mu * (N_2 * N_2.transpose() + (1. - share) * S * S.transpose());
    }

  auto &part = trace >= -strain_tolerance ? parts.active : parts.passive;
  part.energy += .5 * Lambda * trace * trace;
  part.stress.head<2>().array() += Lambda * trace;
  part.tangent.topLeftCorner<2, 2>().array() += Lambda;
  return parts;
}

} // namespace sherd
