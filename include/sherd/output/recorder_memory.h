#pragma once

#include <map>
#include <string>

#include <sherd/assembly/energy_balance.h>
#include <sherd/output/crack_tree.h>
#include <sherd/output/history.h>
#include <sherd/output/stored_arrays.h>

namespace sherd
{

/// Sums over the accepted steps of a run.
struct RunTotals
{
  int steps = 0, attempts = 0, rejected = 0, repeated = 0, switched = 0, refined = 0, newton = 0, linear = 0;

  void add(const StepSummary &step)
  {
    ++steps;
    attempts += step.attempts;
    rejected += step.rejected;
    repeated += step.repeated;
    switched += step.switched;
    refined += step.refined;
    newton += step.newton;
    linear += step.linear;
  }
};

/// What a RunRecorder remembers from step to step, for checkpoints.
struct RecorderMemory
{
  EnergyBalance::State          balance;
  Energies                      energies; ///< of the last step
  RunTotals                     totals;
  HistoryRow                    last{};
  double                        largest_elastic = 0., largest_elastic_time = 0., largest_imbalance = 0.;
  int                           n_frames     = 0;
  double                        wall_seconds = 0.; ///< of all programs that have worked on the run
  std::map<std::string, double> phase_seconds;     ///< the same by phase
  CrackTree::State              cracks;
};

/// The memory as arrays of a checkpoint, and back. @throws FileError   if something is missing
void           put(ArrayWriter archive, const RecorderMemory &memory);
RecorderMemory get_recorder_memory(ArrayReader archive);

} // namespace sherd
