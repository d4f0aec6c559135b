#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <vector>

#include <sherd/assembly/assembler.h>
#include <sherd/assembly/external_work.h>
#include <sherd/base/timers.h>

namespace sherd
{

/// What an attempt at one step came to.
template <int degree, int spacedim>
struct StepResult
{
  /// The state at the end of the step, its history committed; nothing if the step has to be rejected.
  std::optional<State<degree, spacedim>> state;
  std::string                            failure;            ///< why there is none
  int                                    newton       = 0;   ///< n_NR of paper Eq. (13), see each solver
  int                                    linear       = 0;   ///< linear iterations, all together
  int                                    switched     = 0;   ///< branch switches (theory C.2 2)
  int                                    alternations = 0;   ///< of a staggered solver
  StepWork                               work;               ///< of all forces over the step [energy]
  double                                 withheld_work = 0.; ///< by the history over the step [energy], theory D
  double                                 largest_phase = 0.; ///< at a quadrature point
  /// Estimate of the local error of the displacement: the largest of a control point (displacement_error) over the
  /// diagonal of the box around the undeformed body. 0 without inertia.
  double                   error = 0.;
  std::vector<double>      residuals; ///< |r_u| and |r_phi| relative to their tolerances, larger one
  std::vector<std::string> messages;  ///< escalations of the linear solver, one line each
};

/// A solver of steps: all of them solve the same discrete problem and share what they say of it.
///
/// rebuild() prepares for the present mesh and comes first; attempt() is collective, throws only what no smaller step
/// could mend, and leaves everything as it was if it fails. keep_reactions() comes before the mesh of an accepted step
/// is refined. largest_step() is the largest stable step at present, infinite for implicit schemes.
template <class Solver>
concept StepSolver = requires(Solver &solver, const Solver &fixed, typename Solver::StateType &state, double dt,
                              const std::string &edge)
{
  solver.rebuild(state);
  solver.keep_reactions();
  solver.equilibrate_phase(state);
  solver.set_initial_acceleration(state);
  {
    solver.attempt(state, dt)
    } -> std::same_as<StepResult<Solver::degree, Solver::spacedim>>;
  {
    solver.energies(state)
    } -> std::same_as<Energies>;
  {
    fixed.reaction(edge)
    } -> std::same_as<Point<Solver::spacedim>>;
  {
    fixed.rayleigh_speed()
    } -> std::convertible_to<double>;
  {
    fixed.largest_step()
    } -> std::convertible_to<double>;
  {
    solver.timers()
    } -> std::same_as<PhaseTimers &>;
  fixed.assembler();
  fixed.space();
  fixed.model();
  fixed.loads();
};

} // namespace sherd
