#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/bending.h>
#include <sherd/material/plane_stress.h>
#include <sherd/material/sheet.h>

#include <cmath>
#include <string>

namespace sherd::material
{

/// Bending energy of Koiter's shell, theory B.5:
///
///   Psi_b = T^2/24 k C k = T^2/12 [K/2 (tr k)^2 + G dev k : dev k],   M_b = T^2/12 C k,   f_b = T^2/12 C
///
/// with C of the membrane in plane stress; indices are raised with A^ab. Energy and moment come from Cartesian
/// components of k, without cancellation.
class Koiter
{
public:
  /// @param moduli     K, G of the membrane [force/length], positive and finite.
  /// @param thickness  T [length].
  /// @throws InvalidParameter  for values outside these ranges.
  Koiter(const Moduli &moduli, const double thickness)
      : moduli_{thickness * thickness / 12. * moduli.bulk, thickness * thickness / 12. * moduli.shear}
  {
    require_positive(moduli.bulk, "bulk modulus K");
    require_positive(moduli.shear, "shear modulus G");
    require_positive(thickness, "thickness");
  }

  /// Sheet of a solid.
  /// @param E, nu      constants of the solid, E [force/area].
  /// @param thickness  T [length].
  /// @throws InvalidParameter  unless E > 0, -1 < nu < 1/2, thickness > 0.
  Koiter(const double E, const double nu, const double thickness)
      : Koiter(plane_stress_moduli(E, nu, thickness), thickness)
  {
  }

  /// Sheet with a bending modulus of its own: c stands for T^2/12 (K + G), Poisson's effect is that of K and G.
  /// @throws InvalidParameter  unless all constants are positive and finite.
  explicit Koiter(const Sheet &sheet) : moduli_(sheet.moduli)
  {
    require_valid(sheet);
    const double factor = sheet.bending / (sheet.moduli.bulk + sheet.moduli.shear);
    moduli_             = {factor * sheet.moduli.bulk, factor * sheet.moduli.shear};
  }

  /// Flexural rigidity D = T^2/12 (K + G) = E T^3 / (12 (1 - nu^2)) [force * length].
  double stiffness() const { return moduli_.bulk + moduli_.shear; }

  BendingResponse bend(const SurfacePoint<3> &point) const
  {
    const auto  &frame = point.reference.frame;
    const Voigt  k     = frame.pull(point.curvature_change);
    const double trace = k[0] + k[1], half = .5 * (k[0] - k[1]);
    const double pressure = moduli_.bulk * trace, twice_G = 2. * moduli_.shear;
    return {.5 * pressure * trace + twice_G * (half * half + k[2] * k[2]),
            frame.push(Voigt(pressure + twice_G * half, pressure - twice_G * half, twice_G * k[2])),
            plane_stress_tensor(moduli_, point.reference.metric)};
  }

private:
  static void require_positive(const double value, const std::string &name)
  {
    if (!(std::isfinite(value) && value > 0.))
      throw InvalidParameter("Koiter bending: " + name + " = " + print(value) + " must be positive and finite");
  }

  Moduli moduli_; ///< T^2/12 (K, G) [force * length]
};

static_assert(BendingLaw<Koiter>);

} // namespace sherd::material
