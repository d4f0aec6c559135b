#pragma once

#include <sherd/time/alpha_family.h>

namespace sherd
{

namespace internal
{
inline alpha_family::Levels generalized_alpha_levels(double rho_inf)
{
  const double rho = alpha_family::spectral_radius("generalized-alpha", rho_inf);
  return {(2. - rho) / (1. + rho), 1. / (1. + rho)};
}
} // namespace internal

/// Generalized-alpha with the constants of the table in theory F, whatever the step size did before. It falls to first
/// order when the step size changes; kept for comparison.
class PlainGeneralizedAlpha
{
public:
  /// @throws InvalidParameter   unless 0 <= rho_inf <= 1
  explicit PlainGeneralizedAlpha(double rho_inf = .5) : levels_(internal::generalized_alpha_levels(rho_inf)) {}

  Stages stages(double dt, double) const { return alpha_family::constant_steps(levels_, dt); }

private:
  alpha_family::Levels levels_;
};

/// Generalized-alpha of Chung and Hulbert, alpha_m = (2 - rho) / (1 + rho) and alpha_f = 1 / (1 + rho), second order
/// for any sequence of step sizes. @p rho_inf is the spectral radius at high frequency: 1 keeps all energy, 0 kills the
/// highest frequencies in one step.
///
/// Source: theory F.
class GeneralizedAlpha
{
public:
  /// @throws InvalidParameter   unless 0 <= rho_inf <= 1
  explicit GeneralizedAlpha(double rho_inf = .5) : levels_(internal::generalized_alpha_levels(rho_inf)) {}

  Stages stages(double dt, double previous_dt) const { return alpha_family::changing_steps(levels_, dt, previous_dt); }

private:
  alpha_family::Levels levels_;
};

static_assert(ImplicitIntegrator<PlainGeneralizedAlpha>);
static_assert(ImplicitIntegrator<GeneralizedAlpha>);

} // namespace sherd
