#pragma once

#include <limits>
#include <map>
#include <string>

#include <sherd/solve/newton.h>

namespace sherd
{

/// What all solvers of steps offer besides the step itself: the equations, the state at the beginning, energies and
/// reactions.
///
/// @tparam part   the unknowns of the iteration that finds the phase: all together or the phase alone
template <class Model, Unknowns part>
class SolverBase
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;
  using StateType               = State<degree, spacedim>;
  using Result                  = StepResult<degree, spacedim>;
  using System                  = StepSystem<Model>;

  /// Prepares for the present mesh of the space and the distribution of @p state. Call it first and after each
  /// refinement. Collective.
  void rebuild(const StateType &state)
  {
    const auto timing = timers().measure("set-up");
    equations_.rebuild(state);
    newton_.rebuild(equations_);
  }

  const Assembler<Model>             &assembler() const { return equations_.assembler(); }
  const ShellSpace<degree, spacedim> &space() const { return equations_.space(); }
  const Model                        &model() const { return equations_.model(); }
  const Loads<spacedim>              &loads() const { return equations_.loads(); }

  /// Solves the phase equation at the displacement of @p state, from its phase, with its history. Collective.
  /// @throws NoConvergence
  void equilibrate_phase(StateType &state)
  {
    const auto timing = timers().measure("initial state");
    equations_.supported().complete_phase(state.phase);
    auto   system = equations_.phase_system(state.position, state.phase, state.history);
    Result result;
    newton_.forget_tangent();
    if (!newton_.find_stable_state(equations_, system, result))
      throw NoConvergence("initial phase field: " + result.failure);
    newton_.forget_tangent();
    if (part != Unknowns::all)
      equations_.evaluate(system); // the reactions
    state.phase          = system.phase;
    state.previous_phase = system.phase;
  }

  /// Gives the velocity of @p state what supports and ties ask for: zero where a support holds the surface at rest,
  /// that of their masters to tied unknowns. Where a support moves the surface it stays. A velocity that obeys them
  /// stays as it is; without this, set_initial_acceleration() refuses any other. Collective.
  void complete_velocity(StateType &state) const { equations_.supported().complete_velocity(state.velocity); }

  /// Energies of @p state, with interfaces that are softened by its phase. Collective.
  Energies energies(const StateType &state)
  {
    equations_.soften_interfaces(state.phase);
    return assembler().energies(state.position, state.velocity, state.phase, state.time);
  }

  /// Sum of the internal and inertial forces on a named edge, at the end of the last attempted step: what its supports
  /// and loads exert on the surface, shape=(spacedim). After rebuild() those of keep_reactions(), or zero. Collective.
  Point<spacedim> reaction(const std::string &edge) const
  {
    if (const auto &force = equations_.total_force())
      return edge_force(space(), *force, edge);
    const auto kept = kept_reactions_.find(edge);
    return kept == kept_reactions_.end() ? Point<spacedim>(Point<spacedim>::Zero()) : kept->second;
  }

  /// Keeps reaction() of all named edges over a rebuild(): forces are known by control point and those of a step go
  /// with the mesh that it was taken on. Call it before that is refined. Collective.
  void keep_reactions()
  {
    std::map<std::string, Point<spacedim>> reactions;
    for (const auto &[edge, sides] : space().surface().edges())
      reactions[edge] = reaction(edge);
    kept_reactions_ = std::move(reactions);
  }

  /// c_R of the undamaged surface where it is stiffest (theory F.3). After rebuild().
  double rayleigh_speed() const { return assembler().fastest_waves().rayleigh; }

  /// Largest stable step [time]: an implicit scheme has none.
  double largest_step() const { return std::numeric_limits<double>::infinity(); }

  PhaseTimers &timers() { return equations_.timers(); }

protected:
  SolverBase(const Model &model, const ShellSpace<degree, spacedim> &space, const Supports &supports,
             const Loads<spacedim> &loads, const NewtonSettings &settings)
      : equations_(model, space, supports, loads, settings), newton_(settings)
  {
  }
  ~SolverBase() = default;

  StepEquations<Model>         equations_;
  NewtonIteration<Model, part> newton_;

private:
  std::map<std::string, Point<spacedim>> kept_reactions_;
};

} // namespace sherd
