#include <sherd/base/output_directory.h>

#include <algorithm>

#include <sherd/base/collective.h>

namespace sherd
{
namespace fs = std::filesystem;

namespace
{

constexpr const char *frames_folder = "frames";

bool is_frame(const fs::path &file)
{
  const auto stem = file.stem().string();
  return file.extension() == ".vtu" && stem.size() >= 6 && stem.find_first_not_of("0123456789") == std::string::npos;
}

/// checkpoint.N.h5
bool is_older_checkpoint(const fs::path &file)
{
  const auto                 name = file.filename().string();
  constexpr std::string_view head = "checkpoint.", tail = ".h5";
  if (!name.starts_with(head) || !name.ends_with(tail) || name.size() <= head.size() + tail.size())
    return false;
  const auto number = name.substr(head.size(), name.size() - head.size() - tail.size());
  return number.find_first_not_of("0123456789") == std::string::npos;
}

/// Turns errors of the file system into ours.
template <class Task>
void with_file_errors(const fs::path &path, const Task &task)
{
  try
    {
      task();
    }
  catch (const fs::filesystem_error &e)
    {
      throw FileError("output directory " + path.string() + ": " + e.code().message());
    }
}

void check(const fs::path &path, const CommandLine &line)
{
  if (line.restart && !fs::exists(*line.restart))
    throw FileError("--restart " + *line.restart + ": there is no such file");
  if (fs::exists(path) && !fs::is_directory(path))
    throw FileError("output directory " + path.string() + " is a file; choose another one with --output DIR");
  const bool goes_on =
      line.restart && fs::exists(path) && fs::equivalent(path, fs::absolute(*line.restart).parent_path());
  if (goes_on || line.overwrite || line.check)
    return;
  if (const auto results = find_results(path); !results.empty())
    throw FileError("output directory " + path.string() + " holds results already, for example " +
                    results.front().filename().string() +
                    "; choose another one with --output DIR, go on with --restart FILE, or remove them with "
                    "--overwrite");
}

} // namespace

OutputDirectory::OutputDirectory(const Environment &env) : env_(env), path_(env.command_line().output_directory)
{
  on_root(env_.comm(), [&] { with_file_errors(path_, [&] { check(path_, env_.command_line()); }); });
}

void OutputDirectory::prepare() const
{
  if (env_.command_line().check)
    return;
  on_root(env_.comm(), [&] {
    with_file_errors(path_, [&] {
      if (env_.command_line().overwrite)
        for (const auto &file : find_results(path_))
          fs::remove(file);
      fs::create_directories(path_ / frames_folder);
    });
  });
}

fs::path OutputDirectory::frame(int n) const
{
  const auto digits = std::to_string(n);
  return path_ / frames_folder / (std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits + ".vtu");
}

const std::vector<std::string> &result_files()
{
  static const std::vector<std::string> names{"used.yaml",    "history.csv", "tips.csv",  "probes.csv",
                                              "summary.json", "frames.pvd",  "fields.h5", "checkpoint.h5",
                                              "path.csv",     "modes.csv"};
  return names;
}

std::vector<fs::path> find_results(const fs::path &directory)
{
  std::vector<fs::path> results;
  for (const auto &name : result_files())
    if (fs::exists(directory / name))
      results.push_back(directory / name);
  if (fs::is_directory(directory))
    for (const auto &item : fs::directory_iterator(directory))
      if (is_older_checkpoint(item.path()))
        results.push_back(item.path());
  if (fs::is_directory(directory / frames_folder))
    for (const auto &item : fs::directory_iterator(directory / frames_folder))
      if (is_frame(item.path()))
        results.push_back(item.path());
  std::sort(results.begin(), results.end());
  return results;
}

void refuse_restart(const Environment &env)
{
  if (env.command_line().restart)
    throw InvalidParameter("--restart " + *env.command_line().restart +
                           ": this program writes no checkpoints; run it from the start with --output DIR");
}

} // namespace sherd
