#pragma once

#include <sherd/material/neo_hooke.h>
#include <sherd/material/split/split.h>

namespace sherd::split
{

/// No split, theory B.4 (1): all elastic energy is active, in compression too.
template <MembraneLaw Membrane, class Bending = material::NoBending>
class None
{
public:
  explicit None(const Membrane &membrane, const Bending &bending = {}) : membrane_(membrane), bending_(bending) {}

  const Membrane &membrane() const { return membrane_; }
  const Bending  &bending() const { return bending_; }
  double          bulk() const { return membrane_.bulk(); }   ///< K [force/length]
  double          shear() const { return membrane_.shear(); } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    const Response<2> active = membrane_.dilatation(point) + membrane_.deviator(point);
    return {active.energy, 0., active.stress, Stress<2>::zero(), active.tangent, Tangent<2>::zero(), active.stress};
  }

private:
  Membrane                      membrane_;
  [[no_unique_address]] Bending bending_;
};

static_assert(EnergySplit<None<material::NeoHooke>, 2>);

} // namespace sherd::split
