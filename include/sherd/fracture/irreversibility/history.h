#pragma once

#include <sherd/fracture/irreversibility/irreversibility.h>

namespace sherd::irreversibility
{

/// History field H = max over time of the active energy, theory D; paper Eq. (8).
///
/// It keeps the driving energy from falling. That the phase itself does not rise is not enforced at every point.
struct History
{
  double trial(const double accepted, const double energy) const
  {
    // The last case is that of a value that is no number: it must not vanish in the comparison.
    return energy > accepted ? energy : energy <= accepted ? accepted : energy + accepted;
  }
  bool is_loading(const double accepted, const double energy) const { return energy > accepted; }
};

static_assert(Irreversibility<History>);

} // namespace sherd::irreversibility
