#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <sherd/solve/step_equations.h>

namespace sherd
{

template <class Model>
void StepEquations<Model>::rebuild(const StateType &state)
{
  supported_.emplace(*supports_, *space_);
  assembler_.emplace(*model_, *space_, state.distribution, supported_->ties(), supports_->weak_edges());
  soften_interfaces(state.phase);
  phase_only_ = supported_->fixed();
  for (std::size_t i = 0; i < phase_only_.size(); ++i)
    if (i % n_fields != spacedim)
      phase_only_[i] = 1;
  total_force_.reset();
}

template <class Model>
template <Unknowns part>
ResidualNorms StepEquations<Model>::linearise(System &system, PhaseTangent tangent, Matrix &matrix)
{
  const auto timing = timers_.measure("assembly");
  Vector     force(assembler_->distribution(), n_fields);
  if constexpr (part == Unknowns::all)
    assembler_->linearise(system.level(), system.history, system.stage.mass_weight(), tangent, system.loads, force,
                          system.external, matrix);
  else
    assembler_->template linearise_part<part>(system.level(), system.history, system.stage.mass_weight(), tangent,
                                              system.loads, force, system.external, matrix);
  system.has_tangent = tangent == PhaseTangent::consistent;
  return balance(system, std::move(force));
}

template <class Model>
template <Unknowns part>
ResidualNorms StepEquations<Model>::evaluate(System &system)
{
  const auto timing = timers_.measure("residual");
  Vector     force(assembler_->distribution(), n_fields);
  if constexpr (part == Unknowns::all)
    assembler_->force(system.level(), system.history, system.loads, force, system.external);
  else
    assembler_->template part_force<part>(system.level(), system.history, system.loads, force, system.external);
  return balance(system, std::move(force));
}

template <class Model>
ResidualNorms StepEquations<Model>::balance(System &system, Vector force)
{
  // Squared norms over the owned unknowns: residual, load, reaction of the supports, inertia (lumped).
  const auto &interfaces = assembler_->interfaces();
  const auto &fixed      = *system.fixed;
  double      sums[4]    = {0., 0., 0., 0.};
  double      peaks[5]   = {0., 0., assembler_->sensitivity(), 0., 0.}; // scaled phase residual, extent of the body,
                                                                        // sensitivity, defects of multipliers
  const int    n_owned = assembler_->distribution()->n_owned();
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < n_owned; ++i)
    {
      if (interfaces.is_multiplier(i))
        {
          for (int k = i * n_fields; k < (i + 1) * n_fields; ++k)
            system.residual.local()[k] = fixed[k] ? 0. : -force.local()[k];
          continue;
        }
      for (int c = 0; c < spacedim; ++c)
        {
          const int    k        = i * n_fields + c;
          const double residual = system.external.local()[k] - force.local()[k];
          const double inertia =
              model_->mass * assembler_->point_area()[i] * system.acceleration.local()[i * spacedim + c];
          system.residual.local()[k] = fixed[k] ? 0. : residual;
          sums[fixed[k] ? 2 : 0] += residual * residual;
          sums[1] += system.external.local()[k] * system.external.local()[k];
          sums[3] += inertia * inertia;
          peaks[1] = std::max(peaks[1], std::abs(system.position.local()[i * spacedim + c]));
        }
      const int    k             = i * n_fields + spacedim;
      const double residual      = fixed[k] ? 0. : -force.local()[k];
      system.residual.local()[k] = residual;
      const double scaled        = std::abs(residual) / assembler_->phase_scale()[i];
      if (!(scaled <= peaks[0]))
        peaks[0] = scaled;
      if (std::isnan(scaled))
        sums[0] = nan;
    }
  const auto defects = interfaces.defects(system.residual);
  if (std::isnan(defects.angle + defects.phase))
    sums[0] = nan;
  peaks[3] = defects.angle;
  peaks[4] = defects.phase;
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, assembler_->distribution()->comm());
  MPI_Allreduce(MPI_IN_PLACE, peaks, 5, MPI_DOUBLE, MPI_MAX, assembler_->distribution()->comm());
  total_force_ = std::move(force);

  // Membrane forces and those of penalties cancel to rounding of the coordinates; below that a relative residual has no
  // meaning.
  const double n_unknowns = static_cast<double>(spacedim) * space_->surface().n_control_points();
  const double floor      = 100. * std::numeric_limits<double>::epsilon() *
                       (assembler_->largest_stiffness() * (model_->split.bulk() + model_->split.shear()) + peaks[2]) *
                       peaks[1] * std::sqrt(n_unknowns);
  const double reference = std::sqrt(std::max({sums[1], sums[2], sums[3]}));
  const double allowed   = settings_.displacement_tolerance * reference + floor;
  if (!std::isfinite(sums[0] + sums[1] + sums[2] + sums[3]))
    return {nan, nan};
  return {std::max(std::sqrt(sums[0]) / allowed, peaks[3] / settings_.displacement_tolerance),
          std::max(peaks[0], peaks[4]) / settings_.phase_tolerance};
}

