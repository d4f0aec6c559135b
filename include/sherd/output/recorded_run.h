#pragma once

#include <concepts>
#include <optional>

#include <sherd/base/print.h>
#include <sherd/base/stop_request.h>
#include <sherd/output/checkpoint_writer.h>
#include <sherd/output/run_recorder.h>

namespace sherd
{

/// What a program does around every step it takes: record it, write the checkpoints that are due, and end in good order
/// when it is asked to stop or nothing converges. The loop itself stays in the program:
/// @code
/// RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
/// while (state.time < prm.time.end)
///   run.step([&] { return adaptivity.advance(solver, plate, space, state, controller, prm.time.end); });
/// run.finish();
/// @endcode
/// All members are collective.
///
/// @tparam Solver   with what RunRecorder and CheckpointWriter need
template <class Solver, int degree, int spacedim>
class RecordedRun
{
public:
  using SurfaceType = Surface<degree, spacedim>;
  using SpaceType   = ShellSpace<degree, spacedim>;
  using StateType   = State<degree, spacedim>;

  /// Starts the files anew with a row of the initial state, or goes on with those of the checkpoint.
  /// @param directory    prepared, with the used.yaml of this run in it
  /// @param initial      surface before any refinement
  /// @param checkpoint   what the run was resumed from, if it was (restart_checkpoint())
  /// Solver, space, state and controller are those the steps work on; they have to outlive the run. The controller is
  /// asked to stop at evenly spaced frames if its settings want that; where they name times, frames are written.
  /// @throws FileError, InvalidParameter   on all ranks
  RecordedRun(const Environment &env, const OutputDirectory &directory, const SurfaceType &initial,
              const std::optional<Checkpoint<degree, spacedim>> &checkpoint,
              const RecorderSettings<spacedim> &recording, const CheckpointSettings &checkpointing, Solver &solver,
              const SpaceType &space, StateType &state, StepController &controller)
      : env_(env),
        checkpoints_(env, directory, checkpointing),
        recorder_(make_recorder(env, directory, initial, checkpoint, completed(recording, solver, controller), solver,
                                state)),
        solver_(solver),
        source_(solver),
        space_(space),
        state_(state),
        controller_(controller)
  {
    std::vector<double> frames;
    if (controller.settings().hit_frames)
      for (int k = 1; k < recording.frames; ++k)
        frames.push_back(recording.frame_time(k));
    controller.stop_at(frames);
    if (!checkpoint)
      recorder_.start(source_, space_, state_);
  }

  /// One accepted step.
  /// @param advance   takes it and returns its StepSummary; on NoConvergence the state is the last accepted one
  /// @throws StoppedEarly    after a signal or at --max-wall
  /// @throws NoConvergence   from @p advance
  /// Before either a checkpoint and summary.json are written; the message ends with the command that goes on.
  template <std::invocable Advance>
  void step(const Advance &advance)
  {
    recorder_.record(source_, space_, state_, attempt(advance));
    const auto reason = stop_requested(env_);
    if (reason || checkpoints_.due(state_.step))
      write_checkpoint();
    if (reason)
      {
        recorder_.finish(source_, *reason);
        throw StoppedEarly("at t = " + print(state_.time) + ": " + *reason + "; " + checkpoints_.advice());
      }
  }

  /// A checkpoint of the present step, beside those that are written when they are due.
  void write_checkpoint() { checkpoints_.write(solver_, space_, state_, controller_, memory()); }

  /// The end of the run: writes summary.json. @param ending   what ended it
  void finish(const std::string &ending = "done") { recorder_.finish(source_, ending); }

  /// Last row of history.csv, totals, and on rank 0 the cracks.
  RecorderMemory memory() { return recorder_.memory(source_); }

private:
  /// With the names of the loads, and with the times that are asked of the controller.
  static RecorderSettings<spacedim> completed(RecorderSettings<spacedim> recording, const Solver &solver,
                                              const StepController &controller)
  {
    recording.loads   = solver.loads().names();
    const auto &times = controller.settings().times;
    recording.times.insert(recording.times.end(), times.begin(), times.end());
    return recording;
  }

  static RunRecorder<degree, spacedim> make_recorder(const Environment &env, const OutputDirectory &directory,
                                                     const SurfaceType                                 &initial,
                                                     const std::optional<Checkpoint<degree, spacedim>> &checkpoint,
                                                     const RecorderSettings<spacedim> &recording, Solver &solver,
                                                     const StateType &state)
  {
    if (checkpoint)
      return {env, directory, initial, checkpoint->recorder, recording};
    return {env, directory, initial, solver.energies(state), recording};
  }

  template <class Advance>
  StepSummary attempt(const Advance &advance)
  {
    try
      {
        return advance();
      }
    catch (const NoConvergence &error)
      {
        // All ranks fail together. What is known so far is worth a summary, and with other settings the run may go on.
        write_checkpoint();
        recorder_.finish(source_, error.what());
        throw NoConvergence(error.what() + ("; to retry with other settings, " + checkpoints_.advice()));
      }
  }

  Environment                   env_;
  CheckpointWriter              checkpoints_;
  RunRecorder<degree, spacedim> recorder_;
  Solver                       &solver_;
  SolverSource<Solver>          source_;
  const SpaceType              &space_;
  StateType                    &state_;
  const StepController         &controller_;
};

} // namespace sherd
