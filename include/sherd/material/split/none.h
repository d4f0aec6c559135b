#pragma once

#include <sherd/material/bending.h>
#include <sherd/material/neo_hooke.h>
#include <sherd/material/sheet.h>
#include <sherd/material/split/split.h>

#include <concepts>

namespace sherd::split
{

/// No split, theory B.4 (1): all elastic energy is active, in compression too.
template <MembraneLaw Membrane, BendingLaw Bending = material::NoBending>
class None
{
public:
  explicit None(const Membrane &membrane, const Bending &bending = {}) : membrane_(membrane), bending_(bending) {}

  /// A shell of which everything is known.
  /// @throws InvalidParameter  for constants that are not positive and finite.
  explicit None(const material::Sheet &sheet) requires(
      std::constructible_from<Membrane, material::Moduli> &&std::constructible_from<Bending, material::Sheet>)
      : None(Membrane(sheet.moduli), Bending(sheet))
  {
  }

  const Membrane &membrane() const { return membrane_; }
  const Bending  &bending() const { return bending_; }
  double          bulk() const { return membrane_.bulk(); }   ///< K [force/length]
  double          shear() const { return membrane_.shear(); } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    const Response<2> active = membrane_.respond(point);
    return {active.energy, 0., active.stress, Stress<2>::zero(), active.tangent, Tangent<2>::zero(), active.stress};
  }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    const Response<2>     membrane = membrane_.respond(point);
    const BendingResponse bending  = bending_.bend(point);
    const Stress<3>       stress{membrane.stress.membrane, bending.moment};
    const Tangent<3>      tangent{membrane.tangent.membrane, Voigt4::Zero(), Voigt4::Zero(), bending.stiffness};
    return {membrane.energy + bending.energy, 0., stress, Stress<3>::zero(), tangent, Tangent<3>::zero(), stress};
  }

private:
  Membrane                      membrane_;
  [[no_unique_address]] Bending bending_;
};

static_assert(EnergySplit<None<material::NeoHooke>, 2> && EnergySplit<None<material::NeoHooke>, 3>);

} // namespace sherd::split
