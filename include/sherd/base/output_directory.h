#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sherd/base/environment.h>

/// The place where a run leaves its results.
namespace sherd
{

/// The folder of --output. Making the object only looks; prepare() is the first to change something, so a program
/// makes it early, validates all of its input, and calls prepare() before it writes.
class OutputDirectory
{
public:
  /// Refuses a folder that holds results unless --overwrite or --restart with a checkpoint in it is given. Collective.
  /// @throws FileError  on every rank: if it holds results, is no folder, or the file of --restart does not exist.
  explicit OutputDirectory(const Environment &env);

  /// Creates the folder, with those above it; with --overwrite removes the results in it (result_files(), and the
  /// numbered files in frames/) and nothing else. Collective; does nothing with --check.
  /// @throws FileError  on every rank, if that fails.
  void prepare() const;

  const std::filesystem::path &path() const { return path_; }
  std::filesystem::path        file(const std::string &name) const { return path_ / name; }

  /// Path of frame @p n, frames/NNNNNN.vtu; the folder frames/ is there after prepare().
  std::filesystem::path frame(int n) const;

private:
  Environment           env_;
  std::filesystem::path path_;
};

/// For programs that write no checkpoint. @throws InvalidParameter  if --restart was given, on every rank
void refuse_restart(const Environment &env);

/// Names of the files a run may write into its folder, beside the frames and older checkpoints (checkpoint.N.h5).
const std::vector<std::string> &result_files();

/// What @p directory holds of earlier runs: result files and frames, sorted. Empty if there is no such directory.
std::vector<std::filesystem::path> find_results(const std::filesystem::path &directory);

} // namespace sherd
