#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <sherd/base/environment.h>
#include <sherd/base/parameter_section.h>
#include <sherd/base/text_file.h>

/// Parameters of a program: from the case file and the command line into structs, and back into used.yaml.
namespace sherd
{

/// Reads the YAML document @p text into the members that @p section refers to; what it does not name keeps its default.
/// Then applies @p overrides ({"section.key", "value"}; lists in YAML's form [1, 2]), which may not introduce names
/// either. The top-level key `provenance` is for the reader of the file and skipped.
/// @param source  name of the file for messages.
/// @throws InvalidParameter  for an unknown or repeated key (naming the nearest known one), a value of the wrong type,
///   out of range or NaN, a value that is missing (see ParameterSection::value), always with line and column:
///   "material.poissons_ratio = 0.5 [-], expected a value in (-1, 0.5) (case.yaml:12:20); try 0.3".
/// @throws FileError  if @p text is not one YAML document.
void read_parameters(ParameterSection &section, const std::string &text, const std::string &source,
                     const std::vector<std::pair<std::string, std::string>> &overrides = {});

/// The text of the case file of @p env, empty if none was given. Read by rank 0. Collective.
/// @throws FileError  if there is no such file.
std::string read_case_file(const Environment &env);

/// Everything a program takes from its case file and --set, validated; what is not given is as in @p defaults.
/// Collective; all ranks return the same or throw the same (see the other read_parameters()).
template <ParameterStruct P>
P read_parameters(const Environment &env, P defaults = {})
{
  auto section = ParameterSection::of(defaults);
  read_parameters(section, read_case_file(env), env.command_line().case_file, env.command_line().overrides);
  return defaults;
}

/// Name, unit, default, range and meaning of all parameters, for --help.
std::string parameter_reference(const ParameterSection &section);

template <ParameterStruct P>
std::string parameter_reference()
{
  P defaults;
  return parameter_reference(ParameterSection::of(defaults));
}

/// Facts about a run that are no parameters: {"ranks", "3"}.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// Program, case file, versions, compiler, ranks and threads of this run.
Provenance provenance(const Environment &env);

/// All values of @p section as a case file that reads back to equal values, numbers bitwise; units, ranges and meanings
/// as comments, @p facts under the key `provenance`.
std::string used_yaml(const ParameterSection &section, const Provenance &facts);

/// Writes used.yaml, or whatever @p file is called, on rank 0. Collective.
/// @throws FileError  if that is impossible.
template <ParameterStruct P>
void write_parameters(const Environment &env, const std::filesystem::path &file, P parameters)
{
  write_text(env, file, used_yaml(ParameterSection::of(parameters), provenance(env)));
}

/// run() of a program that takes parameters: reads them, and --help prints their reference.
template <ParameterStruct P>
int run(int argc, char **argv, const std::function<void(const Environment &, const P &)> &program)
{
  return run(
      argc, argv, [&](const Environment &env) { program(env, read_parameters<P>(env)); },
      [] { return std::string(1, '\n') + parameter_reference<P>(); });
}

} // namespace sherd
