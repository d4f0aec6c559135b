#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <sherd/base/print.h>
#include <sherd/solve/critical_step.h>
#include <sherd/solve/explicit_solver.h>

namespace sherd
{

template <class Model>
void ExplicitSolver<Model>::rebuild(const StateType &state)
{
  if (this->space().n_multipliers() > 0)
    throw InvalidParameter("explicit solver: the space keeps patches together by " +
                           std::to_string(this->space().n_multipliers()) +
                           " multipliers, which have no mass; use continuity::Penalty or an implicit solver");
  Base::rebuild(state);
  const auto timing = this->timers().measure("set-up");
  stiffness_.emplace(this->assembler().make_matrix(Unknowns::displacement));
  this->assembler().template part_mass_matrix<Unknowns::displacement>(*stiffness_);
  mass_                 = lumped_mass(*stiffness_);
  const auto &supported = this->equations_.supported();
  for (std::size_t i = 0; i < mass_->owned().size(); ++i)
    if (const auto k = i / spacedim * n_fields + i % spacedim; supported.fixed()[k] && !supported.is_held(k))
      mass_->local()[i] = 0.;
  start_.reset();
  end_.reset();
  estimate_largest_step(state);
}

template <class Model>
void ExplicitSolver<Model>::estimate_largest_step(const StateType &state)
{
  const auto timing = this->timers().measure("stable step");
  Vector     force(state.distribution, n_fields), external = force, rest = state.acceleration;
  rest.fill(0.);
  this->assembler().template linearise_part<Unknowns::displacement>(
      {state.position, rest, state.phase}, state.history, 0., PhaseTangent::consistent,
      this->assembler().evaluate(this->loads(), state.time), force, external, *stiffness_);
  std::vector<char> free(mass_->owned().size());
  for (std::size_t i = 0; i < free.size(); ++i)
    free[i] = !this->equations_.supported().fixed()[i / spacedim * n_fields + i % spacedim];
  const double omega = std::sqrt(eigenvalue_bound(*stiffness_, *mass_, free));
  largest_step_      = integrator_.largest_step(omega);
  damping_           = integrator_.stiffness_factor(omega);
  n_steps_           = 0;
}

template <class Model>
auto ExplicitSolver<Model>::forces_at_rest(const Vector &position, const Vector &phase, const QuadratureField &history,
                                           double time) const -> Forces
{
  Vector rest = position;
  rest.fill(0.);
  Vector total(phase.shared_distribution(), n_fields), external = total;
  this->assembler().template part_force<Unknowns::displacement>(
      {position, rest, phase}, history, this->assembler().evaluate(this->loads(), time), total, external);
  return {position, std::move(total), std::move(external), time};
}

template <class Model>
void ExplicitSolver<Model>::add_inertia(Forces &forces, const Vector &acceleration) const
{
  for (int a = 0; a < acceleration.distribution().n_owned(); ++a)
    for (int c = 0; c < spacedim; ++c)
      if (const int i = a * spacedim + c; mass_->local()[i] > 0.)
        forces.total.local()[a * n_fields + c] += mass_->local()[i] * acceleration.local()[i];
}

template <class Model>
void ExplicitSolver<Model>::add_damping(Forces &forces, const Vector &velocity) const
{
  if (damping_ == 0.)
    return;
  Vector damping = velocity;
  stiffness_->multiply(velocity, damping);
  for (int a = 0; a < velocity.distribution().n_owned(); ++a)
    for (int c = 0; c < spacedim; ++c)
      forces.total.local()[a * n_fields + c] += damping_ * damping.local()[a * spacedim + c];
}

template <class Model>
void ExplicitSolver<Model>::set_initial_acceleration(StateType &state)
{
  const auto timing = this->timers().measure("initial state");
  this->equations_.supported().check_velocity(state.velocity);
  auto        forces = forces_at_rest(state.position, state.phase, state.history, state.time);
  const auto &fixed  = this->equations_.supported().fixed();
  add_damping(forces, state.velocity);
  state.acceleration.fill(0.);
  for (std::size_t i = 0; i < mass_->owned().size(); ++i)
    if (const auto k = i / spacedim * n_fields + i % spacedim; !fixed[k])
      state.acceleration.local()[i] = (forces.external.local()[k] - forces.total.local()[k]) / mass_->local()[i];
  state.acceleration.update_ghosts();
  this->equations_.supported().complete(state.acceleration);
}

template <class Model>
void ExplicitSolver<Model>::balance(Forces &forces, const StateType &state, Motion &next, double dt) const
{
  Vector half_way = state.velocity;
  axpy(.5 * dt, state.acceleration, half_way);
  add_damping(forces, half_way);

  // Increments of a: free unknowns by their forces, held ones by three points of the path of their support.
  const auto  &supported = this->equations_.supported();
  const auto   stage     = integrator_.stages(dt, dt).front();
  const Vector at_start  = supported.moves(state.position, state.time),
               at_middle = supported.moves(state.position, state.time + .5 * dt),
               at_end    = supported.moves(state.position, state.time + dt);
  Vector rate(state.distribution, spacedim), correction = rate;
  for (std::size_t i = 0; i < mass_->owned().size(); ++i)
    {
      const auto k = i / spacedim * n_fields + i % spacedim;
      if (supported.fixed()[k] && !supported.is_held(k))
        continue;
      const double u[3] = {at_start.local()[i], at_middle.local()[i], at_end.local()[i]};
      const double a    = supported.is_held(k)
                              ? 4. * (u[0] - 2. * u[1] + u[2]) / (dt * dt)
                              : (forces.external.local()[k] - forces.total.local()[k]) / mass_->local()[i];
      rate.local()[i]   = a - next.acceleration.local()[i];
      if (supported.is_held(k))
        correction.local()[i] =
            (3. * u[2] - 4. * u[1] + u[0]) / dt - (next.velocity.local()[i] + stage.gamma * dt * rate.local()[i]);
    }
  for (Vector *values : {&rate, &correction})
    {
      values->update_ghosts();
      supported.complete(*values);
    }
  for (std::size_t i = 0; i < rate.local().size(); ++i)
    {
      accelerate(stage, next, i, next.acceleration.local()[i] + rate.local()[i]);
      next.velocity.local()[i] += correction.local()[i];
    }
  add_inertia(forces, next.acceleration);
}

template <class Model>
bool ExplicitSolver<Model>::belongs_to(const std::optional<Forces> &forces, const StateType &state) const
{
  // A body that is not moved yet has the same position at all times. Those that are hit exactly differ by rounding.
  int same = forces && std::abs(forces->time - state.time) <= rounding * std::abs(state.time) &&
             std::equal(state.position.local().begin(), state.position.local().end(), forces->position.local().begin());
  const auto comm = state.distribution->comm();
  MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_MIN, comm);
  return same != 0;
}

