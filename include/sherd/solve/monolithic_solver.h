#pragma once

#include <sherd/solve/solver_base.h>
#include <sherd/time/integrator.h>

namespace sherd
{

/// Solves displacement and phase of each stage of an implicit step together by Newton's method, and makes sure that
/// what it converged to is a stable state.
///
/// A stage: predictor (constant velocity, linearly extrapolated phase), Newton on (dy, dphi) with dy = alpha_f dx
/// (theory F.2), branch check; if the check fails a branch switch at the same step size (theory C.2). A state that
/// fails both, or that does not converge, or that is not finite, or in which an element has turned inside out (theory
/// F.4) is never returned. NewtonSettings choose the tangent and a line search; n_NR counts tangents as NewtonIteration
/// does.
///
/// The arguments of the constructor have to outlive the solver.
template <class Model, ImplicitIntegrator Integrator>
class MonolithicSolver : public SolverBase<Model, Unknowns::all>
{
public:
  using Base      = SolverBase<Model, Unknowns::all>;
  using StateType = typename Base::StateType;
  using Result    = typename Base::Result;

  MonolithicSolver(const Model &model, const ShellSpace<Model::degree, Model::spacedim> &space,
                   const Supports &supports, const Loads<Model::spacedim> &loads, const Integrator &integrator,
                   const NewtonSettings &settings)
      : Base(model, space, supports, loads, settings), integrator_(integrator)
  {
  }

  /// Solves M a = f_ext - f_int at the time of @p state. Collective.
  /// @throws InvalidParameter   a velocity that the supports do not allow, complete_velocity()
  void set_initial_acceleration(StateType &state);

  /// Attempts the step from @p state to state.time + dt. Collective. Throws only what no smaller step could mend.
  Result attempt(const StateType &state, double dt);

private:
  Integrator integrator_;
};

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::set_initial_acceleration(StateType &state)
{
  const auto timing = this->timers().measure("initial state");
  this->newton_.forget_tangent();
  this->equations_.set_initial_acceleration(state, this->newton_.matrix());
}

template <class Model, ImplicitIntegrator Integrator>
auto MonolithicSolver<Model, Integrator>::attempt(const StateType &state, double dt) -> Result
{
  const auto timing = this->timers().measure("step");
  const auto stages = integrator_.stages(dt, this->equations_.previous_step(state, dt));
  return this->equations_.take_stages(state, dt, stages, [this](auto &system, Result &result) {
    return this->newton_.find_stable_state(this->equations_, system, result);
  });
}

} // namespace sherd
