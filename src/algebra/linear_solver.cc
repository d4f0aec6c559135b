#include <sherd/algebra/linear_solver.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "equilibration.h"
#include "exchange.h"
#include "factorisation.h"
#include "gmres.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

constexpr std::array<std::pair<Preconditioner, std::string_view>, 3> names = {
    {{Preconditioner::point_block_ilu, "point_block_ilu"},
     {Preconditioner::ifpack2_ilu, "ifpack2_ilu"},
     {Preconditioner::mumps, "mumps"}}};

/// One preconditioner to try.
struct Stage
{
  Preconditioner preconditioner;
  int            fill_level;
};

std::vector<Stage> stages(const LinearSolverSettings &settings)
{
  if (settings.preconditioner == Preconditioner::mumps)
    return {{Preconditioner::mumps, 0}};
  std::vector<Stage> result = {{settings.preconditioner, settings.fill_level}};
  if (settings.escalation == Escalation::automatic)
    {
      for (int level = settings.fill_level + 1; level <= settings.max_fill_level; ++level)
        result.push_back({settings.preconditioner, level});
      result.push_back({Preconditioner::mumps, 0});
    }
  return result;
}

std::string describe(const Stage &stage)
{
  return stage.preconditioner == Preconditioner::mumps
             ? to_string(stage.preconditioner)
             : to_string(stage.preconditioner) + "(" + std::to_string(stage.fill_level) + ")";
}

std::unique_ptr<Factorisation> make(const Stage &stage, int overlap)
{
  switch (stage.preconditioner)
    {
    case Preconditioner::point_block_ilu:
      return make_point_block_ilu(stage.fill_level, overlap);
    case Preconditioner::ifpack2_ilu:
      return make_ifpack2_ilu(stage.fill_level, overlap);
    default:
      return make_mumps();
    }
}

void require(bool condition, const std::string &name, double given, const std::string &allowed)
{
  std::ostringstream message;
  message << "linear solver: " << name << " = " << given << ", expected " << allowed;
  if (!condition)
    throw InvalidParameter(message.str());
}

void check(const LinearSolverSettings &settings)
{
  require(settings.fill_level >= 0, "fill_level", settings.fill_level, "at least 0");
  require(settings.max_fill_level >= 0, "max_fill_level", settings.max_fill_level, "at least 0");
  require(settings.overlap == 0 || settings.overlap == 1, "overlap", settings.overlap, "0 or 1");
  require(settings.tolerance > 0. && settings.tolerance < 1., "tolerance", settings.tolerance, "a value in (0, 1)");
  require(settings.iteration_limit >= 1, "iteration_limit", settings.iteration_limit, "at least 1");
  require(settings.max_iterations >= 1, "max_iterations", settings.max_iterations, "at least 1");
  require(settings.reuse >= 0, "reuse", settings.reuse, "at least 0");
  require(settings.restart >= 1, "restart", settings.restart, "at least 1");
  require(settings.retry_interval >= 1, "retry_interval", settings.retry_interval, "at least 1");
}

/// A direct solver that makes vectors larger than this factor and misses the tolerance has met a singular matrix.
constexpr double nearly_singular = 1e12;

/// Adds the seconds it lives to a sum.
class Stopwatch
{
public:
  explicit Stopwatch(double &seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch &)            = delete;
  Stopwatch &operator=(const Stopwatch &) = delete;

private:
  double                               &seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The equilibrated system and how far its solution has come.
class Progress
{
public:
  /// Starts from the unknowns whose rows hold the diagonal alone.
  Progress(const Matrix &matrix, const Equilibration &equilibration, const Vector &rhs)
      : matrix_(matrix),
        known_(equilibration.known),
        b_(rhs.owned().begin(), rhs.owned().end()),
        x_(equilibration.scaling.size(), 0.)
  {
    for (std::size_t i = 0; i < b_.size(); ++i)
      b_[i] *= equilibration.scaling[i];
    for (const auto &[row, sign] : known_)
      x_[row] = sign * b_[row];
    update_residual();
    norm_ = initial_norm_ = norm_of(residual_);
  }

  std::span<const double> residual() const { return residual_; }
  std::span<const double> solution() const { return x_; }

