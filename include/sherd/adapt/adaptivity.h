#pragma once

#include <string>
#include <vector>

#include <sherd/adapt/marking.h>
#include <sherd/assembly/step_summary.h>
#include <sherd/fracture/pre_crack.h>
#include <sherd/solve/monolithic_solver.h>
#include <sherd/state/transfer.h>
#include <sherd/time/step_controller.h>

namespace sherd
{

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

  /// @throws InvalidParameter   a target that is not positive, a halo that is negative
  Adaptivity(const SurfaceType &surface, const RefinementSettings &settings);

  /// Refines around the pre-cracks until the mesh resolves them, evaluates their initial history and the start value
  /// of the phase on the refined mesh, and solves for the initial phase. @p state starts anew at rest. Collective.
  ///
  /// @throws InvalidParameter   a pre-crack that no quadrature point feels
  /// @throws NoConvergence      no initial phase found
  template <class Solver>
  void prepare(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
               const PreCrack<spacedim> &pre_crack);

  /// One accepted step of at most controller.step() that does not pass @p end_time nor the next time at which the
  /// controller has to stop, and ends exactly there if it reaches it: attempts it, rejects and retries, refines where
  /// the result asks for it, and repeats the step if a crack already ran into coarse elements (theory F.4). On return
  /// @p state is the end of the step on the refined mesh. Collective.
  ///
  /// @throws NoConvergence   when the step size falls below its smallest value; @p state is then the last accepted one
  template <class Solver>
  StepSummary advance(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
                      StepController &controller, double end_time);

private:
  template <class Solver>
  void refine(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
              const Triggers<spacedim> &triggers);

  RefinementSettings      settings_;
  std::vector<SpanTarget> targets_;            ///< by patch
  bool                    is_new_mesh_ = true; ///< since the last accepted step
};

} // namespace sherd

#include <sherd/adapt/adaptivity.templates.h>
