#pragma once

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
};

/// Writes what a program leaves behind: history.csv, tips.csv, probes.csv, frames, fields.h5, summary.json, and the
/// progress line on the terminal (doc/output.md). Files are written by rank 0; all members are collective.
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
  }

  /// An accepted step.
  template <class Solver>
  void record(Solver &solver, const SpaceType &space, const StateType &state, const StepSummary &step)
  {
    balance_.add(step);
    memory_.energies = step.energies;
    memory_.totals.add(step);
    write_rows(solver, space, state, step);
    const double next_frame = settings_.end_time / settings_.frames * memory_.n_frames;
    if (state.time >= next_frame * (1. - 1e-9))
      write_frame(solver, space, state);
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
          tips(TipsTable::resume(path, memory.last.time)),
          probes(Probes<spacedim>::resume(path, surface, settings.points, settings.edges, memory.last.time)),
          frames(FrameWriter::resume(path, memory.last.time)),
          fields(FieldsFile::resume(path, degree, spacedim, memory.last.time)),
          tracker(surface, settings.crack),
          progress(memory.last.time, settings.end_time, std::cout)
    {
      tracker.restore(memory.cracks);
    }

    std::filesystem::path directory;
    History               history;
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
