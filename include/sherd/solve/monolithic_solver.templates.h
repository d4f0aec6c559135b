#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <sherd/assembly/step_work.h>
#include <sherd/fracture/branch.h>
#include <sherd/solve/definiteness.h>
#include <sherd/solve/monolithic_solver.h>

namespace sherd
{

/// The nonlinear system of one step and its present iterate.
template <class Model, ImplicitIntegrator Integrator>
struct MonolithicSolver<Model, Integrator>::System
{
  Stage                    stage;
  const Motion            &old;
  Motion                   next;
  Vector                   phase;
  const QuadratureField   &history;
  const std::vector<char> &fixed;       ///< 1 for an unknown that does not move, shape=(n_owned * n_fields)
  const std::vector<int>  &multipliers; ///< local points
  LoadValues<Model>        loads;       ///< at its level

  Vector external;            ///< f_ext, block n_fields
  Vector position;            ///< at n + alpha_f
  Vector acceleration;        ///< at n + alpha_m
  Vector residual;            ///< block n_fields
  Vector increment;           ///< block n_fields
  bool   has_tangent = false; ///< whether the matrix is the consistent tangent of this iterate

  System(const Stage &stage_, const Motion &old_, Motion next_, Vector phase_, const QuadratureField &history_,
         const std::vector<char> &fixed_, const std::vector<int> &multipliers_, LoadValues<Model> loads_)
      : stage(stage_),
        old(old_),
        next(std::move(next_)),
        phase(std::move(phase_)),
        history(history_),
        fixed(fixed_),
        multipliers(multipliers_),
        loads(std::move(loads_)),
        external(phase.shared_distribution(), n_fields),
        position(next.position),
        acceleration(next.acceleration),
        residual(external),
        increment(external)
  {
    update_levels();
  }

  void update_levels()
  {
    position     = interpolate(stage.alpha_f, old.position, next.position);
    acceleration = interpolate(stage.alpha_m, old.acceleration, next.acceleration);
    // A multiplier has no history: that of the step acts at the level of the balance (theory G.4).
    for (const int a : multipliers)
      position.local()[a * spacedim] = next.position.local()[a * spacedim];
  }

  BalanceLevel level() const { return {position, acceleration, phase}; }

  /// Adds the increment; the phase part is scaled down to @p largest_phase_step.
  void advance(double largest_phase_step)
  {
    const auto          d    = increment.local();
    const auto          n    = static_cast<std::size_t>(phase.distribution().n_local());
    double              peak = 0.;
    std::vector<double> of_multipliers; // they have no rates
    for (const int a : multipliers)
      {
        next.position.local()[a * spacedim] += d[a * n_fields];
        of_multipliers.push_back(std::exchange(d[a * n_fields + spacedim], 0.));
        d[a * n_fields] = 0.;
      }
    for (std::size_t a = 0; a < n; ++a)
      peak = std::max(peak, std::abs(d[a * n_fields + spacedim]));
    MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPI_DOUBLE, MPI_MAX, phase.distribution().comm());
    const double scale = peak > largest_phase_step ? largest_phase_step / peak : 1.;
    for (std::size_t a = 0; a < n; ++a)
      {
        for (int c = 0; c < spacedim; ++c)
          move(stage, next, a * spacedim + c, d[a * n_fields + c] / stage.alpha_f);
        phase.local()[a] += scale * d[a * n_fields + spacedim];
      }
    for (std::size_t k = 0; k < multipliers.size(); ++k)
      phase.local()[multipliers[k]] += scale * of_multipliers[k];
    update_levels();
    has_tangent = false;
  }
};

template <class Model, ImplicitIntegrator Integrator>
MonolithicSolver<Model, Integrator>::MonolithicSolver(const Model &model, const ShellSpace<degree, spacedim> &space,
                                                      const Supports &supports, const Loads<spacedim> &loads,
                                                      const Integrator &integrator, const NewtonSettings &settings)
    : model_(&model),
      space_(&space),
      supports_(&supports),
      loads_(&loads),
      integrator_(integrator),
      settings_(settings),
      linear_solver_(settings.linear)
{
}

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::rebuild(const StateType &state)
{
  const auto timing = timers_.measure("set-up");
  supported_.emplace(*supports_, *space_);
  assembler_.emplace(*model_, *space_, state.distribution, supported_->ties());
  matrix_.emplace(assembler_->make_matrix());
  linear_solver_.forget();
  kept_.reset();
  last_residuals_.clear();
  total_force_.reset();
}