  /// Residual relative to where it started.
  double relative_residual() const { return initial_norm_ > 0. ? norm_ / initial_norm_ : 0.; }

  /// How much larger a correction is than the residual.
  double amplification(std::span<const double> correction) const { return norm_of(correction) / norm_; }

  /// Takes a correction unless it makes the residual larger or meaningless; tells whether it was taken.
  bool take(std::span<const double> correction)
  {
    const auto x = x_;
    for (std::size_t i = 0; i < correction.size(); ++i)
      x_[i] += correction[i];
    for (const auto &known : known_)
      x_[known.row] = x[known.row];
    const auto residual = residual_;
    update_residual();
    const double norm = norm_of(residual_);
    if (std::isfinite(norm) && norm < norm_)
      {
        norm_ = norm;
        return true;
      }
    x_        = x;
    residual_ = residual;
    return false;
  }

private:
  void update_residual()
  {
    update_ghost_values(matrix_.distribution(), x_, matrix_.block_size());
    residual_.resize(b_.size());
    matrix_.multiply(x_, residual_);
    for (std::size_t i = 0; i < b_.size(); ++i)
      residual_[i] = b_[i] - residual_[i];
    for (const auto &known : known_)
      residual_[known.row] = 0.; // instead of rounding
  }

  double norm_of(std::span<const double> values) const
  {
    double sum = 0.;
    for (const double value : values)
      sum += value * value;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, matrix_.distribution().comm());
    return std::sqrt(sum);
  }

  const Matrix               &matrix_;
  const std::vector<KnownRow> known_;
  std::vector<double>         b_, x_, residual_; ///< x_ with ghosts
  double                      norm_ = 0., initial_norm_ = 0.;
};

} // namespace

Preconditioner preconditioner_from_name(std::string_view name)
{
  std::string allowed;
  for (const auto &[preconditioner, known] : names)
    {
      if (known == name)
        return preconditioner;
      allowed += (allowed.empty() ? "" : ", ") + std::string(known);
    }
  throw InvalidParameter("preconditioner = \"" + std::string(name) + "\", expected one of " + allowed);
}

std::string to_string(Preconditioner preconditioner)
{
  for (const auto &[known, name] : names)
    if (known == preconditioner)
      return std::string(name);
  return "unknown";
}

struct LinearSolver::Impl
{
  explicit Impl(const LinearSolverSettings &given) : settings(given), ladder(stages(given)) {}

  LinearSolverSettings               settings;
  std::vector<Stage>                 ladder;
  std::size_t                        first_stage             = 0; ///< where the next solve begins
  int                                solves_since_escalation = 0;
  std::unique_ptr<Factorisation>     factors; ///< of factors_stage
  std::size_t                        factors_stage = 0;
  std::optional<Equilibration>       equilibration;        ///< of the last matrix
  std::shared_ptr<const SparseGraph> factors_graph;        ///< the matrix they belong to had this graph
  int                                fresh_iterations = 0; ///< of the solve they were made for
  bool                               keep_factors     = false;
  bool                               own_factors      = false; ///< made for the matrix that is being solved

  /// Makes factors of the stage for this matrix; says why if they break down.
  std::string factor(std::size_t stage, const Matrix &matrix, SolveReport &report);

  /// Iterates with the present factors; returns what stopped it short of the tolerance, if anything did.
  std::string iterate(const Matrix &matrix, Progress &progress, int limit, SolveReport &report, int &iterations);

  /// Uses one preconditioner until the tolerance is met or it has to be given up; returns what happened in words.
  std::string attempt(std::size_t stage, const Matrix &matrix, Progress &progress, SolveReport &report);

  /// Attempts one stage after the other from first_stage on, which becomes the one that met the tolerance; returns what
  /// happened in words, nothing if there was nothing to do. Throws NoConvergence.
  std::string climb(const Matrix &matrix, Progress &progress, SolveReport &report);
};

std::string LinearSolver::Impl::factor(std::size_t stage, const Matrix &matrix, SolveReport &report)
{
  own_factors = false;
  try
    {
      const Stopwatch stopwatch(report.setup_seconds);
      if (!factors || factors_stage != stage)
        {
          factors.reset();
          factors       = make(ladder[stage], settings.overlap);
          factors_stage = stage;
        }
      factors->compute(matrix);
      factors_graph = matrix.shared_graph();
      own_factors   = true;
    }
  catch (const NoConvergence &error)
    {
      factors.reset();
      return error.what();
    }
  catch (...)
    {
      factors.reset(); // half made
      throw;
    }
  return {};
}

