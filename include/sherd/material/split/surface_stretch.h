#pragma once

#include <sherd/material/neo_hooke.h>
#include <sherd/material/sheet.h>
#include <sherd/material/split/bending_share.h>

#include <concepts>

namespace sherd::split
{

/// Split by the sign of the surface stretch less 1, theory B.4 (2); paper Eqs. (10) and (11).
///
/// Membrane: distortion is always active, change of area only where the surface is stretched, J >= 1. Energy and stress
/// are continuous at J = 1, where Psi_dil and its stress vanish; the tangent jumps.
///
/// Bending: Psi_b is shared among the layers of the thickness and active in the stretched ones, see BendingShare. A
/// shell much thinner than its wrinkles better has all of bending active: with a frozen cut a broken element that flaps
/// between tension and compression makes energy (doc/theory B.4).
template <SeparableMembraneLaw Membrane, BendingLaw Bending = material::NoBending>
class SurfaceStretch
{
public:
  /// J counts as stretched down to 1 minus this, so that rounding does not toggle the stiffness of an unloaded crack.
  static constexpr double tolerance = LayerStretch::tolerance;

  /// A membrane.
  explicit SurfaceStretch(const Membrane &membrane) requires std::same_as<Bending, material::NoBending>
      : membrane_(membrane), bending_({}, BendingPart::active)
  {
  }

  /// A shell.
  /// @throws InvalidParameter  for layers that are not valid.
  SurfaceStretch(const Membrane &membrane, const Bending &bending, const LayerSettings &layers)
      : membrane_(membrane), bending_(bending, layers)
  {
  }

  /// A shell whose bending is active as a whole, or not at all.
  SurfaceStretch(const Membrane &membrane, const Bending &bending, const BendingPart part)
      : membrane_(membrane), bending_(bending, part)
  {
  }

  /// A shell of which everything is known, with the default settings of layers.
  /// @throws InvalidParameter  for constants that are not positive and finite.
  explicit SurfaceStretch(const material::Sheet &sheet) requires(
      std::constructible_from<Membrane, material::Moduli> &&std::constructible_from<Bending, material::Sheet>)
      : SurfaceStretch(Membrane(sheet.moduli), Bending(sheet), LayerSettings{.thickness = sheet.thickness})
  {
  }

  const Membrane      &membrane() const { return membrane_; }
  const Bending       &bending() const { return bending_.bending(); }
  const LayerSettings &layers() const { return bending_.layers(); }
  double               bulk() const { return membrane_.bulk(); }   ///< K [force/length]
  double               shear() const { return membrane_.shear(); } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    const Response<2> dilatation = membrane_.dilatation(point), deviator = membrane_.deviator(point);
    if (point.J_minus_1 < -tolerance)
      return {deviator.energy,  dilatation.energy,  deviator.stress, dilatation.stress,
              deviator.tangent, dilatation.tangent, deviator.stress};
    const Response<2> active = dilatation + deviator;
    return {active.energy, 0., active.stress, Stress<2>::zero(), active.tangent, Tangent<2>::zero(), active.stress};
  }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    return bending_.respond(point, respond(static_cast<const SurfacePoint<2> &>(point)));
  }

private:
  Membrane              membrane_;
  BendingShare<Bending> bending_;
};

static_assert(EnergySplit<SurfaceStretch<material::NeoHooke>, 2> && EnergySplit<SurfaceStretch<material::NeoHooke>, 3>);

} // namespace sherd::split