template <class Model, ImplicitIntegrator Integrator>
typename MonolithicSolver<Model, Integrator>::Norms MonolithicSolver<Model, Integrator>::linearise(System      &system,
                                                                                                   PhaseTangent tangent)
{
  const auto timing = timers_.measure("assembly");
  Vector     force(assembler_->distribution(), n_fields);
  kept_.reset();
  assembler_->linearise(system.level(), system.history, system.stage.mass_weight(), tangent, system.loads, force,
                        system.external, *matrix_);
  system.has_tangent = tangent == PhaseTangent::consistent;
  return balance(system, std::move(force));
}

template <class Model, ImplicitIntegrator Integrator>
typename MonolithicSolver<Model, Integrator>::Norms MonolithicSolver<Model, Integrator>::evaluate(System &system)
{
  const auto timing = timers_.measure("residual");
  Vector     force(assembler_->distribution(), n_fields);
  assembler_->force(system.level(), system.history, system.loads, force, system.external);
  return balance(system, std::move(force));
}

template <class Model, ImplicitIntegrator Integrator>
typename MonolithicSolver<Model, Integrator>::Norms MonolithicSolver<Model, Integrator>::balance(System &system,
                                                                                                 Vector  force)
{
  // Squared norms over the owned unknowns: residual, load, reaction of the supports, inertia (lumped).
  const auto &interfaces = assembler_->interfaces();
  double      sums[4]    = {0., 0., 0., 0.};
  double      peaks[5]   = {0., 0., interfaces.sensitivity(), 0., 0.}; // scaled phase residual, extent of the body,
                                                                       // sensitivity, defects of multipliers
  const int    n_owned = assembler_->distribution()->n_owned();
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < n_owned; ++i)
    {
      if (interfaces.is_multiplier(i))
        {
          for (int k = i * n_fields; k < (i + 1) * n_fields; ++k)
            system.residual.local()[k] = system.fixed[k] ? 0. : -force.local()[k];
          continue;
        }
      for (int c = 0; c < spacedim; ++c)
        {
          const int    k        = i * n_fields + c;
          const double residual = system.external.local()[k] - force.local()[k];
          const double inertia =
              model_->mass * assembler_->point_area()[i] * system.acceleration.local()[i * spacedim + c];
          system.residual.local()[k] = system.fixed[k] ? 0. : residual;
          sums[system.fixed[k] ? 2 : 0] += residual * residual;
          sums[1] += system.external.local()[k] * system.external.local()[k];
          sums[3] += inertia * inertia;
          peaks[1] = std::max(peaks[1], std::abs(system.position.local()[i * spacedim + c]));
        }
      const int    k             = i * n_fields + spacedim;
      const double residual      = -force.local()[k];
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

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::solve_increment(System &system, Result &result)
{
  SolveReport report;
  {
    const auto timing = timers_.measure("solve");
    if (kept_)
      {
        report       = linear_solver_.solve_again(*matrix_, system.residual, system.increment);
        kept_->fresh = false;
      }
    else
      {
        decouple_rows(*matrix_, system.fixed);
        report = linear_solver_.solve(*matrix_, system.residual, system.increment);
        if (system.has_tangent)
          kept_ = KeptTangent{system.stage.mass_weight(), std::numeric_limits<double>::infinity(), true};
      }
    supported_->complete(system.increment);
  }
  timers_.reassign("solve", "preconditioner", report.setup_seconds);
  result.linear += report.iterations;
  if (report.escalated)
    result.messages.push_back(report.message);
}

namespace internal
{
/// A residual of so many times the tolerance is expected to have converged.
inline constexpr double surely_converged = .5;
} // namespace internal

template <class Model, ImplicitIntegrator Integrator>
bool MonolithicSolver<Model, Integrator>::kept_tangent_suffices(double residual) const
{
  return kept_ && residual * kept_->contraction <= internal::surely_converged;
}

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::observe(const std::vector<double> &residuals)
{
  // Newton's error falls from e to e' = C e^2 / 2; the same tangent takes it from there to C e e' = (2 e' / e) e'.
  const auto n = residuals.size();
  if (kept_ && n > 1)
    kept_->contraction =
        std::max((kept_->fresh ? 2. : 1.) * residuals[n - 1] / residuals[n - 2], settings_.linear.tolerance);
}

template <class Model, ImplicitIntegrator Integrator>
bool MonolithicSolver<Model, Integrator>::expects_use_of_kept_tangent(const std::vector<double> &residuals) const
{
  // Residuals fall quadratically, r_next = r (r / r_before)^2, until the linear solver's tolerance limits them; the
  // first two are expected to be those of the step before.
  const auto n    = residuals.size();
  const auto last = [&](std::size_t i) {
    return i < last_residuals_.size() ? last_residuals_[i] : std::numeric_limits<double>::infinity();
  };
  if (n == 0)
    return kept_tangent_suffices(last(0));
  const double rate     = n == 1 ? last(1) / last(0) : std::pow(residuals[n - 1] / residuals[n - 2], 2);
  const double factor   = std::max(rate, settings_.linear.tolerance);
  const double expected = residuals[n - 1] * factor;
  return expected <= internal::surely_converged || (kept_ && expected * 2. * factor <= internal::surely_converged);
}

template <class Model, ImplicitIntegrator Integrator>
bool MonolithicSolver<Model, Integrator>::iterate(System &system, Result &result)
{
  double              early           = 0.;
  int                 n_tangents      = 0;
  bool                by_kept_tangent = false; // the increment that led to this iterate
  std::vector<double> residuals;
  if (kept_ && kept_->mass_weight != system.stage.mass_weight())
    kept_.reset();
  for (int i = 0;; ++i)
    {
      // Where this iterate should have converged, or one more solve with the tangent at hand will do, its own tangent
      // is most likely not needed.
      Norms norms =
          expects_use_of_kept_tangent(residuals) ? evaluate(system) : linearise(system, PhaseTangent::consistent);
      residuals.push_back(norms.larger());
      observe(residuals);
      if (norms.larger() > 1. && !system.has_tangent && !kept_tangent_suffices(norms.larger()))
        linearise(system, PhaseTangent::consistent);
      result.residuals.push_back(norms.larger());
      if (!std::isfinite(norms.larger()))
        result.failure = "the residual is not finite after " + std::to_string(i) + " Newton iterations";
      else if (norms.larger() <= 1.)
        {
          result.newton += by_kept_tangent;
          last_residuals_ = std::move(residuals);
          return true;
        }
      else if (i <= 3)
        early = norms.larger();
      else if (norms.larger() > settings_.divergence * early)
        result.failure = "Newton's iteration diverges";
      if (result.failure.empty() && system.has_tangent && n_tangents == settings_.max_iterations)
        result.failure = "no convergence in " + std::to_string(n_tangents) + " Newton iterations (residuals " +
                         std::to_string(norms.displacement) + " and " + std::to_string(norms.phase) +
                         " times the tolerances of displacement and phase)";
      if (!result.failure.empty())
        return false;
      by_kept_tangent = !system.has_tangent;
      n_tangents += system.has_tangent;
      result.newton += system.has_tangent;
      solve_increment(system, result);
      system.advance(std::numeric_limits<double>::infinity());
    }
}

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::leave_false_branch(System &system, const Vector &start, Result &result)
{
  // Newton with a positive phase stiffness goes downhill; once its residual is small the consistent tangent finishes.
  // The residual is small also where it starts, close to the state that it leaves. From there the consistent tangent
  // would lead back until the stiffness is positive definite everywhere, not just where the phase is close to 1.
  constexpr double close_enough = 100.;
  ++result.switched;
  system.phase = start;
  std::vector<int> everywhere;
  for (int a = 0; a < assembler_->distribution()->n_owned(); ++a)
    if (!assembler_->interfaces().is_multiplier(a))
      everywhere.push_back(a);
  for (int i = 0; i < settings_.max_switch_iterations; ++i)
    {
      const Norms norms = linearise(system, PhaseTangent::switched);
      if (!std::isfinite(norms.larger()))
        return;
      if (norms.phase <= close_enough)
        {
          linearise(system, PhaseTangent::consistent);
          if (on_stable_branch(system, result) && positive_definite(*matrix_, spacedim, everywhere))
            return;
          linearise(system, PhaseTangent::switched);
        }
      solve_increment(system, result);
      system.advance(branch::largest_phase_step);
    }
}

template <class Model, ImplicitIntegrator Integrator>
bool MonolithicSolver<Model, Integrator>::on_stable_branch(System &system, Result &result)
{
  const auto timing   = timers_.measure("branch check");
  const auto suspects = assembler_->suspects(system.level(), system.history);
  double     largest  = suspects.largest_phase;
  int        n        = static_cast<int>(suspects.active.size());
  const auto comm     = assembler_->distribution()->comm();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, comm);
  result.largest_phase = largest;
  if (n == 0)
    return true;
  if (!system.has_tangent)
    linearise(system, PhaseTangent::consistent);
  std::vector<int> points;
  for (const int e : suspects.active)
    for (const int a : space_->points_of(e))
      points.push_back(a);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return positive_definite(*matrix_, spacedim, points);
}

