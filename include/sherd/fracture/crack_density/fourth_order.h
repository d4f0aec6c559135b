#pragma once

#include <sherd/fracture/crack_density/crack_density.h>

#include <cmath>

namespace sherd::crack_density
{

/// Fourth-order density, theory C.1; paper Eq. (6). Needs C^1 shape functions.
///
/// Its profile is smooth at the crack, and phi may leave [0, 1] slightly: there is no maximum principle.
struct FourthOrder : QuadraticLocal
{
  static constexpr int order = 4;

  double c1(const double l0) const { return 2. * l0 * l0; }          ///< 2 l0^2
  double c2(const double l0) const { return (l0 * l0) * (l0 * l0); } ///< l0^4

  /// 1 - (1 + r) exp(-r) at r = distance / l0.
  double profile(const double r) const { return -std::expm1(-r) - r * std::exp(-r); }
};

static_assert(CrackDensity<FourthOrder>);

} // namespace sherd::crack_density
