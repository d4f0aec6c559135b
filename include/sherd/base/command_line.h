#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// What a user may write behind the name of any program of the library.
namespace sherd
{

/// The options of one run, as given.
struct CommandLine
{
  std::string                                      program = "PROGRAM"; ///< name without its folder
  std::string                                      case_file;           ///< empty: defaults of the program
  std::vector<std::pair<std::string, std::string>> overrides;           ///< {"section.key", "value"}, in order
  std::string                output_directory = "output"; ///< where results go; by default the folder of --restart
  std::optional<std::string> restart;                     ///< checkpoint to go on from
  bool                       overwrite = false;           ///< earlier results may be removed
  bool                       check     = false;           ///< validate, do not run
  std::optional<double>      max_wall_minutes;            ///< stop with a checkpoint after that
  bool                       profile = false;             ///< print where time and memory went at the end
  bool                       help    = false;             ///< print the usage, do not run
};

/// Reads @p arguments (without the program's name). An option and its value may be two words or joined by '='.
/// @throws InvalidParameter  for an unknown option (the message names the nearest known one), a missing or malformed
///                           value, an option given twice, two case files, or --restart together with --overwrite.
CommandLine parse_command_line(std::string program, std::span<const std::string> arguments);

/// The text of --help: one line of synopsis and one line an option.
std::string usage(const std::string &program);

} // namespace sherd
