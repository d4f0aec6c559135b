#pragma once

#include <sherd/material/neo_hooke.h>
#include <sherd/material/split/split.h>

namespace sherd::split
{

/// Split by the sign of J - 1, theory B.4 (2); paper Eqs. (10) and (11): distortion is always active, change of area
/// only where the surface is stretched.
///
/// Energy and stress are continuous at J = 1, where Psi_dil and its stress vanish; the tangent jumps.
template <MembraneLaw Membrane, class Bending = material::NoBending>
class SurfaceStretch
{
public:
  /// J counts as stretched down to 1 minus this, so that rounding does not toggle the stiffness of an unloaded crack.
  static constexpr double tolerance = 1e-12;

  explicit SurfaceStretch(const Membrane &membrane, const Bending &bending = {})
      : membrane_(membrane), bending_(bending)
  {
  }

  const Membrane &membrane() const { return membrane_; }
  const Bending  &bending() const { return bending_; }
  double          bulk() const { return membrane_.bulk(); }   ///< K [force/length]
  double          shear() const { return membrane_.shear(); } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    const Response<2> dilatation = membrane_.dilatation(point), deviator = membrane_.deviator(point);
    if (point.J_minus_1 < -tolerance)
      return {deviator.energy,  dilatation.energy,  deviator.stress, dilatation.stress,
              deviator.tangent, dilatation.tangent, deviator.stress};
    const Response<2> active = dilatation + deviator;
    return {active.energy, 0., active.stress, Stress<2>::zero(), active.tangent, Tangent<2>::zero(), active.stress};
  }

private:
  Membrane                      membrane_;
  [[no_unique_address]] Bending bending_;
};

static_assert(EnergySplit<SurfaceStretch<material::NeoHooke>, 2>);

} // namespace sherd::split