std::string LinearSolver::Impl::iterate(const Matrix &matrix, Progress &progress, int limit, SolveReport &report,
                                        int &iterations)
{
  const Stopwatch     stopwatch(report.solve_seconds);
  std::string         failure;
  std::vector<double> correction(progress.residual().size());
  bool                direct        = factors->is_complete();
  double              amplification = 0.; // of the complete factors
  while (failure.empty() && progress.relative_residual() > settings.tolerance)
    {
      if (direct)
        {
          factors->apply(progress.residual(), correction);
          amplification = progress.amplification(correction);
          iterations += 1;
        }
      else if (iterations >= limit)
        {
          failure = "gave up";
          break;
        }
      else
        {
          // Somewhat below the tolerance, so that the recomputed residual meets it in spite of rounding.
          const auto result =
              gmres(matrix, *factors, progress.residual(), correction,
                    {.tolerance      = std::min(0.5, 0.9 * settings.tolerance / progress.relative_residual()),
                     .max_iterations = limit - iterations,
                     .restart        = settings.restart});
          iterations += result.iterations;
          failure = result.failure;
        }
      const double before = progress.relative_residual();
      if ((!progress.take(correction) || progress.relative_residual() > 0.5 * before) && !direct && failure.empty() &&
          iterations < limit)
        failure = "stagnated";
      direct = false;
    }
  if (!failure.empty() && amplification > nearly_singular)
    {
      std::ostringstream text;
      text << " (the matrix is nearly singular, its solution is " << amplification
           << " times the right-hand side, both equilibrated; a static body may lack supports, or the load is near a "
              "limit or bifurcation point: add supports, or take another step)";
      failure += text.str();
    }
  return failure;
}

std::string LinearSolver::Impl::attempt(std::size_t stage, const Matrix &matrix, Progress &progress,
                                        SolveReport &report)
{
  const int limit      = settings.escalation == Escalation::never ? settings.max_iterations : settings.iteration_limit;
  int       iterations = 0;

  // Kept factors are no reason to escalate: where they do not do, fresh ones of the same kind go on from there.
  const bool own  = own_factors && factors_stage == stage;
  const bool kept = !own && keep_factors && factors && factors_stage == stage && factors_graph == matrix.shared_graph();
  std::string failure;
  if (kept)
    {
      const int patience = std::min(limit, 2 * (fresh_iterations + settings.reuse));
      failure            = iterate(matrix, progress, patience, report, iterations);
      keep_factors       = failure.empty() && iterations <= fresh_iterations + settings.reuse;
    }
  if (!kept || !failure.empty())
    {
      failure = own ? std::string() : factor(stage, matrix, report);
      if (!failure.empty())
        return failure;
      int fresh        = 0;
      failure          = iterate(matrix, progress, limit, report, fresh);
      fresh_iterations = own ? std::max(fresh_iterations, fresh) : fresh;
      iterations += fresh;
      keep_factors = settings.reuse > 0 && failure.empty() && !factors->is_complete();
    }
  report.iterations += iterations;

  std::ostringstream text;
  text << (failure.empty() ? "" : failure + " ") << "after " << iterations
       << (iterations == 1 ? " iteration" : " iterations") << " at a relative residual of "
       << progress.relative_residual();
  return text.str();
}

std::string LinearSolver::Impl::climb(const Matrix &matrix, Progress &progress, SolveReport &report)
{
  std::string history;
  auto        stage = first_stage;
  while (!(progress.relative_residual() <= settings.tolerance))
    {
      if (!history.empty())
        ++stage;
      if (stage == ladder.size())
        {
          std::ostringstream message;
          message << "linear solver: tolerance " << settings.tolerance << " not met; " << history;
          throw NoConvergence(message.str());
        }
      history +=
          (history.empty() ? "" : "; ") + describe(ladder[stage]) + " " + attempt(stage, matrix, progress, report);
    }
  first_stage = stage;
  return history;
}

