#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/moduli.h>

#include <cmath>

namespace sherd::material
{

/// Elastic constants of a sheet, from which every law and split can be made: K, G, c, T (theory B.3).
///
/// The bending modulus is a constant of its own. Laws that sum up layers know only that of a solid sheet,
/// (K + G) T^2 / 12, and refuse others.
struct Sheet
{
  Moduli moduli;    ///< K, G [force/length], with the thickness inside
  double bending;   ///< c, the flexural rigidity [force * length]
  double thickness; ///< T [length]
};

/// Flexural rigidity of a sheet of a solid, D = T^2/12 (K + G) = E_3D T^3 / (12 (1 - nu^2)) [force * length].
inline double solid_rigidity(const Moduli &moduli, const double thickness)
{
  return thickness * thickness / 12. * (moduli.bulk + moduli.shear);
}

/// @throws InvalidParameter  unless all four constants are positive and finite.
inline void require_valid(const Sheet &sheet)
{
  internal::require_positive_moduli(sheet.moduli, "sheet");
  if (!(std::isfinite(sheet.bending) && sheet.bending > 0. && std::isfinite(sheet.thickness) && sheet.thickness > 0.))
    throw InvalidParameter("sheet: bending modulus c = " + print(sheet.bending) +
                           " and thickness T = " + print(sheet.thickness) + " must be positive and finite");
}

/// @throws InvalidParameter  unless the bending modulus is that of a solid sheet, to 1e-9 of it.
inline void require_solid(const Sheet &sheet, const std::string &where)
{
  require_valid(sheet);
  const double solid = solid_rigidity(sheet.moduli, sheet.thickness);
  if (!(std::abs(sheet.bending - solid) <= 1e-9 * solid))
    throw InvalidParameter(where + ": bending modulus c = " + print(sheet.bending) +
                           " given, but layers of thickness " + print(sheet.thickness) +
                           " have c = (K + G) T^2 / 12 = " + print(solid) +
                           "; use that, or a split that takes a bending law");
}

/// Sheet from the moduli of the surface, K and G [force/length], its bending modulus [force * length] and thickness.
/// @throws InvalidParameter  unless all four are positive and finite.
inline Sheet sheet_by_moduli(const double bulk, const double shear, const double bending, const double thickness)
{
  const Sheet sheet{{bulk, shear}, bending, thickness};
  require_valid(sheet);
  return sheet;
}

/// Sheet from E_2D [force/length] and nu of the surface, with the bending modulus of a solid sheet.
/// @throws InvalidParameter  unless E_2D > 0, -1 < nu < 1, thickness > 0.
inline Sheet sheet_by_surface(const double E, const double nu, const double thickness)
{
  const Moduli moduli = surface_moduli(E, nu);
  return sheet_by_moduli(moduli.bulk, moduli.shear, solid_rigidity(moduli, thickness), thickness);
}

/// Sheet of a solid with E [force/area] and nu in plane stress, with the bending modulus E T^3 / (12 (1 - nu^2)).
/// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2, thickness > 0.
inline Sheet sheet_of_solid(const double E, const double nu, const double thickness)
{
  const Moduli moduli = plane_stress_moduli(E, nu, thickness);
  return sheet_by_moduli(moduli.bulk, moduli.shear, solid_rigidity(moduli, thickness), thickness);
}

} // namespace sherd::material
