#pragma once

#include <string>
#include <vector>

#include <sherd/adapt/marking.h>
#include <sherd/fracture/pre_crack.h>
#include <sherd/solve/monolithic_solver.h>
#include <sherd/state/transfer.h>
#include <sherd/time/step_controller.h>

namespace sherd
{

/// What it took to get one accepted step.
struct StepSummary
{
  double                   dt       = 0.; ///< of the accepted step [time]
  int                      newton   = 0;  ///< iterations of the accepted attempt
  int                      linear   = 0;  ///< linear iterations of all attempts
  int                      attempts = 0;
  int                      rejected = 0; ///< attempts that failed
  int                      repeated = 0; ///< attempts discarded because the mesh was too coarse for them
  int                      switched = 0; ///< branch switches
  int                      refined  = 0; ///< refinements of the mesh
  double                   external_work = 0.; ///< over the step [energy]
  double                   largest_phase = 0.;
  Energies                 energies; ///< at the end of the step, before a refinement
  std::vector<std::string> messages; ///< rejections and escalations, one line each
};

/// Refines the mesh where cracks are or go, and drives single steps: solve, check, refine, repeat.
template <class Model>
class Adaptivity
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  using SurfaceType             = Surface<degree, spacedim>;
  using SpaceType               = ShellSpace<degree, spacedim>;
  using StateType               = State<degree, spacedim>;

  /// @throws InvalidParameter   settings out of range
  Adaptivity(const SurfaceType &surface, const RefinementSettings &settings);

  /// Refines around the pre-cracks until the mesh resolves them, evaluates their initial history and the start value
  /// of the phase on the refined mesh, and solves for the initial phase. Collective.
  template <class Solver>
  void prepare(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
               const PreCrack<spacedim> &pre_crack);

  /// One accepted step of at most controller.step() that does not pass @p end_time: attempts it, rejects and retries,
  /// refines where the result asks for it, and repeats the step if a crack already ran into coarse elements
  /// (theory F.4). On return @p state is the end of the step on the refined mesh. Collective.
  ///
  /// @throws NoConvergence   when the step size falls below its smallest value; @p state is then the last accepted one
  template <class Solver>
  StepSummary advance(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
                      StepController &controller, double end_time);

private:
  template <class Solver>
  void refine(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
              const Triggers<spacedim> &triggers);

  RefinementSettings settings_;
  SpanTarget         target_;
};

} // namespace sherd

#include <sherd/adapt/adaptivity.templates.h>
