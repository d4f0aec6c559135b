#pragma once

#include <functional>
#include <optional>
#include <string>

#include <sherd/assembly/assembler.h>
#include <sherd/assembly/step_work.h>
#include <sherd/base/timers.h>
#include <sherd/solve/newton_settings.h>
#include <sherd/solve/step_solver.h>
#include <sherd/solve/step_system.h>
#include <sherd/solve/supported_unknowns.h>

namespace sherd
{

/// The discrete equations of a step, which all solvers share: residuals and when they are small enough, tangents, the
/// way through the stages of an implicit step, books.
///
/// The arguments of the constructor have to outlive the equations. All members are collective.
template <class Model>
class StepEquations
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;
  using StateType               = State<degree, spacedim>;
  using Result                  = StepResult<degree, spacedim>;
  using System                  = StepSystem<Model>;

  StepEquations(const Model &model, const ShellSpace<degree, spacedim> &space, const Supports &supports,
                const Loads<spacedim> &loads, const NewtonSettings &settings)
      : model_(&model), space_(&space), supports_(&supports), loads_(&loads), settings_(settings)
  {
  }

  /// For the present mesh of the space and the distribution of @p state.
  void rebuild(const StateType &state);

  /// Interfaces are as stiff as the sheet is at @p phase, InterfaceTerms::soften(): for a step that of its beginning,
  /// for energies that of their state.
  void soften_interfaces(const Vector &phase) { assembler_->soften_interfaces(phase); }

  const Assembler<Model>                    &assembler() const { return *assembler_; }
  const ShellSpace<degree, spacedim>        &space() const { return *space_; }
  const Model                               &model() const { return *model_; }
  const Loads<spacedim>                     &loads() const { return *loads_; }
  const SupportedUnknowns<degree, spacedim> &supported() const { return *supported_; }
  const NewtonSettings                      &settings() const { return settings_; }
  PhaseTimers                               &timers() { return timers_; }

  /// Residual of the iterate and its tangent by the unknowns of a part, in a matrix of these. The unknowns of the other
  /// part have to be fixed, since their forces are not looked at.
  template <Unknowns part = Unknowns::all>
  ResidualNorms linearise(System &system, PhaseTangent tangent, Matrix &matrix);

  /// Residual alone.
  template <Unknowns part = Unknowns::all>
  ResidualNorms evaluate(System &system);

  /// Solves one stage from its predictor; true if the system is solved, else the result says why it is not.
  using StageSolver = std::function<bool(System &, Result &)>;

  /// All stages of an implicit step. Displacement and phase of a stage start from constant velocity and from where the
  /// phase was going. The history of a stage is that of the stage before; the end of the last stage becomes the new
  /// state, and nothing is remembered of a step of which one stage fails. The count of Newton's iterations is that of
  /// the stage that needs most.
  Result take_stages(const StateType &state, double dt, const Stages &stages, const StageSolver &solve);

  /// Whether no element turns inside out from position @p before to @p after (theory F.4); else the result says so.
  bool keeps_orientation(const Vector &before, const Vector &after, Result &result) const;

  /// System of the phase alone, at rest at @p position.
  System phase_system(const Vector &position, Vector phase, const QuadratureField &history) const;

  /// Size of the step before, @p dt in the first one.
  static double previous_step(const StateType &state, double dt) { return state.step_size > 0. ? state.step_size : dt; }

  /// now + ratio (now - before)
  static Vector extrapolate(const Vector &now, const Vector &before, double ratio);

  /// Error of the displacement over a step, StepResult::error.
  double error(const Motion &start, const Motion &end, double dt) const;

  /// Work of forces over a way; multipliers do none.
  StepWork work(const BalancedForces &forces, const Vector &displacement, const Vector &phase_change) const;

  /// Work of rotations that are prescribed in weak form, between two times at a position: they change the energy of the
  /// penalty without any motion, from outside and within alike.
  StepWork work_of_rotations(const Vector &position, double start, double end) const;

  /// Solves M a = f_ext - f_int at the time of @p state with the consistent mass. @p matrix is overwritten.
  /// @tparam part   of the matrix; has the displacement
  /// @throws InvalidParameter   a velocity that the supports do not allow, SupportedUnknowns::check_velocity
  template <Unknowns part = Unknowns::all>
  void set_initial_acceleration(StateType &state, Matrix &matrix) const;

  /// Internal and inertial forces of the last residual, block n_fields; or those that a solver sets. Of a part of the
  /// unknowns, only their rows.
  const std::optional<Vector> &total_force() const { return total_force_; }
  void                         set_total_force(Vector force) { total_force_ = std::move(force); }

private:
  ResidualNorms balance(System &system, Vector force);

  const Model                        *model_;
  const ShellSpace<degree, spacedim> *space_;
  const Supports                     *supports_;
  const Loads<spacedim>              *loads_;
  NewtonSettings                      settings_;

  std::optional<Assembler<Model>>                    assembler_;
  std::optional<SupportedUnknowns<degree, spacedim>> supported_;
  std::vector<char>                                  phase_only_; ///< fixed but for the phase
  std::optional<Vector>                              total_force_;
  PhaseTimers                                        timers_;
};

} // namespace sherd

#include <sherd/solve/step_equations.templates.h>