template <class Model, ImplicitIntegrator Integrator>
bool MonolithicSolver<Model, Integrator>::keeps_orientation(const System &system, Result &result) const
{
  int n = assembler_->n_turned(system.old.position, system.next.position);
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, assembler_->distribution()->comm());
  if (n > 0)
    result.failure = std::to_string(n) + " elements turned inside out";
  return n == 0;
}

template <class Model, ImplicitIntegrator Integrator>
bool MonolithicSolver<Model, Integrator>::find_stable_state(System &system, Result &result)
{
  const Vector start = system.phase;
  try
    {
      if (!iterate(system, result))
        return false;
      if (on_stable_branch(system, result))
        return keeps_orientation(system, result);
      leave_false_branch(system, start, result);
      if (!iterate(system, result))
        return false;
      if (on_stable_branch(system, result))
        return keeps_orientation(system, result);
      result.failure = "the step converged to the unstable branch of the phase equation, also after a branch switch";
    }
  catch (const NoConvergence &error)
    {
      result.failure = error.what();
    }
  return false;
}

template <class Model, ImplicitIntegrator Integrator>
typename MonolithicSolver<Model, Integrator>::Result
MonolithicSolver<Model, Integrator>::attempt(const StateType &state, double dt)
{
  const auto   timing      = timers_.measure("step");
  const double previous_dt = state.step_size > 0. ? state.step_size : dt;
  const Motion start{state.position, state.velocity, state.acceleration};
  StateType    end          = state; // of the last stage
  Vector       phase_before = state.previous_phase;
  double       elapsed = 0., elapsed_before = previous_dt;
  Result       result;
  for (const Stage &stage : integrator_.stages(dt, previous_dt))
    {
      const double dt_of_stage = stage.dt - elapsed;
      Motion       next        = predict(stage, start, {end.position, end.velocity, end.acceleration});
      const Vector moves       = supported_->moves(next.position, state.time + stage.dt);
      for (std::size_t i = 0; i < moves.local().size(); ++i)
        if (moves.local()[i] != 0.)
          move(stage, next, i, moves.local()[i]);
      Vector phase = end.phase;
      for (std::size_t a = 0; a < phase.local().size(); ++a)
        phase.local()[a] += dt_of_stage / elapsed_before * (end.phase.local()[a] - phase_before.local()[a]);

      const double load_time = state.time + stage.alpha_f * stage.dt;
      System       system(stage, start, std::move(next), std::move(phase), end.history, supported_->fixed(),
                          assembler_->interfaces().multipliers(), assembler_->evaluate(*loads_, load_time));
      const int    newton = std::exchange(result.newton, 0);
      if (!find_stable_state(system, result))
        return result;
      result.newton = std::max(result.newton, newton);
      result.work += work(system, load_time, end.position, end.phase);
      end.position     = system.next.position;
      end.velocity     = system.next.velocity;
      end.acceleration = system.next.acceleration;
      end.history      = assembler_->committed(system.level(), end.history);
      result.withheld_work += assembler_->withheld_work(system.level(), end.phase, end.history);
      phase_before   = std::exchange(end.phase, system.phase);
      elapsed_before = dt_of_stage;
      elapsed        = stage.dt;
      if (stage.has_inertia())
        result.error = error(start, system.next, dt);
    }
  end.previous_phase = state.phase;
  end.time           = state.time + dt;
  end.step_size      = dt;
  end.step           = state.step + 1;
  result.state       = std::move(end);
  return result;
}

