#pragma once

#include <sherd/material/canham.h>
#include <sherd/material/koiter.h>
#include <sherd/material/neo_hooke.h>
#include <sherd/material/st_venant_kirchhoff.h>

namespace sherd::material
{

/// Flexural rigidity D = E T^3 / (12 (1 - nu^2)) of a sheet [force * length], theory B.3.
/// @param E          Young's modulus of the solid [force/area].
/// @param thickness  T [length].
/// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2, thickness > 0.
inline double flexural_rigidity(const double E, const double nu, const double thickness)
{
  return Koiter(E, nu, thickness).stiffness();
}

/// Membrane and bending law of one sheet.
template <MembraneLaw Membrane, BendingLaw Bending>
struct ShellLaws
{
  Membrane membrane;
  Bending  bending;
};

/// Koiter's shell, theory B.5: the laws of published benchmarks of linear elastic sheets.
/// @param E          Young's modulus of the solid [force/area].
/// @param thickness  T [length].
/// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2, thickness > 0.
inline ShellLaws<StVenantKirchhoff, Koiter> koiter_shell(const double E, const double nu, const double thickness)
{
  return {StVenantKirchhoff(plane_stress_moduli(E, nu, thickness)), Koiter(E, nu, thickness)};
}

/// Neo-Hookean membrane with Canham's bending of the same flexural rigidity, theory B.1 to B.3. Bending differs from
/// that of the sheet by its Poisson effect.
/// @param E          Young's modulus of the solid [force/area].
/// @param thickness  T [length].
/// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2, thickness > 0.
inline ShellLaws<NeoHooke, Canham> neo_hooke_canham_shell(const double E, const double nu, const double thickness)
{
  return {NeoHooke(plane_stress_moduli(E, nu, thickness)), Canham(flexural_rigidity(E, nu, thickness))};
}

} // namespace sherd::material