template <class Model>
Vector StepEquations<Model>::extrapolate(const Vector &now, const Vector &before, double ratio)
{
  Vector result = now;
  for (std::size_t i = 0; i < result.local().size(); ++i)
    result.local()[i] += ratio * (now.local()[i] - before.local()[i]);
  return result;
}

template <class Model>
auto StepEquations<Model>::take_stages(const StateType &state, double dt, const Stages &stages,
                                       const StageSolver &solve) -> Result
{
  soften_interfaces(state.phase);
  const Motion start{state.position, state.velocity, state.acceleration};
  StateType    end            = state; // of the last stage
  Vector       phase_before   = state.previous_phase;
  double       elapsed_before = previous_step(state, dt), elapsed = 0.;
  Result       result;
  for (const Stage &stage : stages)
    {
      const double part  = stage.dt - elapsed;
      Motion       next  = predict(stage, start, {end.position, end.velocity, end.acceleration});
      const Vector moves = supported_->moves(next.position, state.time + stage.dt);
      for (std::size_t i = 0; i < moves.local().size(); ++i)
        if (moves.local()[i] != 0.)
          move(stage, next, i, moves.local()[i]);

      const double load_time = state.time + stage.alpha_f * stage.dt;
      System       system(assembler_->interfaces(), stage, start, std::move(next),
                          extrapolate(end.phase, phase_before, part / elapsed_before), end.history, supported_->fixed(),
                          assembler_->evaluate(*loads_, load_time), load_time);
      const int    newton = std::exchange(result.newton, 0);
      if (!solve(system, result) || !keeps_orientation(end.position, system.next.position, result))
        return result;
      result.newton = std::max(result.newton, newton);
      result.work += work({system.level(), load_time, *total_force_, system.external},
                          difference(system.next.position, end.position), difference(system.phase, end.phase));
      result.work += work_of_rotations(system.position, state.time + elapsed, state.time + stage.dt);
      if (!system.active_energy)
        system.active_energy = assembler_->active_energy(system.level());
      QuadratureField history = assembler_->committed(system.level(), end.history);
      result.withheld_work += assembler_->withheld_work(system.level(), end.phase, history);
      if (stage.has_inertia())
        result.error = error(start, system.next, dt);
      end.position     = std::move(system.next.position);
      end.velocity     = std::move(system.next.velocity);
      end.acceleration = std::move(system.next.acceleration);
      phase_before     = std::exchange(end.phase, std::move(system.phase));
      end.history      = std::move(history);
      elapsed_before   = part;
      elapsed          = stage.dt;
    }
  end.previous_phase = state.phase;
  end.time           = state.time + dt;
  end.step_size      = dt;
  end.step           = state.step + 1;
  result.state       = std::move(end);
  return result;
}

