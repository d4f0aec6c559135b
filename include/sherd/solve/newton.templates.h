#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <sherd/fracture/branch.h>
#include <sherd/solve/definiteness.h>
#include <sherd/solve/newton.h>

namespace sherd
{

namespace internal
{
/// A residual of so many times the tolerance is expected to have converged.
inline constexpr double surely_converged = .5;

/// Contraction up to which modified Newton goes on with a tangent.
inline constexpr double good_contraction = .5;

/// The fields @p range of all fields of a vector.
inline Vector restricted(const Vector &all, FieldRange range)
{
  Vector part(all.shared_distribution(), range.count);
  for (int a = 0; a < all.distribution().n_local(); ++a)
    for (int c = 0; c < range.count; ++c)
      part.local()[a * range.count + c] = all.local()[a * all.block_size() + range.first + c];
  return part;
}

/// Makes @p all the values of a part, zero in the other fields.
inline void extend(const Vector &part, FieldRange range, Vector &all)
{
  all.fill(0.);
  for (int a = 0; a < all.distribution().n_local(); ++a)
    for (int c = 0; c < range.count; ++c)
      all.local()[a * all.block_size() + range.first + c] = part.local()[a * range.count + c];
}
} // namespace internal

template <class Model, Unknowns part>
void NewtonIteration<Model, part>::rebuild(const Equations &equations)
{
  matrix_.emplace(equations.assembler().make_matrix(part));
  linear_solver_.forget();
  kept_.reset();
  last_residuals_.clear();
}

template <class Model, Unknowns part>
ResidualNorms NewtonIteration<Model, part>::linearise(Equations &equations, System &system, PhaseTangent tangent)
{
  kept_.reset();
  const auto norms = equations.template linearise<part>(system, tangent, *matrix_);
  if (part == Unknowns::all && settings_.tangent == TangentRule::lagged_history)
    for (int a = 0; a < matrix_->distribution().n_owned(); ++a)
      if (!equations.assembler().interfaces().is_multiplier(a))
        {
          // The phase feels the displacement through the history alone.
          double *row = matrix_->values().data() + matrix_->row_start(a) + spacedim * matrix_->row_length(a);
          for (int k = 0; k < matrix_->row_length(a); ++k)
            if (k % n_fields != spacedim)
              row[k] = 0.;
        }
  return norms;
}

template <class Model, Unknowns part>
SolveReport NewtonIteration<Model, part>::solve_system(const Vector &rhs, Vector &solution, const System &system)
{
  if (kept_)
    {
      kept_->fresh = false;
      return linear_solver_.solve_again(*matrix_, rhs, solution);
    }
  decouple_rows(*matrix_, *system.fixed, n_fields, fields);
  const auto report = linear_solver_.solve(*matrix_, rhs, solution);
  if (system.has_tangent)
    kept_ = KeptTangent{system.stage.mass_weight(), std::numeric_limits<double>::infinity(), true};
  return report;
}

template <class Model, Unknowns part>
void NewtonIteration<Model, part>::solve_increment(Equations &equations, System &system, Result &result)
{
  SolveReport report;
  {
    const auto timing = equations.timers().measure("solve");
    if constexpr (part == Unknowns::all)
      report = solve_system(system.residual, system.increment, system);
    else
      {
        Vector increment(system.increment.shared_distribution(), fields.count);
        report = solve_system(internal::restricted(system.residual, fields), increment, system);
        internal::extend(increment, fields, system.increment);
      }
    equations.supported().complete(system.increment);
  }
  equations.timers().reassign("solve", "preconditioner", report.setup_seconds);
  result.linear += report.iterations;
  if (report.escalated)
    result.messages.push_back(report.message);
}

template <class Model, Unknowns part>
void NewtonIteration<Model, part>::go_along(Equations &equations, System &system)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (settings_.globalisation == Globalisation::none)
    return system.advance(1., infinity);
  // The slope of the energy along the increment, by its residual.
  double     gone   = 0.;
  const auto go_to  = [&](double length) { system.advance(length - std::exchange(gone, length), infinity); };
  const auto slope0 = dot(system.increment, system.residual);
  const auto slope  = [&](double length) {
    go_to(length);
    const auto norms = equations.template evaluate<part>(system);
    return std::isfinite(norms.larger()) ? dot(system.increment, system.residual) : norms.larger();
  };
  go_to(search_line(slope0, slope, settings_.line_search));
}

template <class Model, Unknowns part>
bool NewtonIteration<Model, part>::kept_tangent_suffices(double residual) const
{
  if (!kept_)
    return false;
  return settings_.tangent == TangentRule::modified ? kept_->contraction <= internal::good_contraction
                                                    : residual * kept_->contraction <= internal::surely_converged;
}

template <class Model, Unknowns part>
void NewtonIteration<Model, part>::observe(const std::vector<double> &residuals)
{
  // Newton's error falls from e to e' = C e^2 / 2; the same tangent takes it from there to C e e' = (2 e' / e) e'.
  const auto n = residuals.size();
  if (kept_ && n > 1)
    kept_->contraction =
        std::max((kept_->fresh ? 2. : 1.) * residuals[n - 1] / residuals[n - 2], settings_.linear.tolerance);
}

