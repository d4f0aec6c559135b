#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/membrane.h>
#include <sherd/material/plane_stress.h>

#include <cmath>
#include <string>

namespace sherd::material
{

/// St. Venant-Kirchhoff membrane in plane stress, the membrane part of Koiter's shell, theory B.5:
///
///   Psi = K/2 (tr eps)^2 + G dev eps : dev eps,   eps_ab = (a_ab - A_ab) / 2,   tau^ab = C^abcd eps_cd,   c = C.
///
/// Energy [force/length] and stress [force/length] keep their relative accuracy at small strains. It softens in
/// compression and has no energy barrier at J = 0: a law for large rotations and small strains. Its trace part does
/// not vanish where J = 1, so that it takes no part in splits by the surface stretch.
class StVenantKirchhoff
{
public:
  /// @param moduli  from surface_moduli(E, nu), plane_stress_moduli(E, nu, thickness) or by hand.
  /// @throws InvalidParameter  unless both moduli are positive and finite.
  explicit StVenantKirchhoff(const Moduli &moduli) : moduli_(moduli)
  {
    require_positive(moduli.bulk, "bulk modulus K");
    require_positive(moduli.shear, "shear modulus G");
  }

  double bulk() const { return moduli_.bulk; }   ///< K [force/length]
  double shear() const { return moduli_.shear; } ///< G [force/length]

  Response<2> respond(const SurfacePoint<2> &point) const
  {
    const double K = moduli_.bulk, G = moduli_.shear, trace = .5 * point.I1_minus_2;
    return {.5 * K * trace * trace + .5 * G * point.deviator_squared,
            {K * trace * point.reference.metric.contravariant + G * point.deviator},
            {plane_stress_tensor(moduli_, point.reference.metric)}};
  }

private:
  static void require_positive(const double value, const std::string &name)
  {
    if (!(std::isfinite(value) && value > 0.))
      throw InvalidParameter("St. Venant-Kirchhoff membrane: " + name + " = " + print(value) +
                             " must be positive and finite");
  }

  Moduli moduli_;
};

static_assert(MembraneLaw<StVenantKirchhoff> && !SeparableMembraneLaw<StVenantKirchhoff>);

} // namespace sherd::material
