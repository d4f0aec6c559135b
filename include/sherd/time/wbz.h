#pragma once

#include <sherd/time/alpha_family.h>

namespace sherd
{

namespace internal
{
inline alpha_family::Levels wbz_levels(double rho_inf)
{
  return {2. / (1. + alpha_family::spectral_radius("WBZ", rho_inf)), 1.};
}
} // namespace internal

/// WBZ with the constants of constant steps. It falls to first order when the step size changes; kept for comparison.
class PlainWBZ
{
public:
  /// @throws InvalidParameter   unless 0 <= rho_inf <= 1
  explicit PlainWBZ(double rho_inf = .5) : levels_(internal::wbz_levels(rho_inf)) {}

  Stages stages(double dt, double) const { return alpha_family::constant_steps(levels_, dt); }

private:
  alpha_family::Levels levels_;
};

/// Scheme of Wood, Bossak and Zienkiewicz: forces and phase at the end of the step, inertia at alpha_m = 2 / (1 + rho).
/// So phi_{n+1} belongs to t_{n+1} (theory F.1). Second order for any sequence of step sizes.
///
/// Source: theory F.
class WBZ
{
public:
  /// @throws InvalidParameter   unless 0 <= rho_inf <= 1
  explicit WBZ(double rho_inf = .5) : levels_(internal::wbz_levels(rho_inf)) {}

  Stages stages(double dt, double previous_dt) const { return alpha_family::changing_steps(levels_, dt, previous_dt); }

private:
  alpha_family::Levels levels_;
};

static_assert(ImplicitIntegrator<PlainWBZ>);
static_assert(ImplicitIntegrator<WBZ>);

} // namespace sherd