template <class Model, Unknowns part>
bool NewtonIteration<Model, part>::expects_use_of_kept_tangent(const std::vector<double> &residuals) const
{
  if (settings_.tangent == TangentRule::modified)
    return kept_.has_value();
  // Residuals fall quadratically, r_next = r (r / r_before)^2, until the linear solver's tolerance limits them; the
  // first two are expected to be those of the step before. Without the derivative of the history they fall linearly.
  const double order = settings_.tangent == TangentRule::full ? 2. : 1.;
  const auto   n     = residuals.size();
  const auto   last  = [&](std::size_t i) {
    return i < last_residuals_.size() ? last_residuals_[i] : std::numeric_limits<double>::infinity();
  };
  if (n == 0)
    return kept_tangent_suffices(last(0));
  const double rate     = n == 1 ? last(1) / last(0) : std::pow(residuals[n - 1] / residuals[n - 2], order);
  const double factor   = std::max(rate, settings_.linear.tolerance);
  const double expected = residuals[n - 1] * factor;
  return expected <= internal::surely_converged || (kept_ && expected * 2. * factor <= internal::surely_converged);
}

template <class Model, Unknowns part>
bool NewtonIteration<Model, part>::iterate(Equations &equations, System &system, Result &result)
{
  double              early           = 0.;
  int                 n_tangents      = 0;
  bool                by_kept_tangent = false; // the increment that led to this iterate
  std::vector<double> residuals;
  if (has_displacement(part) && kept_ && kept_->mass_weight != system.stage.mass_weight())
    kept_.reset();
  if (!has_displacement(part) && !system.active_energy)
    {
      const auto timing    = equations.timers().measure("residual");
      system.active_energy = equations.assembler().active_energy(system.level());
    }
  for (int i = 0;; ++i)
    {
      // Where this iterate should have converged, or one more solve with the tangent at hand will do, its own tangent
      // is most likely not needed.
      const auto norms = expects_use_of_kept_tangent(residuals)
                             ? equations.template evaluate<part>(system)
                             : linearise(equations, system, PhaseTangent::consistent);
      residuals.push_back(norms.larger());
      observe(residuals);
      if (norms.larger() > 1. && !system.has_tangent && !kept_tangent_suffices(norms.larger()))
        linearise(equations, system, PhaseTangent::consistent);
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
        {
          // What iterates that go astray ask of the linear solver is no measure of the next attempt.
          kept_.reset();
          linear_solver_.forget();
          return false;
        }
      by_kept_tangent = !system.has_tangent;
      n_tangents += system.has_tangent;
      result.newton += system.has_tangent;
      solve_increment(equations, system, result);
      go_along(equations, system);
    }
}

template <class Model, Unknowns part>
bool NewtonIteration<Model, part>::phase_is_positive_definite(const std::vector<int> &points) const
    requires(has_phase(part))
{
  return positive_definite(*matrix_, spacedim - fields.first, points);
}

template <class Model, Unknowns part>
void NewtonIteration<Model, part>::leave_false_branch(Equations &equations, System &system, const Vector &start,
                                                      Result &result) requires(has_phase(part))
{
  // Newton with a positive phase stiffness goes downhill; once its residual is small the consistent tangent finishes.
  // The residual is small also where it starts, close to the state that it leaves. From there the consistent tangent
  // would lead back until the stiffness is positive definite everywhere, not just where the phase is close to 1.
  constexpr double close_enough = 100.;
  const auto      &assembler    = equations.assembler();
  ++result.switched;
  system.phase       = start;
  system.has_tangent = false;
  std::vector<int> everywhere;
  for (int a = 0; a < assembler.distribution()->n_owned(); ++a)
    if (!assembler.interfaces().is_multiplier(a))
      everywhere.push_back(a);
  for (int i = 0; i < settings_.max_switch_iterations; ++i)
    {
      const auto norms = linearise(equations, system, PhaseTangent::switched);
      if (!std::isfinite(norms.larger()))
        return;
      if (norms.phase <= close_enough)
        {
          linearise(equations, system, PhaseTangent::consistent);
          if (on_stable_branch(equations, system, result) && phase_is_positive_definite(everywhere))
            return;
          linearise(equations, system, PhaseTangent::switched);
        }
      solve_increment(equations, system, result);
      system.advance(1., branch::largest_phase_step);
    }
}

template <class Model, Unknowns part>
bool NewtonIteration<Model, part>::on_stable_branch(Equations &equations, System &system,
                                                    Result &result) requires(has_phase(part))
{
  const auto timing = equations.timers().measure("branch check");
  if (!system.active_energy)
    system.active_energy = equations.assembler().active_energy(system.level());
  const auto suspects = equations.assembler().suspects(system.level(), system.history);
  double     largest  = suspects.largest_phase;
  int        n        = static_cast<int>(suspects.active.size());
  const auto comm     = equations.assembler().distribution()->comm();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, comm);
  result.largest_phase = largest;
  if (n == 0)
    return true;
  if (!system.has_tangent)
    linearise(equations, system, PhaseTangent::consistent);
  std::vector<int> points;
  for (const int e : suspects.active)
    for (const int a : equations.space().points_of(e))
      points.push_back(a);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return phase_is_positive_definite(points);
}

template <class Model, Unknowns part>
bool NewtonIteration<Model, part>::find_stable_state(Equations &equations, System &system,
                                                     Result &result) requires(has_phase(part))
{
  const Vector start = system.phase;
  try
    {
      const bool converged = iterate(equations, system, result);
      if (converged && on_stable_branch(equations, system, result))
        return true;
      // Where the displacement is held and the branch of the phase ends, a smaller step leads nowhere either: the next
      // solution lies downhill.
      if (!converged && has_displacement(part))
        return false;
      result.failure.clear();
      leave_false_branch(equations, system, start, result);
      if (!iterate(equations, system, result))
        return false;
      if (on_stable_branch(equations, system, result))
        return true;
      result.failure = "the step converged to the unstable branch of the phase equation, also after a branch switch";
    }
  catch (const NoConvergence &error)
    {
      result.failure = error.what();
    }
  return false;
}

} // namespace sherd
