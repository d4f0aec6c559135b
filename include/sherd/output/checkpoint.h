#pragma once

#include <optional>

#include <sherd/base/collective.h>
#include <sherd/output/checkpoint_file.h>
#include <sherd/output/recorder_memory.h>
#include <sherd/space/shell_space.h>
#include <sherd/state/state.h>
#include <sherd/time/step_controller.h>

namespace sherd
{

/// Everything a run needs to go on, on any number of ranks.
template <int degree, int spacedim>
struct Checkpoint
{
  Surface<degree, spacedim>     surface;
  GlobalState<degree, spacedim> state;
  StepController::State         controller;
  RecorderMemory                recorder;
  std::string                   parameters; ///< text of used.yaml
};

/// Writes it to @p file, on the disk when this returns. Serial: for the rank whose recorder has the cracks.
/// @throws FileError   if it cannot be written
template <int degree, int spacedim>
void write_checkpoint(const std::filesystem::path &file, const Checkpoint<degree, spacedim> &checkpoint);

/// Reads a file that write_checkpoint() wrote, bitwise; rank 0 reads, all get it. Collective.
/// @throws FileError   on all ranks: from read_checkpoint_bytes(); another degree or dimension; parts that do not
/// belong
///                     together
template <int degree, int spacedim>
Checkpoint<degree, spacedim> read_checkpoint(const Environment &env, const std::filesystem::path &file);

/// The checkpoint of --restart, nothing without that option. Collective.
/// @param initial   surface of the program before any refinement
/// @throws FileError          from read_checkpoint()
/// @throws InvalidParameter   if the checkpoint's surface is not a refinement of @p initial
template <int degree, int spacedim>
std::optional<Checkpoint<degree, spacedim>> restart_checkpoint(const Environment               &env,
                                                               const Surface<degree, spacedim> &initial);

/// Goes on from a checkpoint: puts what it holds in the place of surface, state and step sizes and prepares space and
/// solver for them. Collective.
template <int degree, int spacedim, class Solver>
void resume(const Checkpoint<degree, spacedim> &checkpoint, Solver &solver, Surface<degree, spacedim> &surface,
            ShellSpace<degree, spacedim> &space, State<degree, spacedim> &state, StepController &controller)
{
  surface = checkpoint.surface;
  space.rebuild();
  state = distribute(checkpoint.state, space);
  solver.rebuild(state);
  controller.restore(checkpoint.controller);
}

/// The arrays of a checkpoint on every rank. Collective. @throws FileError   from read_checkpoint_bytes()
StoredArrays read_checkpoint_arrays(const Environment &env, const std::filesystem::path &file);

} // namespace sherd
