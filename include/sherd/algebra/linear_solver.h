#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/base/parameter_section.h>

namespace sherd
{

/// How a system is preconditioned; in parameter files by these names.
enum class Preconditioner
{
  point_block_ilu, ///< incomplete factors of small dense blocks, one for each pair of control points
                   ///< (algebra/block_ilu.h)
  ifpack2_ilu,     ///< scalar incomplete factors of Ifpack2 (RILUK), for comparison
  mumps            ///< complete factors: a direct solver
};

/// Throws InvalidParameter with the names there are.
Preconditioner preconditioner_from_name(std::string_view name);
std::string    to_string(Preconditioner preconditioner);

/// What happens when a preconditioner does not do.
enum class Escalation
{
  automatic, ///< more fill, up to max_fill_level, then MUMPS
  never      ///< iterate up to max_iterations, then throw
};

struct LinearSolverSettings
{
  Preconditioner preconditioner  = Preconditioner::point_block_ilu;
  int            fill_level      = 1;    ///< level of fill of the incomplete factors, at least 0
  int            max_fill_level  = 2;    ///< largest level that escalation tries
  int            overlap         = 1;    ///< layers of control points shared between the ranks' factors: 0 or 1
  double         tolerance       = 1e-4; ///< of the residual relative to the right-hand side, both equilibrated
  Escalation     escalation      = Escalation::automatic;
  int            iteration_limit = 40;  ///< iterations after which a preconditioner is given up (automatic)
  int            max_iterations  = 500; ///< iterations allowed without escalation (never)
  int            restart         = 100; ///< size of the Krylov space
  int            retry_interval  = 20;  ///< solves after which an escalated solver tries the cheaper one again
  /// Incomplete factors are kept for the next matrix while it takes no more than this many iterations beyond those with
  /// fresh factors; 0: fresh factors for each solve.
  int reuse = 4;

  void declare(ParameterSection &section)
  {
    section.choice("preconditioner", preconditioner,
                   {{"point_block_ilu", Preconditioner::point_block_ilu},
                    {"ifpack2_ilu", Preconditioner::ifpack2_ilu},
                    {"mumps", Preconditioner::mumps}},
                   "incomplete factors of point blocks, those of Ifpack2, or a direct solver");
    section.value("fill_level", fill_level, range::non_negative(), "level of fill of the incomplete factors");
    section.value("max_fill_level", max_fill_level, range::non_negative(), "largest level that escalation tries");
    section.value("overlap", overlap, range::closed(0., 1.), "layers that neighbouring ranks share in their factors");
    section.value("tolerance", tolerance, "-", range::open(0., 1.), "residual over right-hand side, equilibrated");
    section.choice("escalation", escalation, {{"automatic", Escalation::automatic}, {"never", Escalation::never}},
                   "whether a solver that fails is replaced by a stronger one");
    section.value("iteration_limit", iteration_limit, range::at_least(1), "iterations before escalation");
    section.value("max_iterations", max_iterations, range::at_least(1), "iterations allowed without escalation");
    section.value("reuse", reuse, range::non_negative(),
                  "incomplete factors are kept while they cost no more than this many iterations beyond fresh ones; 0: "
                  "always fresh");
    section.value("restart", restart, range::at_least(1), "size of the Krylov space");
    section.value("retry_interval", retry_interval, range::at_least(1),
                  "solves after which an escalated solver tries the cheaper one again");
  }
};

/// What one solve took, with all its right-hand sides.
struct SolveReport
{
  int            iterations        = 0;  ///< of all attempts and right-hand sides; 1 for each direct solve
  double         relative_residual = 0.; ///< the largest, computed from the solutions, not the recursion of GMRES
  Preconditioner used              = Preconditioner::point_block_ilu;
  int            fill_level        = 0;     ///< of the incomplete factors that did it
  bool           escalated         = false; ///< whether this solve needed more than the preconditioner it began with
  std::string    message;                   ///< one line; names every attempt if there was more than one
  double         setup_seconds = 0., solve_seconds = 0.;
};

/// Solves A x = b by GMRES (Belos, right preconditioned) or directly (MUMPS).
///
/// Rows and columns are equilibrated first by D = diag(|a_ii|^-1/2), since the diagonals of displacement and phase
/// differ by many orders: D A D y = D b, x = D y. A row without diagonal or with a small negative one (a
/// multiplier) is scaled by its largest entry. Unknowns whose row holds the diagonal alone are known beforehand and
/// exact; residuals are relative to what they leave of the right-hand side.
///
/// Several ranks: restricted additive Schwarz, each rank factors its rows and `overlap` layers of its neighbours'.
///
/// Incomplete factors of one matrix serve for the next ones while they are good enough (LinearSolverSettings::reuse).
/// An attempt is given up when it takes more than iteration_limit iterations, when the residual recomputed from the
/// solution misses the tolerance, or when factors or iteration break down. Escalation then goes to the next level of
/// fill, at last to MUMPS; later solves begin there, and every retry_interval solves one step lower.
class LinearSolver
{
public:
  /// Throws InvalidParameter.
  explicit LinearSolver(LinearSolverSettings settings);
  ~LinearSolver();
  LinearSolver(LinearSolver &&) noexcept;
  LinearSolver &operator=(LinearSolver &&) noexcept;

  const LinearSolverSettings &settings() const;

  /// Collective. @p matrix is equilibrated in place, so it has to be assembled anew before the next solve; symbolic
  /// phases are kept as long as its graph is the same object. Ghosts of @p rhs need not be up to date, those of
  /// @p solution are. The old content of @p solution has no influence.
  ///
  /// Throws, on all ranks, NoConvergence if matrix or right-hand side hold a value that is not finite, if a row is
  /// zero, or if the last attempt fails, in particular if MUMPS finds the matrix singular; DimensionMismatch if the
  /// arguments do not fit together.
  SolveReport solve(Matrix &matrix, const Vector &rhs, Vector &solution);

  /// The same for several right-hand sides: solutions[k] = A^-1 rhs[k]. Factors are made once, unless one of the
  /// right-hand sides needs stronger ones, which serve for those after it, too.
  SolveReport solve(Matrix &matrix, std::span<const Vector> rhs, std::span<Vector> solutions);

  /// Solves once more with the matrix of the last solve, which has not been touched since: equilibration and factors
  /// serve as they are. Throws as solve, and Error if there was no solve before.
  SolveReport solve_again(const Matrix &matrix, const Vector &rhs, Vector &solution);

  /// Drops symbolic phases and the memory of escalations: the mesh has changed, or a restart has to repeat this run.
  void forget();

private:
  SolveReport solve_equilibrated(const Matrix &matrix, std::span<const Vector> rhs, std::span<Vector> solutions,
                                 SolveReport report);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sherd
