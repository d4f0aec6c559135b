#pragma once

#include <sherd/time/alpha_family.h>

namespace sherd
{

namespace internal
{
inline alpha_family::Levels hht_levels(double alpha)
{
  if (!(alpha >= -1. / 3. && alpha <= 0.))
    throw InvalidParameter("HHT: alpha = " + print(alpha) +
                           ", expected a value in [-1/3, 0]; 0 does not dissipate, -0.1 is usual; its spectral radius "
                           "at high frequency is (1 + alpha) / (1 - alpha)");
  return {1., 1. + alpha};
}
} // namespace internal

/// HHT with the constants of constant steps. It falls to first order when the step size changes; kept for comparison.
class PlainHHT
{
public:
  /// @throws InvalidParameter   unless -1/3 <= alpha <= 0
  explicit PlainHHT(double alpha = -.1) : levels_(internal::hht_levels(alpha)) {}

  Stages stages(double dt, double) const { return alpha_family::constant_steps(levels_, dt); }

private:
  alpha_family::Levels levels_;
};

/// Scheme of Hilber, Hughes and Taylor: inertia at the end of the step, forces at alpha_f = 1 + alpha. Its spectral
/// radius at high frequency is (1 + alpha) / (1 - alpha), 1/2 or more. Second order for any sequence of step sizes.
///
/// Source: theory F.
class HHT
{
public:
  /// @throws InvalidParameter   unless -1/3 <= alpha <= 0
  explicit HHT(double alpha = -.1) : levels_(internal::hht_levels(alpha)) {}

  Stages stages(double dt, double previous_dt) const { return alpha_family::changing_steps(levels_, dt, previous_dt); }

private:
  alpha_family::Levels levels_;
};

static_assert(ImplicitIntegrator<PlainHHT>);
static_assert(ImplicitIntegrator<HHT>);

} // namespace sherd
