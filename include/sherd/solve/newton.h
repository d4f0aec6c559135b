#pragma once

#include <optional>
#include <vector>

#include <sherd/algebra/linear_solver.h>
#include <sherd/solve/step_equations.h>

namespace sherd
{

/// Newton's method on the unknowns of a step that are not fixed, and the check that what it converged to is a stable
/// state.
///
/// Where one more solve with the tangent at hand, of an earlier iterate or step, should meet the tolerance, it is not
/// assembled anew (theory F.2). StepResult::newton counts the iterations with a tangent of their own, and the last one
/// in any case, so that step sizes stay those of Newton's method.
///
/// An iteration belongs to one set of fixed unknowns: its matrix and its tangents do. That of a half problem assembles,
/// stores and solves the blocks of its unknowns alone.
///
/// @tparam part   the unknowns that it solves for; those of the other part have to be fixed in its systems
template <class Model, Unknowns part = Unknowns::all>
class NewtonIteration
{
public:
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;

  static constexpr FieldRange fields = fields_of(part, spacedim);

  using Equations = StepEquations<Model>;
  using System    = StepSystem<Model>;
  using Result    = typename Equations::Result;

  explicit NewtonIteration(const NewtonSettings &settings) : settings_(settings), linear_solver_(settings.linear) {}

  /// For the present mesh of the equations.
  void rebuild(const Equations &equations);

  /// The tangent is not to be used again: the system will be another one.
  void forget_tangent() { kept_.reset(); }

  Matrix &matrix() { return *matrix_; }

  /// Solves the system and checks that its state is on the stable branch of the phase equation; if it is not, switches
  /// the branch (theory C.2) and solves once more; with the displacement held it does so too where there is no
  /// convergence. False, with the reason in @p result, if that fails.
  bool find_stable_state(Equations &equations, System &system, Result &result) requires(has_phase(part));

  /// Newton's method alone.
  bool iterate(Equations &equations, System &system, Result &result);

private:
  /// The consistent tangent of an earlier iterate, which the matrix still holds as the linear solver left it.
  struct KeptTangent
  {
    double mass_weight; ///< of its step; the phase has no mass
    double contraction; ///< of the residual, to be expected from another solve with it
    bool   fresh;       ///< solved with once only
  };

  void leave_false_branch(Equations &equations, System &system, const Vector &start,
                          Result &result) requires(has_phase(part));
  bool on_stable_branch(Equations &equations, System &system, Result &result) requires(has_phase(part));
  bool phase_is_positive_definite(const std::vector<int> &points) const requires(has_phase(part));

  ResidualNorms linearise(Equations &equations, System &system, PhaseTangent tangent);
  void          solve_increment(Equations &equations, System &system, Result &result);
  SolveReport   solve_system(const Vector &rhs, Vector &solution, const System &system);
  void          go_along(Equations &equations, System &system);
  void          observe(const std::vector<double> &residuals);
  bool          expects_use_of_kept_tangent(const std::vector<double> &residuals) const;
  bool          kept_tangent_suffices(double residual) const;

  NewtonSettings             settings_;
  LinearSolver               linear_solver_;
  std::optional<Matrix>      matrix_;
  std::optional<KeptTangent> kept_;
  std::vector<double>        last_residuals_; ///< of the last step that converged
};

} // namespace sherd

#include <sherd/solve/newton.templates.h>