template <class Model>
bool StepEquations<Model>::keeps_orientation(const Vector &before, const Vector &after, Result &result) const
{
  int n = assembler_->n_turned(before, after);
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, assembler_->distribution()->comm());
  if (n > 0)
    result.failure = std::to_string(n) + (n == 1 ? " element" : " elements") + " turned inside out";
  return n == 0;
}

template <class Model>
auto StepEquations<Model>::phase_system(const Vector &position, Vector phase, const QuadratureField &history) const
    -> System
{
  // A level that is the state itself.
  constexpr Stage here{1., 1., 1., 1., 1., {}, {}};
  Vector          rest = position;
  rest.fill(0.);
  const Motion frozen{position, rest, rest};
  return {assembler_->interfaces(), here, frozen, frozen, std::move(phase), history, phase_only_, {}, 0.};
}

template <class Model>
double StepEquations<Model>::error(const Motion &start, const Motion &end, double dt) const
{
  double largest = 0.;
  for (int a = 0; a < assembler_->distribution()->n_owned(); ++a)
    if (!assembler_->interfaces().is_multiplier(a))
      {
        double square = 0.;
        for (int c = 0; c < spacedim; ++c)
          square += std::pow(displacement_error(start, end, dt, a * spacedim + c), 2);
        largest = std::max(largest, square);
      }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, assembler_->distribution()->comm());
  return std::sqrt(largest) / internal::surface_size(space_->surface());
}

template <class Model>
StepWork StepEquations<Model>::work(const BalancedForces &forces, const Vector &displacement,
                                    const Vector &phase_change) const
{
  return step_work(
      *assembler_, *loads_, forces, [this](std::size_t k) { return supported_->is_held(k); }, displacement,
      phase_change);
}

template <class Model>
StepWork StepEquations<Model>::work_of_rotations(const Vector &position, double start, double end) const
{
  double work = assembler_->weak_edges().work(position, start, end);
  MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, assembler_->distribution()->comm());
  StepWork result;
  result.external.supports = result.internal = work;
  return result;
}

template <class Model>
template <Unknowns part>
void StepEquations<Model>::set_initial_acceleration(StateType &state, Matrix &matrix) const
{
  supported_->check_velocity(state.velocity);
  constexpr auto fields       = fields_of(part, spacedim);
  const auto    &distribution = state.distribution;
  Vector         force(distribution, n_fields), external            = force;
  Vector         residual(distribution, fields.count), acceleration = residual;
  Vector         zero = state.acceleration;
  zero.fill(0.);
  const BalanceLevel level{state.position, zero, state.phase};
  assembler_->force(level, state.history, assembler_->evaluate(*loads_, state.time), force, external);
  const auto &interfaces = assembler_->interfaces();
  const auto &fixed      = supported_->fixed();
  for (int a = 0; a < distribution->n_owned(); ++a)
    if (!interfaces.is_multiplier(a))
      for (int c = 0; c < spacedim; ++c)
        if (const int k = a * n_fields + c; !fixed[k])
          residual.local()[a * fields.count + c] = external.local()[k] - force.local()[k];
  if constexpr (part == Unknowns::all)
    assembler_->mass_matrix(matrix);
  else
    assembler_->template part_mass_matrix<part>(matrix);
  interfaces.constrain_acceleration(state.position, part, matrix);
  decouple_rows(matrix, fixed, n_fields, fields);
  auto settings      = settings_.linear;
  settings.tolerance = 1e-12;
  LinearSolver(settings).solve(matrix, residual, acceleration);
  supported_->complete(acceleration);
  for (const int a : interfaces.multipliers())
    state.position.local()[a * spacedim] += std::exchange(acceleration.local()[a * fields.count], 0.);
  for (int a = 0; a < distribution->n_local(); ++a)
    for (int c = 0; c < spacedim; ++c)
      state.acceleration.local()[a * spacedim + c] = acceleration.local()[a * fields.count + c];
}

} // namespace sherd
