#pragma once

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <sherd/assembly/energy_balance.h>
#include <sherd/base/all_gather.h>
#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/profile.h>
#include <sherd/base/progress.h>
#include <sherd/output/crack_tracker.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/fields_file.h>
#include <sherd/output/frames.h>
#include <sherd/output/history.h>
#include <sherd/output/json.h>
#include <sherd/output/probes.h>
#include <sherd/output/recorder_memory.h>
#include <sherd/output/tips_table.h>
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
  std::vector<PointProbe<spacedim>> points;      ///< for probes.csv
  std::vector<std::string>          edges;       ///< for probes.csv: reactions
  std::vector<double>               times;       ///< of frames beside those; steps have to end exactly there
  std::vector<std::string>          loads;       ///< for work.csv: their names, as the solver knows them

  /// Time of evenly spaced frame @p k.
  double frame_time(int k) const { return end_time / frames * k; }
};

/// Writes what a program leaves behind: history.csv, work.csv, tips.csv, probes.csv, frames, fields.h5, summary.json,
/// and the progress line on the terminal (doc/output.md). Files are written by rank 0; all members are collective.
///
/// @tparam Solver arguments need assembler(), timers(), energies() and reaction() as MonolithicSolver has them.
template <int degree, int spacedim>
class RunRecorder
{
public:
  using SpaceType = ShellSpace<degree, spacedim>;
  using StateType = State<degree, spacedim>;

  /// Starts the files anew.
  /// @param directory   prepared
  /// @param surface     before any refinement, if the run can be restarted: probes and lattices for cracks found on it
  ///                    are the same after a restart, bit by bit
  /// @param initial     energies of the initial state
  /// @throws FileError, InvalidParameter   on all ranks
  RunRecorder(const Environment &env, const OutputDirectory &directory, const Surface<degree, spacedim> &surface,
              const Energies &initial, const RecorderSettings<spacedim> &settings)
      : env_(env), settings_(settings), balance_(initial)
  {
    memory_.energies = initial;
    on_root(env.comm(), [&] { files_ = std::make_unique<Files>(directory.path(), surface, settings); });
  }

  /// Goes on from a checkpoint: the files keep their rows and frames up to its time, later ones are removed. Files that
  /// are not there are started anew.
  /// @param memory   RunRecorder::memory() of the run that wrote it
  /// @throws FileError, InvalidParameter   on all ranks
  RunRecorder(const Environment &env, const OutputDirectory &directory, const Surface<degree, spacedim> &surface,
              const RecorderMemory &memory, const RecorderSettings<spacedim> &settings)
      : env_(env), settings_(settings), balance_(memory.balance), memory_(memory)
  {
    on_root(env.comm(), [&] { files_ = std::make_unique<Files>(directory.path(), surface, settings, memory); });
  }

  /// Row and frame of the initial state.
  template <class Solver>
  void start(Solver &solver, const SpaceType &space, const StateType &state)
  {
    write_rows(solver, space, state, {});
    write_frame(solver, space, state);
    ++memory_.n_frames;
  }

  /// An accepted step.
  template <class Solver>
  void record(Solver &solver, const SpaceType &space, const StateType &state, const StepSummary &step)
  {
    balance_.add(step);
    memory_.energies = step.energies;
    memory_.totals.add(step);
    write_rows(solver, space, state, step);
    const bool is_due = state.time >= settings_.frame_time(memory_.n_frames) * (1. - 1e-9);
    if (is_due || std::find(settings_.times.begin(), settings_.times.end(), state.time) != settings_.times.end())
      write_frame(solver, space, state);
    memory_.n_frames += is_due;
  }

  /// Writes summary.json, and with --profile a table of time and memory to the terminal.
  /// @param ending   how the run ended, for example "done"
  template <class Solver>
  void finish(Solver &solver, const std::string &ending);

  /// What a checkpoint of the present step has to hold; the cracks on rank 0 only. Collective.
  template <class Solver>
  RecorderMemory memory(Solver &solver) const;

private:
  struct Files
  {
    Files(const std::filesystem::path &path, const Surface<degree, spacedim> &surface,
          const RecorderSettings<spacedim> &settings)
        : directory(path),
          history(path),
          work(path / "work.csv", work_columns(settings)),
          tips(path),
          probes(path, surface, settings.points, settings.edges),
          frames(path),
          fields(path, degree, spacedim),
          tracker(surface, settings.crack),
          progress(0., settings.end_time, std::cout)
    {
    }

    Files(const std::filesystem::path &path, const Surface<degree, spacedim> &surface,
          const RecorderSettings<spacedim> &settings, const RecorderMemory &memory)
        : directory(path),
          history(History::resume(path, memory.last.time)),
          work(CsvTable::resume(path / "work.csv", work_columns(settings), memory.last.time)),
          tips(TipsTable::resume(path, memory.last.time)),
          probes(Probes<spacedim>::resume(path, surface, settings.points, settings.edges, memory.last.time)),
          frames(FrameWriter::resume(path, memory.last.time)),
          fields(FieldsFile::resume(path, degree, spacedim, memory.last.time)),
          tracker(surface, settings.crack),
          progress(memory.last.time, settings.end_time, std::cout)
    {
      tracker.restore(memory.cracks);
    }

    static std::vector<std::string> work_columns(const RecorderSettings<spacedim> &settings)
    {
      std::vector<std::string> columns{"step", "time", "supports"};
      columns.insert(columns.end(), settings.loads.begin(), settings.loads.end());
      return columns;
    }

    std::filesystem::path directory;
    History               history;
    CsvTable              work;
    TipsTable             tips;
    Probes<spacedim>      probes;
    FrameWriter           frames;
    FieldsFile            fields;
    CrackTracker          tracker;
    ProgressLine          progress;
  };

  template <class Solver>
  void write_rows(Solver &solver, const SpaceType &space, const StateType &state, const StepSummary &step);
  template <class Solver>
  void write_frame(Solver &solver, const SpaceType &space, const StateType &state);

  CsvRow work_row(const HistoryRow &row) const;

  /// Wall seconds by phase, of this program and of those before it. Collective.
  template <class Solver>
  std::map<std::string, double> phase_seconds(Solver &solver) const;

  double wall_seconds() const { return memory_.wall_seconds + env_.elapsed_seconds(); }

  Environment                env_;
  RecorderSettings<spacedim> settings_;
  EnergyBalance              balance_;
  RecorderMemory             memory_; ///< balance, cracks and seconds: as they were at the start of this program
  std::unique_ptr<Files>     files_;  ///< rank 0 only
};

} // namespace sherd

#include <sherd/output/run_recorder.templates.h>
