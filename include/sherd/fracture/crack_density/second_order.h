#pragma once

#include <sherd/fracture/crack_density/crack_density.h>

#include <cmath>

namespace sherd::crack_density
{

/// Second-order density (AT2), theory C.1. Its profile has a kink at the crack; phi stays in [0, 1].
struct SecondOrder : QuadraticLocal
{
  static constexpr int order = 2;

  double c1(const double l0) const { return 4. * l0 * l0; } ///< 4 l0^2
  double c2(const double) const { return 0.; }

  /// 1 - exp(-r / 2) at r = distance / l0.
  double profile(const double r) const { return -std::expm1(-.5 * r); }
};

static_assert(CrackDensity<SecondOrder>);

} // namespace sherd::crack_density
