#pragma once

#include <chrono>

#include <sherd/base/output_directory.h>
#include <sherd/base/parameter_section.h>
#include <sherd/output/checkpoint.h>

namespace sherd
{

/// When checkpoints are written and how many are kept.
struct CheckpointSettings
{
  int    steps   = 0;   ///< accepted steps between two; 0: not by steps
  double minutes = 10.; ///< wall minutes between two; 0: not by time
  int    keep    = 2;   ///< files, the newest one included

  void declare(ParameterSection &section)
  {
    section.value("steps", steps, range::at_least(0), "accepted steps between two checkpoints; 0: not by steps");
    section.value("minutes", minutes, "min", range::non_negative(),
                  "wall time between two checkpoints; 0: not by time");
    section.value("keep", keep, range::at_least(1), "checkpoints that are kept: checkpoint.h5, checkpoint.1.h5, ...");
  }
};

/// Keeps DIR/checkpoint.h5, the newest checkpoint of a run, and some older ones, checkpoint.1.h5 and so on.
///
/// At every moment checkpoint.h5 is a complete file: a new one is written beside it and renamed. Writing one makes the
/// running program forget what a restarted one would not know (factors, ghosts computed from another side), so that
/// both go on alike.
class CheckpointWriter
{
public:
  /// With --restart of an older checkpoint of this directory the newer ones are removed: the rows of the tables that
  /// belong to them will be as well. Collective.
  /// @pre the directory is prepared and holds the used.yaml of this run
  /// @throws FileError   on all ranks
  CheckpointWriter(const Environment &env, const OutputDirectory &directory, const CheckpointSettings &settings);

  /// Whether the accepted step @p step is one to write a checkpoint after. Collective.
  bool due(int step) const;

  /// Writes a checkpoint of the present step. @p state stays what it is, but is distributed anew. Collective.
  ///
  /// @param memory    of the recorder of the run
  /// @tparam Solver   with timers() and rebuild(state), which has to forget what it kept from earlier steps
  /// @throws FileError   on all ranks; the earlier checkpoints are still there
  template <class Solver, int degree, int spacedim>
  void write(Solver &solver, const ShellSpace<degree, spacedim> &space, State<degree, spacedim> &state,
             const StepController &controller, const RecorderMemory &memory);

  /// How to go on from the newest one, for the last line of a program: "go on with PROGRAM --restart
  /// DIR/checkpoint.h5".
  std::string advice() const;

private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path part() const { return directory_ / "checkpoint.h5.part"; }
  void                  put_in_place() const;

  Environment           env_;
  std::filesystem::path directory_;
  CheckpointSettings    settings_;
  std::string           parameters_;
  Clock::time_point     last_ = Clock::now();
};

template <class Solver, int degree, int spacedim>
void CheckpointWriter::write(Solver &solver, const ShellSpace<degree, spacedim> &space, State<degree, spacedim> &state,
                             const StepController &controller, const RecorderMemory &memory)
{
  {
    const auto timing = solver.timers().measure("checkpoint");
    const auto global = gather(state, space);
    on_root(env_.comm(), [&] {
      write_checkpoint(part(),
                       Checkpoint<degree, spacedim>{space.surface(), global, controller.state(), memory, parameters_});
      put_in_place();
    });
    state = distribute(global, space);
  }
  solver.rebuild(state);
  last_ = Clock::now();
}

} // namespace sherd
