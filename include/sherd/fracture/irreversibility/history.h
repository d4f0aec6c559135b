#pragma once

#include <sherd/fracture/irreversibility/irreversibility.h>

namespace sherd::irreversibility
{

/// History field H = max over time of the active energy, theory D; paper Eq. (8). The memory is H.
///
/// It keeps the driving energy from falling. That the phase itself does not rise is not enforced at every point.
struct History
{
  double trial(const double memory, const double energy) const { return internal::greater(energy, memory); }
  bool   is_loading(const double memory, const double energy) const { return energy > memory; }
  double resistance(const double, const double) const { return 0.; }
  double resistance_stiffness(const double, const double) const { return 0.; }
  double commit(const double memory, const double energy, const double) const { return trial(memory, energy); }
  double initial(const double energy, const double) const { return energy; }
};

static_assert(Irreversibility<History>);

} // namespace sherd::irreversibility
