#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/assembly/step_summary.h>

namespace sherd
{

/// Keeps the books of a run,
///
///   kinetic + elastic + fracture + constraint + irreversible = their initial value + external work + balance *
///   largest,
///
/// with irreversible = int int g'(phi) (H - Psi+) dphi dA, the work that the history field withholds, and largest the
/// largest magnitude of these terms so far. What the balance leaves over is the dissipation of the integrator and what
/// refinements of the mesh add, both known by themselves:
///
///   dissipation = sum over the steps of (f_int + M a).dx + f_phi.dphi - d(kinetic + elastic + fracture + constraint)
///                 - withheld work,
///
/// forces at the level of the balance; its inertial part is M a . dx - d(kinetic). A refinement leaves all fields as
/// they are, but integrates their energies at other points. So
///
///   closure * largest = balance * largest + dissipation - refinement
///
/// is no more than the residual that Newton's method leaves, times the way.
///
/// Source: theory D (energy balance), F, J.7 (vi).
class EnergyBalance
{
public:
  /// What it remembers, for checkpoints [energy].
  struct State
  {
    double       initial      = 0.; ///< sum of the energies at the start
    Energies     now          = {};
    ExternalWork work         = {};
    double       irreversible = 0., dissipation = 0., inertial_dissipation = 0., refinement = 0., largest = 0.;
  };

  /// Goes on from a checkpoint.
  explicit EnergyBalance(const State &state) : state_(state) {}

  /// @param initial   energies at the start of the run
  explicit EnergyBalance(const Energies &initial)
  {
    state_.initial = total(initial);
    state_.now     = initial;
    note_largest();
  }

  /// Adds an accepted step.
  void add(const StepSummary &step)
  {
    const Energies before = step.before.value_or(state_.now);
    state_.refinement += total(before) - total(state_.now);
    state_.dissipation += step.work.internal - (total(step.energies) - total(before)) - step.withheld_work;
    state_.inertial_dissipation += step.work.inertial - (step.energies.kinetic - before.kinetic);
    state_.now = step.energies;
    state_.work += step.work.external;
    state_.irreversible += step.withheld_work;
    note_largest();
  }

  const State &state() const { return state_; }

  const ExternalWork &work() const { return state_.work; } ///< since the start [energy]

  double external_work() const { return state_.work.total(); }                ///< by loads and supports [energy]
  double irreversible() const { return state_.irreversible; }                 ///< since the start [energy]
  double dissipation() const { return state_.dissipation; }                   ///< of the integrator since the start
  double inertial_dissipation() const { return state_.inertial_dissipation; } ///< part of it [energy]
  double refinement() const { return state_.refinement; }                     ///< energy added by it [energy]

  /// What the energies leave over, relative to the largest of them so far; 0 while all are 0.
  double balance() const { return relative(left()); }

  /// What is left over when dissipation and refinement are known, relative to the same.
  double closure() const { return relative(left() + state_.dissipation - state_.refinement); }

private:
  static double total(const Energies &energies)
  {
    return energies.elastic() + energies.kinetic + energies.fracture + energies.constraint;
  }

  double left() const { return total(state_.now) + state_.irreversible - state_.initial - state_.work.total(); }
  double relative(double energy) const { return state_.largest > 0. ? energy / state_.largest : 0.; }

  void note_largest()
  {
    const auto &now = state_.now;
    for (const double energy :
         {now.elastic(), now.kinetic, now.fracture, now.constraint, state_.work.total(), state_.irreversible})
      state_.largest = std::max(state_.largest, std::abs(energy));
  }

  State state_;
};

} // namespace sherd
