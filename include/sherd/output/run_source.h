#pragma once

#include <string>
#include <vector>

#include <sherd/base/timers.h>
#include <sherd/forms/element_energies.h>
#include <sherd/state/state.h>

namespace sherd
{

/// What recorders ask the solver of a run for, whatever its model and its integrator. So they are compiled once for
/// each degree and dimension.
template <int degree, int spacedim>
class RunSource
{
public:
  virtual ~RunSource() = default;

  virtual PhaseTimers &timers() = 0;

  /// dx_min of the present mesh [length], theory F.3.
  virtual double shortest_edge() const = 0;

  /// What supports and loads of a named edge exert on the surface. Collective.
  virtual Point<spacedim> reaction(const std::string &edge) const = 0;

  /// Of the owned active elements, in their order.
  virtual std::vector<ElementDensities> densities(const State<degree, spacedim> &state) const = 0;
};

/// A solver as the source of a run; it has to outlive this.
/// @tparam Solver   with assembler(), timers() and reaction() as the solvers of steps have them
template <class Solver>
class SolverSource final : public RunSource<Solver::degree, Solver::spacedim>
{
public:
  explicit SolverSource(Solver &solver) : solver_(&solver) {}

  PhaseTimers                  &timers() override { return solver_->timers(); }
  double                        shortest_edge() const override { return solver_->assembler().shortest_edge(); }
  Point<Solver::spacedim>       reaction(const std::string &edge) const override { return solver_->reaction(edge); }
  std::vector<ElementDensities> densities(const State<Solver::degree, Solver::spacedim> &state) const override
  {
    return solver_->assembler().densities(state.position, state.phase);
  }

private:
  Solver *solver_;
};

} // namespace sherd
