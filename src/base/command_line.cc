#include <sherd/base/command_line.h>

#include <cmath>
#include <filesystem>
#include <set>

#include <sherd/base/exceptions.h>
#include <sherd/base/nearest_name.h>
#include <sherd/base/print.h>

namespace sherd
{
namespace
{

struct Option
{
  std::string name, value, meaning; ///< value: what stands behind the option, empty for none
};

const std::vector<Option> &options()
{
  static const std::vector<Option> all{
      {"--set", "section.key=value", "use this value instead of that of the case file; may be repeated"},
      {"--output", "DIR", "write results into DIR (default: output; with --restart the folder of FILE)"},
      {"--restart", "FILE", "go on from this checkpoint, with its parameters where none are given"},
      {"--overwrite", "", "remove earlier results in DIR first"},
      {"--check", "", "validate the input, do not run"},
      {"--max-wall", "MINUTES", "stop (exit status 4) after that many minutes"},
      {"--profile", "", "print a table of wall time by phase and of memory at the end"},
      {"--help", "", "print this text and the parameters of the program"}};
  return all;
}

const Option &find_option(const std::string &name)
{
  std::vector<std::string> names;
  for (const auto &option : options())
    {
      if (option.name == name)
        return option;
      names.push_back(option.name);
    }
  throw InvalidParameter("unknown option " + name + ", the nearest known one is " + nearest_name(name, names) +
                         "; see --help");
}

std::pair<std::string, std::string> parse_override(const std::string &text)
{
  const auto equals = text.find('=');
  if (equals == 0 || equals == text.npos)
    throw InvalidParameter("--set " + text + ", expected section.key=value");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

double parse_minutes(const std::string &text)
{
  const auto minutes = parse_double(text);
  if (!minutes || !std::isfinite(*minutes) || *minutes <= 0.)
    throw InvalidParameter("--max-wall " + text + ", expected a positive number of minutes");
  return *minutes;
}

void store(CommandLine &line, const std::string &name, const std::string &value)
{
  if (name == "--set")
    line.overrides.push_back(parse_override(value));
  else if (name == "--output")
    line.output_directory = value;
  else if (name == "--restart")
    line.restart = value;
  else if (name == "--overwrite")
    line.overwrite = true;
  else if (name == "--check")
    line.check = true;
  else if (name == "--max-wall")
    line.max_wall_minutes = parse_minutes(value);
  else if (name == "--profile")
    line.profile = true;
  else if (name == "--help")
    line.help = true;
}

} // namespace

CommandLine parse_command_line(std::string program, std::span<const std::string> arguments)
{
  CommandLine line;
  line.program = std::move(program);
  std::set<std::string> seen;
  for (std::size_t i = 0; i < arguments.size(); ++i)
    {
      const auto &argument = arguments[i];
      if (!argument.starts_with("-"))
        {
          if (argument.empty())
            throw InvalidParameter("an empty argument, expected the name of a case file or an option");
          if (!line.case_file.empty())
            throw InvalidParameter("two case files, " + line.case_file + " and " + argument + ", expected one at most");
          line.case_file = argument;
          continue;
        }

      const auto  equals = argument.find('=');
      const auto &option = find_option(argument.substr(0, equals));
      if (!seen.insert(option.name).second && option.name != "--set")
        throw InvalidParameter("option " + option.name + " is given twice");

      std::string value;
      if (option.value.empty() && equals != argument.npos)
        throw InvalidParameter(argument + ", expected no value behind " + option.name);
      if (!option.value.empty())
        {
          if (equals != argument.npos)
            value = argument.substr(equals + 1);
          else if (i + 1 < arguments.size() && !arguments[i + 1].starts_with("--"))
            value = arguments[++i];
          if (value.empty())
            throw InvalidParameter("option " + option.name + " lacks its value, expected " + option.name + " " +
                                   option.value);
        }
      store(line, option.name, value);
    }

  if (line.restart && line.overwrite)
    throw InvalidParameter("--restart and --overwrite exclude each other: a restart goes on with the results that "
                           "--overwrite would remove; choose one, or restart into a new --output DIR");
  // The results that a restart goes on with are where its checkpoint is.
  if (line.restart && !seen.contains("--output"))
    {
      const auto folder     = std::filesystem::path(*line.restart).parent_path().string();
      line.output_directory = folder.empty() ? "." : folder;
    }
  return line;
}

std::string usage(const std::string &program)
{
  std::string synopsis = "usage: " + program + " [case.yaml]", list;
  for (const auto &option : options())
    {
      const auto form = option.value.empty() ? option.name : option.name + " " + option.value;
      synopsis += " [" + form + "]" + (option.name == "--set" ? "..." : "");
      list += "  " + form + std::string(25 - form.size(), ' ') + option.meaning + "\n";
    }
  return synopsis + "\n\n" + list + "\nexit status: 0 done, 2 bad input, 3 not converged, 4 stopped early\n";
}

} // namespace sherd
