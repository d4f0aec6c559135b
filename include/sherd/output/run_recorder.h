#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <sherd/assembly/energy_balance.h>
#include <sherd/base/environment.h>
#include <sherd/base/output_directory.h>
#include <sherd/output/crack_tracker.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/probes.h>
#include <sherd/output/recorder_memory.h>
#include <sherd/output/run_source.h>
#include <sherd/space/shell_space.h>
#include <sherd/state/state.h>

namespace sherd
{

/// What a RunRecorder needs to know of a run.
template <int spacedim>
struct RecorderSettings
{
  CrackOptions                      crack;
  double                            end_time;
  int                               frames = 40; ///< evenly spaced in time, beside the first
  std::vector<PointProbe<spacedim>> points = {}; ///< for probes.csv
  std::vector<std::string>          edges  = {}; ///< for probes.csv: reactions
  std::vector<double>               times  = {}; ///< of frames beside those; steps have to end exactly there
  std::vector<std::string>          loads  = {}; ///< for work.csv: their names, as the solver knows them

  /// Time of evenly spaced frame @p k.
  double frame_time(int k) const { return end_time / frames * k; }
};

/// Writes what a program leaves behind: history.csv, work.csv, tips.csv, probes.csv, frames, fields.h5, summary.json,
/// and the progress line on the terminal (doc/output.md). Files are written by rank 0; all members are collective.
template <int degree, int spacedim>
class RunRecorder
{
public:
  using SpaceType = ShellSpace<degree, spacedim>;
  using StateType = State<degree, spacedim>;
  using Source    = RunSource<degree, spacedim>;

  /// Starts the files anew.
  /// @param directory   prepared
  /// @param surface     before any refinement, if the run can be restarted: probes and lattices for cracks found on it
  ///                    are the same after a restart, bit by bit
  /// @param initial     energies of the initial state
  /// @throws FileError, InvalidParameter   on all ranks
  RunRecorder(const Environment &env, const OutputDirectory &directory, const Surface<degree, spacedim> &surface,
              const Energies &initial, const RecorderSettings<spacedim> &settings);

  /// Goes on from a checkpoint: the files keep their rows and frames up to its time, later ones are removed. Files that
  /// are not there are started anew.
  /// @param memory   RunRecorder::memory() of the run that wrote it
  /// @throws FileError, InvalidParameter   on all ranks
  RunRecorder(const Environment &env, const OutputDirectory &directory, const Surface<degree, spacedim> &surface,
              const RecorderMemory &memory, const RecorderSettings<spacedim> &settings);
  ~RunRecorder();

  /// Row and frame of the initial state.
  void start(Source &source, const SpaceType &space, const StateType &state);

  /// An accepted step.
  void record(Source &source, const SpaceType &space, const StateType &state, const StepSummary &step);

  /// Writes summary.json, and with --profile a table of time and memory to the terminal.
  /// @param ending   how the run ended, for example "done"
  void finish(Source &source, const std::string &ending);

  /// What a checkpoint of the present step has to hold; the cracks on rank 0 only. Collective.
  RecorderMemory memory(Source &source) const;

private:
  struct Files;

  void write_rows(Source &source, const SpaceType &space, const StateType &state, const StepSummary &step);
  void write_frame(Source &source, const SpaceType &space, const StateType &state);

  CsvRow work_row(const HistoryRow &row) const;

  /// Wall seconds by phase, of this program and of those before it. Collective.
  std::map<std::string, double> phase_seconds(Source &source) const;

  double wall_seconds() const { return memory_.wall_seconds + env_.elapsed_seconds(); }

  Environment                env_;
  RecorderSettings<spacedim> settings_;
  EnergyBalance              balance_;
  RecorderMemory             memory_; ///< balance, cracks and seconds: as they were at the start of this program
  std::unique_ptr<Files>     files_;  ///< rank 0 only
};

} // namespace sherd
