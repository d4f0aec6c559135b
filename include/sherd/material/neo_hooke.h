#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/membrane.h>
#include <sherd/material/moduli.h>

#include <cmath>
#include <string>

namespace sherd::material
{

/// e - ln(1 + e) to full relative accuracy, e > -1; e^2/2 for small e.
///
/// Near zero from ln(1 + e) = 2 artanh(r), r = e / (2 + e), whose first term 2 r is e - e r.
inline double log_defect(const double e)
{
  if (!(std::abs(e) < .1))
    return e - std::log1p(e);
  const double r = e / (2. + e), q = r * r;
  const double tail = 1. / 3 + q * (1. / 5 + q * (1. / 7 + q * (1. / 9 + q * (1. / 11 + q * (1. / 13 + q / 15)))));
  return e * r - 2. * q * r * tail;
}

/// Neo-Hookean membrane, theory B.1; paper Eq. (3):
///
///   Psi_dil = K/4 (J^2 - 1 - 2 ln J),   Psi_dev = G/2 (I1 / J - 2).
///
/// Both are evaluated without cancellation and keep their relative accuracy at small strains:
/// J^2 - 1 - 2 ln J = e^2 + 2 (e - ln(1 + e)) with e = J - 1, and I1 / J - 2 = 4 q / (J (I1 + 2 J)) with
/// q = (I1^2 - 4 J^2) / 4. The deviatoric stress follows from a^ab by the theorem of Cayley and Hamilton.
class NeoHooke
{
public:
  /// @param bulk, shear  K, G [force/length].
  /// @throws InvalidParameter  unless both are positive and finite.
  NeoHooke(const double bulk, const double shear) : K_(bulk), G_(shear)
  {
    require_positive(bulk, "bulk modulus K");
    require_positive(shear, "shear modulus G");
  }

  /// From surface_moduli(E, nu), plane_stress_moduli(E, nu, thickness) or plane_strain_moduli(E, nu).
  explicit NeoHooke(const Moduli &moduli) : NeoHooke(moduli.bulk, moduli.shear) {}

  double bulk() const { return K_; }  ///< K [force/length]
  double shear() const { return G_; } ///< G [force/length]

  Response<2> respond(const SurfacePoint<2> &point) const { return dilatation(point) + deviator(point); }

  /// tau = K/2 (J^2 - 1) a^ab,  c = K [J^2 a^ab a^cd + (J^2 - 1) a^abcd].
  Response<2> dilatation(const SurfacePoint<2> &point) const
  {
    const double e = point.J_minus_1, JJ_minus_1 = e * (2. + e);
    const Voigt &a = point.metric.contravariant;
    return {.25 * K_ * (e * e + 2. * log_defect(e)),
            {.5 * K_ * JJ_minus_1 * a},
            {K_ * (point.J * point.J * a * a.transpose() + JJ_minus_1 * inverse_derivative(point.metric))}};
  }

  /// tau = G/J (A^ab - I1/2 a^ab) = G/J^3 (I1/2 D^ab - q A^ab),
  /// c = G/J [I1/2 a^ab a^cd - A^ab a^cd - a^ab A^cd - I1 a^abcd].
  Response<2> deviator(const SurfacePoint<2> &point) const
  {
    const double J = point.J, I1 = point.I1, q = point.deviator_squared;
    const Voigt &a = point.metric.contravariant, &A = point.reference.metric.contravariant;
    const Voigt  mixed = .25 * I1 * a - A;
    return {2. * G_ * q / (J * (I1 + 2. * J)),
            {G_ / (J * J * J) * (.5 * I1 * point.deviator - q * A)},
            {G_ / J * (mixed * a.transpose() + a * mixed.transpose() - I1 * inverse_derivative(point.metric))}};
  }

private:
  static void require_positive(const double value, const std::string &name)
  {
    if (!(std::isfinite(value) && value > 0.))
      throw InvalidParameter("neo-Hookean membrane: " + name + " = " + print(value) + " must be positive and finite");
  }

  double K_, G_;
};

static_assert(SeparableMembraneLaw<NeoHooke>);

} // namespace sherd::material
