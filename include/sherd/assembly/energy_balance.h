#pragma once

#include <algorithm>

#include <sherd/assembly/step_summary.h>

namespace sherd
{

/// Keeps the books of a run,
///
///   kinetic + elastic + fracture + constraint + irreversible = their initial value + external work + balance *
///   largest,
///
/// with irreversible = int int g'(phi) (H - Psi+) dphi dA, the work that the history field withholds, and largest the
/// largest magnitude of these terms so far. What the balance shows is the dissipation of the integrator.
///
/// Source: theory D (energy balance), J.7 (vi).
class EnergyBalance
{
public:
  /// What it remembers, for checkpoints [energy].
  struct State
  {
    double   initial = 0.; ///< sum of the energies at the start
    Energies now;
    double   work = 0., irreversible = 0., largest = 0.;
  };

  /// Goes on from a checkpoint.
  explicit EnergyBalance(const State &state) : state_(state) {}

  /// @param initial   energies at the start of the run
  explicit EnergyBalance(const Energies &initial) : state_{.initial = total(initial), .now = initial}
  {
    note_largest();
  }

  /// Adds an accepted step.
  void add(const StepSummary &step)
  {
    state_.now = step.energies;
    state_.work += step.external_work;
    state_.irreversible += step.withheld_work;
    note_largest();
  }

  const State &state() const { return state_; }

  double external_work() const { return state_.work; }        ///< by loads and supports since the start [energy]
  double irreversible() const { return state_.irreversible; } ///< since the start [energy]

  /// What the energies leave over, relative to the largest of them so far; 0 while all are 0.
  double balance() const
  {
    const auto  &now  = state_.now;
    const double left = total(now) + state_.irreversible - state_.initial - state_.work;
    return state_.largest > 0. ? left / state_.largest : 0.;
  }

private:
  static double total(const Energies &energies)
  {
    return energies.elastic() + energies.kinetic + energies.fracture + energies.constraint;
  }

  void note_largest()
  {
    const auto &now = state_.now;
    for (const double energy :
         {now.elastic(), now.kinetic, now.fracture, now.constraint, state_.work, state_.irreversible})
      state_.largest = std::max(state_.largest, std::abs(energy));
  }

  State state_;
};

} // namespace sherd
