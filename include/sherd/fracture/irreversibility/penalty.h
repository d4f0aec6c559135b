#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/irreversibility/irreversibility.h>

#include <algorithm>
#include <cmath>

namespace sherd::irreversibility
{

/// A penalty on healing, theory D: the energy gamma/2 <phi - phi_n>_+^2 by area with gamma = factor Gc / l0. The
/// present energy drives the phase.
///
/// The memory is the greatest damage of the past, d = max(1 - phi) over the accepted steps. The phase rises above the
/// smallest of the past by a share of about 1 / factor of what it would without the penalty; the force is conservative
/// while nothing heals. A pre-crack is remembered by its phase, which must then have its optimal profile.
class Penalty
{
public:
  Penalty() : Penalty(300.) {}

  /// @param factor  gamma l0 / Gc, positive and finite; 1e2 to 1e3 is usual.
  /// @throws InvalidParameter  otherwise.
  explicit Penalty(const double factor) : factor_(factor)
  {
    if (!(std::isfinite(factor) && factor > 0.))
      throw InvalidParameter("irreversibility by penalty: factor " + print(factor) +
                             " must be positive and finite; 1e2 to 1e3 is usual");
  }

  double factor() const { return factor_; }

  double trial(const double, const double energy) const { return energy; }
  bool   is_loading(const double, const double) const { return true; }

  /// factor <phi - (1 - d)>_+
  double resistance(const double memory, const double phi) const
  {
    return factor_ * internal::greater(phi - (1. - memory), 0.);
  }
  double resistance_stiffness(const double memory, const double phi) const { return phi > 1. - memory ? factor_ : 0.; }

  double commit(const double memory, const double, const double phi) const
  {
    return internal::greater(1. - phi, memory);
  }
  double initial(const double, const double phi) const { return std::max(0., 1. - phi); }

private:
  double factor_;
};

static_assert(Irreversibility<Penalty>);

} // namespace sherd::irreversibility
