#pragma once

#include <algorithm>

#include <sherd/assembly/step_summary.h>

namespace sherd
{

/// Keeps the books of a run,
///
///   kinetic + elastic + fracture + irreversible = their initial value + external work + balance * largest,
///
/// with irreversible = int int g'(phi) (H - Psi+) dphi dA, the work that the history field withholds, and largest the
/// largest magnitude of these terms so far. What the balance shows is the dissipation of the integrator.
///
/// Source: theory D (energy balance), J.7 (vi).
class EnergyBalance
{
public:
  /// @param initial   energies at the start of the run
  explicit EnergyBalance(const Energies &initial)
      : initial_(initial.elastic() + initial.kinetic + initial.fracture), now_(initial)
  {
    note_largest();
  }

  /// Adds an accepted step.
  void add(const StepSummary &step)
  {
    now_ = step.energies;
    work_ += step.external_work;
    irreversible_ += step.withheld_work;
    note_largest();
  }

  double external_work() const { return work_; }        ///< by loads and supports since the start [energy]
  double irreversible() const { return irreversible_; } ///< since the start [energy]

  /// What the energies leave over, relative to the largest of them so far; 0 while all are 0.
  double balance() const
  {
    const double left = now_.elastic() + now_.kinetic + now_.fracture + irreversible_ - initial_ - work_;
    return largest_ > 0. ? left / largest_ : 0.;
  }

private:
  void note_largest()
  {
    for (const double energy : {now_.elastic(), now_.kinetic, now_.fracture, work_, irreversible_})
      largest_ = std::max(largest_, std::abs(energy));
  }

  double   initial_;
  Energies now_;
  double   work_ = 0., irreversible_ = 0., largest_ = 0.;
};

} // namespace sherd
