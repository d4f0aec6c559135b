#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/solve/static_solver.h>

namespace sherd
{

namespace internal
{
/// Largest part of @p middle that is not the mean of @p begin and @p end, relative to the largest value. Of this rank.
template <class Model>
double deviation_from_mean(const LoadValues<Model> &begin, const LoadValues<Model> &middle,
                           const LoadValues<Model> &end)
{
  double     deviation = 0., largest = 0.;
  const auto compare = [&](double a, double m, double b) {
    deviation = std::max(deviation, std::abs(m - .5 * (a + b)));
    largest   = std::max({largest, std::abs(a), std::abs(m), std::abs(b)});
  };
  if (middle.dead)
    for (std::size_t i = 0; i < middle.dead->local().size(); ++i)
      compare(begin.dead->local()[i], middle.dead->local()[i], end.dead->local()[i]);
  for (std::size_t e = 0; e < middle.pressure.size(); ++e)
    for (std::size_t q = 0; q < middle.pressure[e].constant.size(); ++q)
      {
        compare(begin.pressure[e].constant[q], middle.pressure[e].constant[q], end.pressure[e].constant[q]);
        compare(begin.pressure[e].by_phase[q], middle.pressure[e].by_phase[q], end.pressure[e].by_phase[q]);
      }
  for (std::size_t m = 0; m < middle.moments.size(); ++m)
    for (std::size_t q = 0; q < middle.moments[m].moment.size(); ++q)
      compare(begin.moments[m].moment[q], middle.moments[m].moment[q], end.moments[m].moment[q]);
  return largest > 0. ? deviation / largest : 0.;
}
} // namespace internal

template <class Model>
StaticSolver<Model>::StaticSolver(const Model &model, const ShellSpace<degree, spacedim> &space,
                                  const Supports &supports, const Loads<spacedim> &loads,
                                  const StaticSettings &settings)
    : model_(&model),
      space_(&space),
      supports_(&supports),
      loads_(&loads),
      settings_(settings),
      linear_solver_(settings.linear)
{
}

template <class Model>
void StaticSolver<Model>::rebuild(const StateType &state)
{
  supported_.emplace(*supports_, *space_);
  assembler_.emplace(*model_, *space_, state.distribution, supported_->ties(), supports_->weak_edges());
  assembler_->soften_interfaces(state.phase);
  matrix_.emplace(assembler_->make_matrix());
  linear_solver_.forget();
  unloaded_ = assembler_->evaluate(*loads_, 0.);
  loaded_   = assembler_->evaluate(*loads_, 1.);
  at_rest_.emplace(state.distribution, spacedim);
  internal_.emplace(state.distribution, n_fields);
  fixed_ = supported_->fixed();
  for (std::size_t k = spacedim; k < fixed_.size(); k += n_fields)
    fixed_[k] = 1;
  check_affine(state);
}

template <class Model>
void StaticSolver<Model>::check_affine(const StateType &state) const
{
  double deviation[2] = {internal::deviation_from_mean(*unloaded_, assembler_->evaluate(*loads_, .5), *loaded_), 0.};
  const Vector begin = supported_->moves(state.position, 0.), middle = supported_->moves(state.position, .5),
               end = supported_->moves(state.position, 1.);
  double largest   = 0.;
  for (std::size_t k = 0; k < middle.local().size(); ++k)
    {
      deviation[1] = std::max(deviation[1], std::abs(middle.local()[k] - .5 * (begin.local()[k] + end.local()[k])));
      largest      = std::max({largest, std::abs(state.position.local()[k]), std::abs(end.local()[k])});
    }
  if (largest > 0.)
    deviation[1] /= largest;
  MPI_Allreduce(MPI_IN_PLACE, deviation, 2, MPI_DOUBLE, MPI_MAX, assembler_->distribution()->comm());
  for (int i = 0; i < 2; ++i)
    if (!(deviation[i] <= 1e-9))
      throw InvalidParameter(std::string("static solver: ") + (i == 0 ? "loads" : "supports") +
                             " that are not affine in the load factor (at factor 0.5 they deviate by " +
                             print(deviation[i]) + " of their largest value from the mean of those at 0 and 1); " +
                             "take the load factor as time, and several runs for a sequence of loads");
}

template <class Model>
auto StaticSolver<Model>::measure(const StateType &state, const Vector &internal, const Vector &external) const
    -> Residual
{
  Residual    result{internal, 0., 0.};
  double      sums[3]    = {0., 0., 0.};                        // residual, load, reaction
  double      peaks[3]   = {0., assembler_->sensitivity(), 0.}; // extent, sensitivity, defect of multipliers
  const auto &interfaces = assembler_->interfaces();
  for (std::size_t k = 0; k < fixed_.size(); ++k)
    {
      const bool   displacement = k % n_fields < spacedim && !interfaces.is_multiplier(k / n_fields);
      const double r            = external.local()[k] - internal.local()[k];
      result.free.local()[k]    = fixed_[k] ? 0. : r;
      if (!displacement)
        continue;
      sums[fixed_[k] ? 2 : 0] += r * r;
      sums[1] += external.local()[k] * external.local()[k];
      peaks[0] = std::max(peaks[0], std::abs(state.position.local()[k / n_fields * spacedim + k % n_fields]));
    }
  const auto comm = assembler_->distribution()->comm();
  peaks[2]        = interfaces.defects(result.free).angle;
  if (std::isnan(peaks[2]))
    sums[1] = peaks[2];
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, peaks, 3, MPI_DOUBLE, MPI_MAX, comm);

