#pragma once

#include <concepts>
#include <vector>

namespace sherd
{

/// Part that a known motion (x, v, a) has in what a stage starts from:
///   X += x_of_x x + x_of_v dt v + x_of_a dt^2 a,  V += v_of_v v + v_of_a dt a.
/// Over all motions x_of_x add up to 1, and so do v_of_v.
struct StartWeights
{
  double x_of_x = 0., x_of_v = 0., x_of_a = 0.;
  double v_of_v = 0., v_of_a = 0.;
};

/// One implicit solve of a step that begins at t_n; it ends at t_n + dt, and its end is called "new" here:
///
///   x_new = X + beta dt^2 a_new,  v_new = V + gamma dt a_new,
///   M a_{alpha_m} + f_int(x_{alpha_f}, phi_new) = f_ext(t_n + alpha_f dt, x_{alpha_f}),
///
/// where y_alpha = (1 - alpha) y_n + alpha y_new, and X, V are combinations of the motion at t_n and of the one at the
/// end of the stage before. The phase equation is solved at (x_{alpha_f}, phi_new): one configuration, second order in
/// x (theory F.1 A).
///
/// A step has one stage or several; the last one ends where the step does. Source: theory F.
struct Stage
{
  double       dt; ///< from the start of the step to the end of the stage [time]
  double       alpha_m, alpha_f, gamma, beta;
  StartWeights start;    ///< of the motion at the start of the step
  StartWeights before{}; ///< of the motion at the end of the stage before

  /// Whether the balance has an inertial force; if not (alpha_m = 0), velocity and acceleration stay zero.
  bool has_inertia() const { return alpha_m != 0.; }

  /// Weight of M in the tangent with respect to x_{alpha_f}, alpha_m / (alpha_f beta dt^2) (theory F.2).
  double mass_weight() const { return alpha_m / (alpha_f * beta * dt * dt); }
};

using Stages = std::vector<Stage>;

/// Newmark's update formulas, those of the family that contains generalized-alpha:
///   x_new = x_n + dt v_n + dt^2 [(1/2 - beta) a_n + beta a_new],  v_new = v_n + dt [(1 - gamma) a_n + gamma a_new].
inline Stage newmark_stage(double dt, double alpha_m, double alpha_f, double gamma, double beta)
{
  return {dt, alpha_m, alpha_f, gamma, beta, {1., 1., .5 - beta, 1., 1. - gamma}};
}

/// A rule that gives the stages of a step from its size and the size of the one before it.
///
/// stages(dt, previous_dt): previous_dt = dt in the first step. Integrators stay out of kernels, which see only levels
/// and the mass weight.
template <class Rule>
concept TimeIntegrator = requires(const Rule &rule, double dt)
{
  {
    rule.stages(dt, dt)
    } -> std::same_as<Stages>;
};

/// A rule whose single stage has beta = 0: x_new is known before forces are. It says so by `is_explicit`.
template <class Rule>
concept ExplicitIntegrator = TimeIntegrator<Rule> && requires
{
  requires Rule::is_explicit;
};

/// A rule whose stages have to be solved for displacement and phase.
template <class Rule>
concept ImplicitIntegrator = TimeIntegrator<Rule> && !ExplicitIntegrator<Rule>;

} // namespace sherd