template <class Model, ImplicitIntegrator Integrator>
StepWork MonolithicSolver<Model, Integrator>::work(const System &system, double load_time, const Vector &position,
                                                   const Vector &phase) const
{
  return step_work(
      *assembler_, *loads_, {system.level(), load_time, *total_force_, system.external},
      [this](std::size_t k) { return supported_->is_held(k); }, difference(system.next.position, position),
      difference(system.phase, phase));
}

template <class Model, ImplicitIntegrator Integrator>
double MonolithicSolver<Model, Integrator>::error(const Motion &start, const Motion &end, double dt) const
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

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::equilibrate_phase(StateType &state)
{
  const auto timing = timers_.measure("initial state");
  // All displacements fixed, at a level that is the state itself: only the phase moves.
  auto fixed = supported_->fixed();
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (i % n_fields != spacedim)
      fixed[i] = 1;
  supported_->complete_phase(state.phase);
  const Motion frozen{state.position, state.velocity, state.acceleration};
  const Stage  here{1., 1., 1., 1., 1.};
  System system(here, frozen, frozen, state.phase, state.history, fixed, assembler_->interfaces().multipliers(), {});
  Result result;
  kept_.reset();
  if (!find_stable_state(system, result))
    throw NoConvergence("initial phase field: " + result.failure);
  kept_.reset();
  state.phase          = system.phase;
  state.previous_phase = system.phase;
}

