#pragma once

#include <concepts>

namespace sherd
{

/// One implicit step n -> n+1 of the family that contains generalized-alpha and Newmark. With
/// y_{n+alpha} = (1 - alpha) y_n + alpha y_{n+1}:
///
///   x_{n+1} = x_n + dt v_n + dt^2 [(1/2 - beta) a_n + beta a_{n+1}],
///   v_{n+1} = v_n + dt [(1 - gamma) a_n + gamma a_{n+1}],
///   M a_{n+alpha_m} + f_int(x_{n+alpha_f}, phi_{n+1}) = f_ext(t_{n+alpha_f}, x_{n+alpha_f}).
///
/// The phase equation is solved at (x_{n+alpha_f}, phi_{n+1}): one configuration, second order in x (theory F.1 A).
///
/// Source: theory F.
struct Stage
{
  double dt; ///< [time]
  double alpha_m, alpha_f, gamma, beta;

  /// Whether the balance has an inertial force; if not (alpha_m = 0), velocity and acceleration stay zero.
  bool has_inertia() const { return alpha_m != 0.; }

  /// Weight of M in the tangent with respect to x_{n+alpha_f}, alpha_m / (alpha_f beta dt^2) (theory F.2).
  double mass_weight() const { return alpha_m / (alpha_f * beta * dt * dt); }
};

/// A rule that gives the coefficients of a step from its size and the size of the one before it.
///
/// stage(dt, previous_dt): previous_dt = dt in the first step. Integrators stay out of kernels, which see only levels
/// and the mass weight.
template <class Rule>
concept TimeIntegrator = requires(const Rule &rule, double dt)
{
  {
    rule.stage(dt, dt)
    } -> std::same_as<Stage>;
};

} // namespace sherd
