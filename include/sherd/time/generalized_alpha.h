#pragma once

#include <string>

#include <sherd/base/exceptions.h>
#include <sherd/time/integrator.h>

namespace sherd
{

namespace internal
{
inline double spectral_radius_in_range(double rho_inf)
{
  if (!(rho_inf >= 0. && rho_inf <= 1.))
    throw InvalidParameter("generalized-alpha: spectral radius rho_inf = " + std::to_string(rho_inf) +
                           ", expected a value in [0, 1]; 0.5 is the default, 1 does not dissipate");
  return rho_inf;
}
} // namespace internal

/// Generalized-alpha with the constants of the table in theory F, whatever the step size did before. It falls to first
/// order when the step size changes; kept for comparison.
class PlainGeneralizedAlpha
{
public:
  /// @throws InvalidParameter   unless 0 <= rho_inf <= 1
  explicit PlainGeneralizedAlpha(double rho_inf = .5)
      : alpha_m_((2. - internal::spectral_radius_in_range(rho_inf)) / (1. + rho_inf)), alpha_f_(1. / (1. + rho_inf))
  {
  }

  Stage stage(double dt, double) const
  {
    const double difference = alpha_m_ - alpha_f_;
    return {dt, alpha_m_, alpha_f_, .5 + difference, .25 * (1. + difference) * (1. + difference)};
  }

private:
  double alpha_m_, alpha_f_;
};

/// Generalized-alpha for changing steps: second order for any sequence of step sizes. With delta = alpha_f - alpha_m,
/// sigma = dt / previous_dt and D = 1 + delta - delta/sigma,
///
///   alpha_m = (alpha_f - delta/sigma) / D,  gamma = (1/2 - delta/sigma) / D,  beta = (gamma + 1/2)^2 / 4,
///
/// because a_n is the acceleration at t_n + delta * previous_dt. At sigma = 1 these are the constants of
/// PlainGeneralizedAlpha. @p rho_inf is the spectral radius at high frequency: 1 keeps all energy, 0 kills the highest
/// frequencies in one step.
///
/// Source: theory F (changing steps).
class GeneralizedAlpha
{
public:
  /// @throws InvalidParameter   unless 0 <= rho_inf <= 1
  explicit GeneralizedAlpha(double rho_inf = .5) : plain_(rho_inf) {}

  Stage stage(double dt, double previous_dt) const
  {
    Stage        s       = plain_.stage(dt, dt);
    const double delta   = s.alpha_f - s.alpha_m;
    const double shifted = delta * previous_dt / dt;
    const double D       = 1. + delta - shifted;
    s.alpha_m            = (s.alpha_f - shifted) / D;
    s.gamma              = (.5 - shifted) / D;
    s.beta               = .25 * (s.gamma + .5) * (s.gamma + .5);
    return s;
  }

private:
  PlainGeneralizedAlpha plain_;
};

static_assert(TimeIntegrator<PlainGeneralizedAlpha>);
static_assert(TimeIntegrator<GeneralizedAlpha>);

} // namespace sherd