  // Membrane forces and those of penalties cancel to rounding of the coordinates; below that a relative residual has no
  // meaning (theory F.2).
  const double n_unknowns = static_cast<double>(spacedim) * space_->surface().n_control_points();
  const double floor      = 10. * std::numeric_limits<double>::epsilon() *
                       (assembler_->largest_stiffness() * (model_->split.bulk() + model_->split.shear()) + peaks[1]) *
                       peaks[0] * std::sqrt(n_unknowns);
  result.allowed = settings_.tolerance * std::sqrt(std::max(sums[1], sums[2])) + floor;
  result.norm    = std::isfinite(sums[1] + sums[2])
                       ? std::max(std::sqrt(sums[0]), peaks[2] / settings_.tolerance * result.allowed)
                       : std::numeric_limits<double>::quiet_NaN();
  return result;
}

template <class Model>
auto StaticSolver<Model>::linearise(const StateType &state) -> Residual
{
  Vector external(state.distribution, n_fields);
  assembler_->linearise({state.position, *at_rest_, state.phase}, state.history, 0., PhaseTangent::consistent,
                        loads_at(state.time), *internal_, external, *matrix_);
  return measure(state, *internal_, external);
}

template <class Model>
auto StaticSolver<Model>::residual(const StateType &state) -> Residual
{
  Vector external(state.distribution, n_fields);
  assembler_->force({state.position, *at_rest_, state.phase}, state.history, loads_at(state.time), *internal_,
                    external);
  return measure(state, *internal_, external);
}

template <class Model>
std::vector<Vector> StaticSolver<Model>::solve_tangent(std::span<const Vector> rhs)
{
  std::vector<Vector> increments(rhs.begin(), rhs.end());
  decouple_rows(*matrix_, fixed_);
  linear_solver_.solve(*matrix_, rhs, std::span<Vector>(increments));
  for (auto &increment : increments)
    supported_->complete(increment);
  return increments;
}

template <class Model>
Vector StaticSolver<Model>::load_direction(const StateType &state) const
{
  // Loads and supports are affine in lambda, so their derivatives are differences.
  Vector             direction(state.distribution, n_fields), unloaded = direction;
  const BalanceLevel level{state.position, *at_rest_, state.phase};
  assembler_->external_force(level, *loaded_, direction);
  assembler_->external_force(level, *unloaded_, unloaded);
  axpy(-1., unloaded, direction);
  unloaded.fill(0.);
  assembler_->weak_edges().add_force_rate(state.position, state.time, unloaded);
  axpy(-1., unloaded, direction);
  Vector moves = supported_->moves(state.position, 1.);
  axpy(-1., supported_->moves(state.position, 0.), moves);
  for (int a = 0; a < assembler_->distribution()->n_owned(); ++a)
    for (int c = 0; c < n_fields; ++c)
      if (const int k = a * n_fields + c; fixed_[k])
        direction.local()[k] = c < spacedim ? moves.local()[a * spacedim + c] * matrix_->diagonal(a, c) : 0.;
  return direction;
}

template <class Model>
void StaticSolver<Model>::advance(StateType &state, const Vector &increment, double scale) const
{
  for (int a = 0; a < state.distribution->n_local(); ++a)
    for (int c = 0; c < spacedim; ++c)
      state.position.local()[a * spacedim + c] += scale * increment.local()[a * n_fields + c];
}

template <class Model>
auto StaticSolver<Model>::solve_linear(const StateType &start, double factor) -> StateType
{
  // Supports that move push through the columns of their unknowns.
  StateType state  = start;
  state.time       = factor;
  auto       r     = linearise(state);
  const auto moves = supported_->moves(state.position, factor);
  for (int a = 0; a < assembler_->distribution()->n_owned(); ++a)
    for (int c = 0; c < spacedim; ++c)
      if (const int k = a * n_fields + c; fixed_[k])
        r.free.local()[k] = moves.local()[a * spacedim + c] * matrix_->diagonal(a, c);
  advance(state, solve_tangent(std::span<const Vector>(&r.free, 1)).front(), 1.);
  return state;
}

template <class Model>
auto StaticSolver<Model>::solve(const StateType &start, double factor) -> Result
{
  Result    result;
  double    early = 0.;
  StateType state = start;
  try
    {
      // The first step takes the supports with it, so that the body follows smoothly.
      state             = solve_linear(start, factor);
      result.iterations = 1;
      for (int i = 1;; ++i)
        {
          const auto r = linearise(state);
          result.residuals.push_back(r.norm / r.allowed);
          if (!std::isfinite(r.norm))
            result.failure = "the residual is not finite after " + std::to_string(i) + " Newton iterations";
          else if (r.norm <= r.allowed)
            {
              state.step   = start.step + 1;
              result.state = std::move(state);
              return result;
            }
          else if (i <= 3)
            early = r.norm;
          else if (r.norm > settings_.divergence * early)
            result.failure = "Newton's iteration diverges";
          if (result.failure.empty() && i == settings_.max_iterations)
            result.failure = "no equilibrium in " + std::to_string(i) + " Newton iterations (residual " +
                             print(r.norm / r.allowed) + " times the tolerance)";
          if (!result.failure.empty())
            return result;

          const Vector direction = solve_tangent(std::span<const Vector>(&r.free, 1)).front();
          double       length    = 1.;
          if (settings_.line_search.max_trials > 0)
            length = search_line(
                dot(direction, r.free),
                [&](double t) {
                  StateType trial = state;
                  advance(trial, direction, t);
                  return dot(direction, residual(trial).free);
                },
                settings_.line_search);
          advance(state, direction, length);
          ++result.iterations;
        }
    }
  catch (const NoConvergence &error)
    {
      result.failure = error.what();
    }
  return result;
}

} // namespace sherd
