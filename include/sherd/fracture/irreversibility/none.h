#pragma once

#include <sherd/fracture/irreversibility/irreversibility.h>

namespace sherd::irreversibility
{

/// No memory: the present energy drives the phase, and cracks heal when unloaded.
///
/// For studies in which nothing unloads. An initial history is forgotten too, so that a pre-crack must be part of the
/// geometry or of the supports.
struct None
{
  double trial(const double, const double energy) const { return energy; }
  bool   is_loading(const double, const double) const { return true; }
  double resistance(const double, const double) const { return 0.; }
  double resistance_stiffness(const double, const double) const { return 0.; }
  double commit(const double, const double, const double) const { return 0.; }
  double initial(const double, const double) const { return 0.; }
};

static_assert(Irreversibility<None>);

} // namespace sherd::irreversibility
