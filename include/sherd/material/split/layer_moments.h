#pragma once

#include <sherd/material/split/strain_parts.h>

#include <array>

namespace sherd
{

/// Moments over the thickness of what layers answer, s = 2 xi / T: sum_n = 1/2 int s^n (...) ds over [-1, 1], in
/// Cartesian components. With surface moduli in the layers they are resultants by reference area (theory B.4 (3)).
struct LayerMoments
{
  double                energy = 0.;
  std::array<Voigt, 2>  stress{Voigt::Zero(), Voigt::Zero()};
  std::array<Voigt4, 3> tangent{Voigt4::Zero(), Voigt4::Zero(), Voigt4::Zero()};

  /// Adds a layer.
  /// @param share  half the weight of its quadrature point.
  void add(const StrainResponse &layer, const double s, const double share)
  {
    energy += share * layer.energy;
    stress[0] += share * layer.stress;
    stress[1] += share * s * layer.stress;
    tangent[0] += share * layer.tangent;
    tangent[1] += share * s * layer.tangent;
    tangent[2] += share * s * s * layer.tangent;
  }
};

/// Strain of the layers of a shell, E(s) = membrane + s bending in Cartesian components, s = 2 xi / T: the strain
/// eps - xi k that is linear in xi (theory B.4 (3)).
struct LayerStrain
{
  Voigt membrane, bending;

  LayerStrain(const SurfacePoint<3> &point, const double thickness)
      : membrane(cartesian_strain(point)), bending(-.5 * thickness * point.reference.frame.pull(point.curvature_change))
  {
  }

  Voigt at(const double s) const { return membrane + s * bending; }
};

namespace internal
{
inline Stress<3> layer_stress(const OrthonormalFrame &frame, const LayerMoments &moments, const double thickness)
{
  return {frame.push(moments.stress[0]), -.5 * thickness * frame.push(moments.stress[1])};
}

inline Tangent<3> layer_tangent(const OrthonormalFrame &frame, const LayerMoments &moments, const double thickness)
{
  const double half     = .5 * thickness;
  const Voigt4 coupling = -half * push(frame, moments.tangent[1]);
  return {push(frame, moments.tangent[0]), coupling, coupling, half * half * push(frame, moments.tangent[2])};
}
} // namespace internal

/// tau = int s dxi, M = -int xi s dxi, c = int C dxi, d = e = -int xi C dxi, f = int xi^2 C dxi (theory B.4 (3)).
inline SplitResponse<3> shell_response(const OrthonormalFrame &frame, const LayerMoments &active,
                                       const LayerMoments &passive, const double thickness)
{
  const Stress<3> stress = internal::layer_stress(frame, active, thickness);
  return {active.energy,
          passive.energy,
          stress,
          internal::layer_stress(frame, passive, thickness),
          internal::layer_tangent(frame, active, thickness),
          internal::layer_tangent(frame, passive, thickness),
          stress};
}

} // namespace sherd
