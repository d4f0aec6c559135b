#pragma once

#include <sherd/fracture/degradation/degradation.h>

namespace sherd::degradation
{

/// Quadratic degradation g = phi^2, theory C.2.
///
/// Damage begins with the first load, but the phase equation is convex: it has one solution and no false branch.
struct Quadratic
{
  double value(const double phi) const { return phi * phi; } ///< g
  double first(const double phi) const { return 2. * phi; }  ///< g'
  double second(const double) const { return 2.; }           ///< g''
};

static_assert(Degradation<Quadratic>);

} // namespace sherd::degradation
