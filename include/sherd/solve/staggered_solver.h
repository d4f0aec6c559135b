#pragma once

#include <sherd/solve/solver_base.h>
#include <sherd/time/integrator.h>

namespace sherd
{

/// Solves each stage of an implicit step by alternate minimisation: the displacement at a given phase, then the phase
/// at that displacement, until both residuals of MonolithicSolver are below its tolerances at once. So both solve the
/// same discrete problem. Each half is Newton's method on its unknowns alone, with matrices of their blocks only; that
/// of the phase checks and switches its branch (theory C.2).
///
/// Aitken's relaxation lets the phase go on along its last change: with the change r_k that the k-th alternation would
/// make, phi_{k+1} = phi_k + w_k r_k, w_k = -w_{k-1} r_{k-1}.(r_k - r_{k-1}) / |r_k - r_{k-1}|^2 in [0.5, 5].
///
/// StepResult::alternations counts the alternations of all stages, StepResult::newton is the largest count of one half.
/// The arguments of the constructor have to outlive the solver.
///
/// Source: theory F.6.
template <class Model, ImplicitIntegrator Integrator>
class StaggeredSolver : public SolverBase<Model, Unknowns::phase>
{
public:
  using Base      = SolverBase<Model, Unknowns::phase>;
  using StateType = typename Base::StateType;
  using Result    = typename Base::Result;
  using System    = typename Base::System;

  StaggeredSolver(const Model &model, const ShellSpace<Model::degree, Model::spacedim> &space, const Supports &supports,
                  const Loads<Model::spacedim> &loads, const Integrator &integrator, const NewtonSettings &settings)
      : Base(model, space, supports, loads, settings), integrator_(integrator), displacement_newton_(settings)
  {
  }

  /// As SolverBase::rebuild. Collective.
  void rebuild(const StateType &state);

  /// Solves M a = f_ext - f_int at the time of @p state. Collective.
  /// @throws InvalidParameter   a velocity that the supports do not allow, complete_velocity()
  void set_initial_acceleration(StateType &state);

  /// Attempts the step from @p state to state.time + dt. Collective. Throws only what no smaller step could mend.
  Result attempt(const StateType &state, double dt);

private:
  bool alternate(System &system, Result &result);

  Integrator                                     integrator_;
  NewtonIteration<Model, Unknowns::displacement> displacement_newton_;

  std::vector<char> all_but_displacement_, all_but_phase_; ///< fixed unknowns, shape=(n_owned * n_fields)
};

namespace internal
{

/// Aitken's factor for the change @p r after the change @p before, which was taken @p factor times.
inline double aitken_factor(double factor, const Vector &before, const Vector &r)
{
  constexpr double smallest = .5, largest = 5.;
  Vector           difference = r;
  axpy(-1., before, difference);
  const double square = dot(difference, difference);
  return square > 0. ? std::clamp(-factor * dot(before, difference) / square, smallest, largest) : 1.;
}

} // namespace internal

template <class Model, ImplicitIntegrator Integrator>
void StaggeredSolver<Model, Integrator>::rebuild(const StateType &state)
{
  Base::rebuild(state);
  displacement_newton_.rebuild(this->equations_);
  all_but_displacement_ = all_but_phase_ = this->equations_.supported().fixed();
  for (std::size_t k = 0; k < all_but_phase_.size(); ++k)
    (k % Model::n_fields == Model::spacedim ? all_but_displacement_ : all_but_phase_)[k] = 1;
}

template <class Model, ImplicitIntegrator Integrator>
void StaggeredSolver<Model, Integrator>::set_initial_acceleration(StateType &state)
{
  const auto timing = this->timers().measure("initial state");
  displacement_newton_.forget_tangent();
  this->equations_.template set_initial_acceleration<Unknowns::displacement>(state, displacement_newton_.matrix());
}

template <class Model, ImplicitIntegrator Integrator>
auto StaggeredSolver<Model, Integrator>::attempt(const StateType &state, double dt) -> Result
{
  const auto timing = this->timers().measure("step");
  const auto stages = integrator_.stages(dt, this->equations_.previous_step(state, dt));
  return this->equations_.take_stages(state, dt, stages,
                                      [this](System &system, Result &result) { return alternate(system, result); });
}

template <class Model, ImplicitIntegrator Integrator>
bool StaggeredSolver<Model, Integrator>::alternate(System &system, Result &result)
{
  auto                 &equations = this->equations_;
  const auto           &settings  = equations.settings();
  const auto           &fixed     = *system.fixed;
  double                factor    = 1.;
  std::optional<Vector> change_before;
  int                   largest_count = 0;
  const auto            counted       = [&](bool solved) {
    largest_count = std::max(largest_count, std::exchange(result.newton, 0));
    return solved;
  };
  const auto half = [&](const std::vector<char> &held, const auto &solve) {
    system.fixed       = &held;
    system.has_tangent = false;
    const bool solved  = counted(solve());
    system.fixed       = &fixed;
    return solved;
  };
  try
    {
      for (int i = 0; i < settings.alternation.max_alternations; ++i)
        {
          ++result.alternations;
          const Vector phase = system.phase;
          if (!half(all_but_displacement_, [&] { return displacement_newton_.iterate(equations, system, result); }) ||
              !half(all_but_phase_, [&] { return this->newton_.find_stable_state(equations, system, result); }))
            return false;
          const auto norms = equations.evaluate(system);
          result.residuals.push_back(norms.larger());
          if (!(norms.larger() > 1.))
            {
              if (std::isnan(norms.larger()))
                result.failure = "the residual is not finite after " + std::to_string(i + 1) + " alternations";
              result.newton = largest_count;
              return result.failure.empty();
            }
          if (settings.alternation.relaxation == Relaxation::none)
            continue;
          Vector change = system.phase;
          axpy(-1., phase, change);
          if (change_before)
            factor = internal::aitken_factor(factor, *change_before, change);
          system.phase = phase;
          axpy(factor, change, system.phase);
          change_before = std::move(change);
        }
    }
  catch (const NoConvergence &error)
    {
      result.failure = error.what();
      return false;
    }
  result.failure = "displacement and phase do not agree after " +
                   std::to_string(settings.alternation.max_alternations) + " alternations";
  return false;
}

} // namespace sherd