template <class Model>
double ExplicitSolver<Model>::inertial_work(const Vector &acceleration, const Vector &displacement) const
{
  double sum = 0.;
  for (int a = 0; a < acceleration.distribution().n_owned(); ++a)
    for (int i = a * spacedim; i < (a + 1) * spacedim; ++i)
      sum += mass_->local()[i] * acceleration.local()[i] * displacement.local()[i];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, acceleration.distribution().comm());
  return sum;
}

template <class Model>
Energies ExplicitSolver<Model>::energies(const StateType &state)
{
  auto energies    = Base::energies(state);
  energies.kinetic = .5 * inertial_work(state.velocity, state.velocity);
  return energies;
}

template <class Model>
auto ExplicitSolver<Model>::attempt(const StateType &state, double dt) -> Result
{
  const auto timing = this->timers().measure("step");
  Result     result;
  if (!(dt <= largest_step_ * (1. + rounding)))
    {
      result.failure = "a step of " + print(dt) + " exceeds the largest stable one, " + print(largest_step_);
      return result;
    }
  auto       &equations = this->equations_;
  const auto &supported = equations.supported();
  equations.soften_interfaces(state.phase);
  const Motion start{state.position, state.velocity, state.acceleration};
  Motion       next = predict(integrator_.stages(dt, dt).front(), start, start);
  axpy(1., supported.moves(next.position, state.time + dt), next.position);

  auto system = equations.phase_system(
      next.position, equations.extrapolate(state.phase, state.previous_phase, dt / equations.previous_step(state, dt)),
      state.history);
  if (!this->newton_.find_stable_state(equations, system, result))
    return result;

  {
    const auto measuring = this->timers().measure("residual");
    if (belongs_to(end_, state))
      start_ = std::move(end_);
    else if (!belongs_to(start_, state))
      {
        start_ = forces_at_rest(state.position, state.phase, state.history, state.time);
        add_damping(*start_, state.velocity);
        add_inertia(*start_, state.acceleration);
      }
    end_ = forces_at_rest(next.position, system.phase, state.history, state.time + dt);
    for (int a = 0; a < state.distribution->n_owned(); ++a)
      end_->total.local()[a * n_fields + spacedim] = -system.residual.local()[a * n_fields + spacedim];
    balance(*end_, state, next, dt);
  }
  const double size = norm(next.acceleration) + norm(next.velocity) + norm(next.position);
  if (!std::isfinite(size))
    {
      result.failure = "the motion is not finite after the step";
      return result;
    }
  if (!equations.keeps_orientation(state.position, next.position, result))
    return result;

  StateType    end          = state;
  const Vector displacement = difference(next.position, state.position), half = [&] {
    Vector way = displacement;
    scale(.5, way);
    return way;
  }();
  Vector no_change = state.phase;
  no_change.fill(0.);
  const BalanceLevel before{state.position, state.acceleration, state.phase},
      after{next.position, next.acceleration, system.phase, system.level().active_energy};
  result.work = equations.work({before, start_->time, start_->total, start_->external}, half, no_change);
  result.work +=
      equations.work({after, end_->time, end_->total, end_->external}, half, difference(system.phase, state.phase));
  result.work += equations.work_of_rotations(next.position, state.time, state.time + dt);
  result.work.inertial = inertial_work(state.acceleration, half) + inertial_work(next.acceleration, half);
  end.history          = this->assembler().committed(after, state.history);
  result.withheld_work = this->assembler().withheld_work(after, state.phase, end.history);
  result.error         = equations.error(start, next, dt);
  equations.set_total_force(end_->total);
  end.position       = std::move(next.position);
  end.velocity       = std::move(next.velocity);
  end.acceleration   = std::move(next.acceleration);
  end.previous_phase = state.phase;
  end.phase          = std::move(system.phase);
  end.time           = state.time + dt;
  end.step_size      = dt;
  end.step           = state.step + 1;
  if (++n_steps_ >= renewal)
    estimate_largest_step(end);
  result.state = std::move(end);
  return result;
}

} // namespace sherd