template <class Model, ImplicitIntegrator Integrator>
void MonolithicSolver<Model, Integrator>::set_initial_acceleration(StateType &state)
{
  const auto  timing       = timers_.measure("initial state");
  const auto &distribution = state.distribution;
  Vector      force(distribution, n_fields), residual(distribution, n_fields), acceleration(distribution, n_fields);
  Vector      zero = state.acceleration;
  zero.fill(0.);
  const BalanceLevel level{state.position, zero, state.phase};
  assembler_->force(level, state.history, force);
  assembler_->external_force(level, assembler_->evaluate(*loads_, state.time), residual);
  const auto &interfaces = assembler_->interfaces();
  for (std::size_t k = 0; k < residual.owned().size(); ++k)
    residual.local()[k] = supported_->fixed()[k] || k % n_fields == spacedim || interfaces.is_multiplier(k / n_fields)
                              ? 0.
                              : residual.local()[k] - force.local()[k];
  kept_.reset();
  assembler_->mass_matrix(*matrix_);
  interfaces.constrain_acceleration(state.position, *matrix_);
  decouple_rows(*matrix_, supported_->fixed());
  auto settings      = settings_.linear;
  settings.tolerance = 1e-12;
  LinearSolver(settings).solve(*matrix_, residual, acceleration);
  supported_->complete(acceleration);
  for (const int a : interfaces.multipliers())
    state.position.local()[a * spacedim] += std::exchange(acceleration.local()[a * n_fields], 0.);
  for (int a = 0; a < assembler_->distribution()->n_local(); ++a)
    for (int c = 0; c < spacedim; ++c)
      state.acceleration.local()[a * spacedim + c] = acceleration.local()[a * n_fields + c];
}

template <class Model, ImplicitIntegrator Integrator>
auto MonolithicSolver<Model, Integrator>::reaction(const std::string &edge) const -> Point<spacedim>
{
  return total_force_ ? edge_force(*space_, *total_force_, edge) : Point<spacedim>(Point<spacedim>::Zero());
}

} // namespace sherd
