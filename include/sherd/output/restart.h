#pragma once

#include <sherd/base/parameters.h>

/// Parameters of programs that write checkpoints.
namespace sherd
{

/// The text of used.yaml in a checkpoint. Collective. @throws FileError   from read_checkpoint_bytes()
std::string read_checkpoint_parameters(const Environment &env, const std::filesystem::path &file);

/// Throws InvalidParameter if @p now differs from @p stored in a value below one of the sections @p fixed ("plate",
/// "material.density"); @p file is the checkpoint, for the message.
void refuse_changes(const ParameterSection &stored, const ParameterSection &now, const std::vector<std::string> &fixed,
                    const std::string &file);

/// What read_parameters(env) returns; with --restart what case file and --set do not give is as in the checkpoint, not
/// as in a default. Collective.
/// @param fixed   sections and values that decide body, mesh or model: a restart may repeat but not change them
/// @throws InvalidParameter, FileError   on all ranks
template <ParameterStruct P>
P read_parameters_of_run(const Environment &env, const std::vector<std::string> &fixed)
{
  const auto &restart = env.command_line().restart;
  if (!restart)
    return read_parameters<P>(env);
  P    stored;
  auto section = ParameterSection::of(stored);
  read_parameters(section, read_checkpoint_parameters(env, *restart), "parameters in " + *restart);
  auto now = read_parameters<P>(env, stored);
  refuse_changes(section, ParameterSection::of(now), fixed, *restart);
  return now;
}

/// run() of a program that takes parameters and writes checkpoints: they come from read_parameters_of_run().
template <ParameterStruct P>
int run_restartable(int argc, char **argv, const std::vector<std::string> &fixed,
                    const std::function<void(const Environment &, const P &)> &program)
{
  return run(
      argc, argv, [&](const Environment &env) { program(env, read_parameters_of_run<P>(env, fixed)); },
      [] { return std::string(1, '\n') + parameter_reference<P>(); });
}

} // namespace sherd
