#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <sherd/algebra/linear_solver.h>
#include <sherd/assembly/assembler.h>
#include <sherd/assembly/external_work.h>
#include <sherd/base/timers.h>
#include <sherd/solve/newton_settings.h>
#include <sherd/solve/supported_unknowns.h>
#include <sherd/time/integrator.h>
#include <sherd/time/update.h>

namespace sherd
{

/// What an attempt at one step came to.
template <int degree, int spacedim>
struct StepResult
{
  /// The state at the end of the step, its history committed; nothing if the step has to be rejected.
  std::optional<State<degree, spacedim>> state;
  std::string                            failure;            ///< why there is none
  int                                    newton        = 0;  ///< n_NR of paper Eq. (13), see MonolithicSolver
  int                                    linear        = 0;  ///< linear iterations, all together
  int                                    switched      = 0;  ///< branch switches (theory C.2 2)
  StepWork                               work;               ///< of all forces over the step [energy]
  double                                 withheld_work = 0.; ///< by the history over the step [energy], theory D
  double                                 largest_phase = 0.; ///< at a quadrature point
  /// Estimate of the local error of the displacement: the largest of a control point over the diagonal of the box
  /// around the body (displacement_error). 0 without inertia.
  double                   error = 0.;
  std::vector<double>      residuals; ///< |r_u| and |r_phi| relative to their tolerances, larger one
  std::vector<std::string> messages;  ///< escalations of the linear solver, one line each
};

/// Solves displacement and phase of one implicit step together by Newton's method with the full tangent, and makes sure
/// that what it converged to is a stable state.
///
/// A step: predictor (constant velocity, linearly extrapolated phase), Newton on
/// (dy, dphi) with dy = alpha_f dx (theory F.2), branch check; if the check fails a branch switch at the same step size
/// (theory C.2). A state that fails both, or that does not converge, or that is not finite, or in which an element has
/// turned inside out, is never returned.
///
/// Where one more solve with the tangent at hand, of an earlier iterate or step, should meet the tolerance, it is not
/// assembled anew (theory F.2). n_NR counts the iterations with a tangent of their own, and the last one in any case,
/// so that step sizes stay those of Newton's method.
///
/// The arguments of the constructor have to outlive the solver.
template <class Model, ImplicitIntegrator Integrator>
class MonolithicSolver
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;
  using StateType               = State<degree, spacedim>;
  using Result                  = StepResult<degree, spacedim>;

  MonolithicSolver(const Model &model, const ShellSpace<degree, spacedim> &space, const Supports &supports,
                   const Loads<spacedim> &loads, const Integrator &integrator, const NewtonSettings &settings);

  /// Prepares for the present mesh of the space and the distribution of @p state. Call it first and after each
  /// refinement. Collective.
  void rebuild(const StateType &state);

  const Assembler<Model>             &assembler() const { return *assembler_; }
  const ShellSpace<degree, spacedim> &space() const { return *space_; }
  const Model                        &model() const { return *model_; }
  const Loads<spacedim>              &loads() const { return *loads_; }

  /// Solves the phase equation at the displacement of @p state, from its phase, with its history. Collective.
  /// @throws NoConvergence
  void equilibrate_phase(StateType &state);

  /// Solves M a = f_ext - f_int at the time of @p state. Collective.
  void set_initial_acceleration(StateType &state);

  /// Attempts the step from @p state to state.time + dt. Collective. Throws only what no smaller step could mend.
  Result attempt(const StateType &state, double dt);

  /// Energies of @p state. Collective.
  Energies energies(const StateType &state) const
  {
    return assembler_->energies(state.position, state.velocity, state.phase);
  }

  /// Sum of the internal and inertial forces on a named edge, at the end of the last attempted step: what its supports
  /// and loads exert on the surface, shape=(spacedim). Collective.
  Point<spacedim> reaction(const std::string &edge) const;

  /// c_R of the undamaged surface where it is stiffest (theory F.3). After rebuild().
  double rayleigh_speed() const { return assembler_->fastest_waves().rayleigh; }

  /// Largest stable step [time]: an implicit scheme has none.
  double largest_step() const { return std::numeric_limits<double>::infinity(); }

  PhaseTimers &timers() { return timers_; }

private:
  struct System;
  struct Norms
  {
    double displacement, phase; ///< relative to their tolerances
    double larger() const { return std::max(displacement, phase); }
  };

  /// The consistent tangent of an earlier iterate, which the matrix still holds as the linear solver left it.
  struct KeptTangent
  {
    double mass_weight; ///< of its step
    double contraction; ///< of the residual, to be expected from another solve with it
    bool   fresh;       ///< solved with once only
  };

  bool   find_stable_state(System &system, Result &result);
  bool   iterate(System &system, Result &result);
  void   leave_false_branch(System &system, const Vector &start, Result &result);
  bool   on_stable_branch(System &system, Result &result);
  void   observe(const std::vector<double> &residuals);
  bool   expects_use_of_kept_tangent(const std::vector<double> &residuals) const;
  bool   kept_tangent_suffices(double residual) const;
  Norms  linearise(System &system, PhaseTangent tangent);
  Norms  evaluate(System &system);
  Norms  balance(System &system, Vector force);
  void   solve_increment(System &system, Result &result);
  StepWork work(const System &system, double load_time, const Vector &position, const Vector &phase) const;
  double error(const Motion &start, const Motion &end, double dt) const;

  const Model                        *model_;
  const ShellSpace<degree, spacedim> *space_;
  const Supports                     *supports_;
  const Loads<spacedim>              *loads_;
  Integrator                          integrator_;
  NewtonSettings                      settings_;

  std::optional<Assembler<Model>>                    assembler_;
  std::optional<Matrix>                              matrix_;
  LinearSolver                                       linear_solver_;
  std::optional<SupportedUnknowns<degree, spacedim>> supported_;
  std::optional<Vector>                              total_force_;
  std::optional<KeptTangent>                         kept_;
  std::vector<double>                                last_residuals_; ///< of the last step that converged
  PhaseTimers                                        timers_;
};

} // namespace sherd

#include <sherd/solve/monolithic_solver.templates.h>
