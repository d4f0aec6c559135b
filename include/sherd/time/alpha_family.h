#pragma once

#include <string>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/time/integrator.h>

/// Second-order members of the generalized-alpha family: each is a pair of levels.
namespace sherd::alpha_family
{

/// Levels at which momentum is balanced when the step size is constant.
struct Levels
{
  double alpha_m, alpha_f;
};

/// Constants of a constant step, gamma = 1/2 + alpha_m - alpha_f, beta = (1 + alpha_m - alpha_f)^2 / 4, whatever the
/// step size did before. The scheme falls to first order when the step size changes.
inline Stages constant_steps(const Levels &levels, double dt)
{
  const double difference = levels.alpha_m - levels.alpha_f;
  return {
      newmark_stage(dt, levels.alpha_m, levels.alpha_f, .5 + difference, .25 * (1. + difference) * (1. + difference))};
}

/// Constants for any sequence of steps. With delta = alpha_f - alpha_m, sigma = dt / previous_dt and
/// D = 1 + delta - delta/sigma,
///
///   alpha_m' = (alpha_f - delta/sigma) / D,  gamma = (1/2 - delta/sigma) / D,  beta = (gamma + 1/2)^2 / 4,
///
/// because a_n is the acceleration at t_n + delta * previous_dt. At sigma = 1 these are constant_steps().
///
/// Source: theory F (changing steps).
inline Stages changing_steps(const Levels &levels, double dt, double previous_dt)
{
  const double delta   = levels.alpha_f - levels.alpha_m;
  const double shifted = delta * previous_dt / dt;
  const double D       = 1. + delta - shifted;
  const double gamma   = (.5 - shifted) / D;
  return {newmark_stage(dt, (levels.alpha_f - shifted) / D, levels.alpha_f, gamma, .25 * (gamma + .5) * (gamma + .5))};
}

/// @p rho_inf, if it is in [0, 1]. @throws InvalidParameter   otherwise, in the name of @p scheme
inline double spectral_radius(const std::string &scheme, double rho_inf)
{
  if (!(rho_inf >= 0. && rho_inf <= 1.))
    throw InvalidParameter(scheme + ": spectral radius rho_inf = " + print(rho_inf) +
                           ", expected a value in [0, 1]; 0.5 is the default, 1 does not dissipate");
  return rho_inf;
}

} // namespace sherd::alpha_family
