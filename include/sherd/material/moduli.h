#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>

#include <cmath>
#include <string>

namespace sherd::material
{

/// Moduli of a linear elastic surface [force/length], theory B.3.
///
/// Psi = K/2 (tr eps)^2 + G dev eps : dev eps by reference area. In the plane the unit of thickness may be left out,
/// and they are [force/area].
struct Moduli
{
  double bulk;  ///< K
  double shear; ///< G
};

namespace internal
{
inline void require_elastic_constants(const double E, const double nu, const double nu_max, const std::string &where)
{
  if (!(std::isfinite(E) && E > 0.))
    throw InvalidParameter(where + ": Young's modulus " + print(E) + " must be positive and finite");
  if (!(nu > -1. && nu < nu_max))
    throw InvalidParameter(where + ": Poisson's ratio " + print(nu) + " must lie between -1 and " + print(nu_max) +
                           ", both excluded");
}

inline void require_positive_moduli(const Moduli &moduli, const std::string &where)
{
  if (!(std::isfinite(moduli.bulk) && moduli.bulk > 0. && std::isfinite(moduli.shear) && moduli.shear > 0.))
    throw InvalidParameter(where + ": moduli K = " + print(moduli.bulk) + " and G = " + print(moduli.shear) +
                           " must be positive and finite");
}
} // namespace internal

/// Surface with Young's modulus E [force/length] and Poisson's ratio nu: K = E / (2 (1 - nu)), G = E / (2 (1 + nu)).
/// @throws InvalidParameter  unless E > 0 and -1 < nu < 1.
inline Moduli surface_moduli(const double E, const double nu)
{
  internal::require_elastic_constants(E, nu, 1., "surface moduli");
  return {E / (2. * (1. - nu)), E / (2. * (1. + nu))};
}

/// Sheet of a solid in plane stress: the surface modulus is E_3D times the thickness, nu is that of the solid.
/// @param E  Young's modulus of the solid [force/area].
/// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2, thickness > 0.
inline Moduli plane_stress_moduli(const double E, const double nu, const double thickness)
{
  internal::require_elastic_constants(E, nu, .5, "plane-stress moduli");
  if (!(std::isfinite(thickness) && thickness > 0.))
    throw InvalidParameter("plane-stress moduli: thickness " + print(thickness) + " must be positive and finite");
  return surface_moduli(E * thickness, nu);
}

/// Solid in plane strain, by unit thickness: K = lambda + mu, G = mu [force/area] with Lame's constants.
/// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2.
inline Moduli plane_strain_moduli(const double E, const double nu)
{
  internal::require_elastic_constants(E, nu, .5, "plane-strain moduli");
  const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
  return {lambda + mu, mu};
}

} // namespace sherd::material