LinearSolver::LinearSolver(LinearSolverSettings settings)
{
  check(settings);
  impl_ = std::make_unique<Impl>(settings);
}

LinearSolver::~LinearSolver()                                   = default;
LinearSolver::LinearSolver(LinearSolver &&) noexcept            = default;
LinearSolver &LinearSolver::operator=(LinearSolver &&) noexcept = default;

const LinearSolverSettings &LinearSolver::settings() const
{
  return impl_->settings;
}

void LinearSolver::forget()
{
  impl_->factors.reset();
  impl_->factors_graph.reset();
  impl_->equilibration.reset();
  impl_->keep_factors            = false;
  impl_->first_stage             = 0;
  impl_->solves_since_escalation = 0;
}

SolveReport LinearSolver::solve(Matrix &matrix, const Vector &rhs, Vector &solution)
{
  return solve(matrix, std::span(&rhs, 1), std::span(&solution, 1));
}

namespace
{

void check_sizes(const Matrix &matrix, std::span<const Vector> rhs, std::span<Vector> solutions)
{
  if (rhs.size() != solutions.size())
    throw DimensionMismatch("linear solver: " + std::to_string(rhs.size()) + " right-hand sides and " +
                            std::to_string(solutions.size()) + " solutions, expected as many of both");
  const auto check_size = [&](const Vector &vector) {
    if (vector.block_size() != matrix.block_size() ||
        vector.distribution().n_local() != matrix.distribution().n_local())
      throw DimensionMismatch(
          "linear solver: right-hand side and solution need the block size and the control points of the matrix");
  };
  std::for_each(rhs.begin(), rhs.end(), check_size);
  std::for_each(solutions.begin(), solutions.end(), check_size);
}

} // namespace

SolveReport LinearSolver::solve(Matrix &matrix, std::span<const Vector> rhs, std::span<Vector> solutions)
{
  check_sizes(matrix, rhs, solutions);
  SolveReport report;
  {
    const Stopwatch stopwatch(report.setup_seconds);
    std::for_each(rhs.begin(), rhs.end(), check_finite);
    impl_->equilibration = equilibrate(matrix);
  }
  impl_->own_factors = false;
  return solve_equilibrated(matrix, rhs, solutions, std::move(report));
}

SolveReport LinearSolver::solve_again(const Matrix &matrix, const Vector &rhs, Vector &solution)
{
  if (!impl_->equilibration || impl_->factors_graph != matrix.shared_graph())
    throw Error("linear solver: solve_again without a solve of this matrix before");
  check_sizes(matrix, std::span(&rhs, 1), std::span(&solution, 1));
  check_finite(rhs);
  return solve_equilibrated(matrix, std::span(&rhs, 1), std::span(&solution, 1), {});
}

SolveReport LinearSolver::solve_equilibrated(const Matrix &matrix, std::span<const Vector> rhs,
                                             std::span<Vector> solutions, SolveReport report)
{
  auto &self = *impl_;
  if (self.first_stage > 0 && ++self.solves_since_escalation >= self.settings.retry_interval)
    {
      self.solves_since_escalation = 0;
      --self.first_stage;
    }
  const auto begun = self.first_stage;
  for (std::size_t k = 0; k < rhs.size(); ++k)
    {
      Progress   progress(matrix, *self.equilibration, rhs[k]);
      const auto history = self.climb(matrix, progress, report);
      if (!history.empty())
        report.message += (report.message.empty() ? "" : "; ") +
                          (rhs.size() > 1 ? "right-hand side " + std::to_string(k) + ": " : "") + history;
      report.relative_residual = std::max(report.relative_residual, progress.relative_residual());
      for (std::size_t i = 0; i < solutions[k].local().size(); ++i)
        solutions[k].local()[i] = self.equilibration->scaling[i] * progress.solution()[i];
    }
  if (self.first_stage > begun)
    {
      self.solves_since_escalation = 0;
      report.escalated             = true;
    }
  report.used       = self.ladder[self.first_stage].preconditioner;
  report.fill_level = self.ladder[self.first_stage].fill_level;
  if (report.message.empty())
    report.message = "nothing to solve";
  return report;
}

} // namespace sherd
