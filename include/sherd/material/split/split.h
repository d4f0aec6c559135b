#pragma once

#include <sherd/kinematics/surface_point.h>
#include <sherd/material/response.h>

#include <concepts>

namespace sherd
{

/// Elastic energy at one point in two parts: the active one is degraded and drives cracks, the passive one is not
/// (theory B.4; paper Eqs. (9) to (11)).
///
/// The energy of the damaged surface is g(phi) energy_active + energy_passive; stress and tangent likewise.
template <int spacedim>
struct SplitResponse
{
  double            energy_active, energy_passive; ///< by reference area; their sum is the undegraded energy
  Stress<spacedim>  stress_active, stress_passive;
  Tangent<spacedim> tangent_active, tangent_passive; ///< derivatives of the two stresses
  Stress<spacedim>  driving; ///< derivative of energy_active, which couples phase to deformation (theory E.2)
};

/// The response of a surface that is stiffer by a factor.
template <int spacedim>
inline SplitResponse<spacedim> operator*(const double factor, const SplitResponse<spacedim> &response)
{
  return {factor * response.energy_active,  factor * response.energy_passive, factor * response.stress_active,
          factor * response.stress_passive, factor * response.tangent_active, factor * response.tangent_passive,
          factor * response.driving};
}

/// Stress of the damaged surface.
/// @param g  degradation at the point.
template <int spacedim>
inline Stress<spacedim> degraded_stress(const SplitResponse<spacedim> &response, const double g)
{
  return g * response.stress_active + response.stress_passive;
}

/// Tangent of the damaged surface at fixed phase.
/// @param g  degradation at the point.
template <int spacedim>
inline Tangent<spacedim> degraded_tangent(const SplitResponse<spacedim> &response, const double g)
{
  return g * response.tangent_active + response.tangent_passive;
}

/// An energy split with its material laws inside.
///
/// respond() is called at every quadrature point and has no side effects. The two energies and stresses sum to those of
/// the undamaged surface. bulk() and shear() are the moduli at rest, which set the wave speeds.
template <class Split, int spacedim>
concept EnergySplit = requires(const Split &split, const SurfacePoint<spacedim> &point)
{
  {
    split.respond(point)
    } -> std::same_as<SplitResponse<spacedim>>;
  {
    split.bulk()
    } -> std::convertible_to<double>;
  {
    split.shear()
    } -> std::convertible_to<double>;
};

} // namespace sherd
