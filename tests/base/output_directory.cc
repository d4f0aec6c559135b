// label: unit
// ranks: 1 2 3
#include <fstream>
#include <set>

#include <base/temporary_directory.h>
#include <catch2/catch.hpp>

#include <sherd/base/output_directory.h>
#include <sherd/base/text_file.h>

using namespace sherd;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace
{
Environment environment(const fs::path &directory, const CommandLine &options = {})
{
  CommandLine line      = options;
  line.output_directory = directory.string();
  return Environment(MPI_COMM_WORLD, line);
}

/// Makes empty files below @p directory on rank 0. Collective.
void fill(const fs::path &directory, const std::vector<std::string> &names)
{
  on_root(MPI_COMM_WORLD, [&] {
    for (const auto &name : names)
      {
        fs::create_directories((directory / name).parent_path());
        std::ofstream(directory / name) << "x";
      }
  });
}

/// Files below @p directory, after all ranks have arrived.
std::set<std::string> files(const fs::path &directory)
{
  MPI_Barrier(MPI_COMM_WORLD);
  std::set<std::string> found;
  for (const auto &item : fs::recursive_directory_iterator(directory))
    if (item.is_regular_file())
      found.insert(fs::relative(item.path(), directory).string());
  MPI_Barrier(MPI_COMM_WORLD);
  return found;
}

const std::vector<std::string> foreign{"notes.txt",       "checkpoint.old.h5", "frames/picture.png",
                                       "frames/mesh.vtu", "figures/a.png",     "my_history.csv"};
const std::vector<std::string> results{"history.csv",       "used.yaml",          "checkpoint.h5",  "frames.pvd",
                                       "frames/000000.vtu", "frames/1234567.vtu", "checkpoint.1.h5"};
} // namespace

TEST_CASE("OutputDirectory: a new folder is made by prepare, not before", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  const auto                     path = temporary.path() / "a" / "b";
  const OutputDirectory          directory(environment(path));
  CHECK_FALSE(fs::exists(path));
  MPI_Barrier(MPI_COMM_WORLD);
  directory.prepare();
  CHECK(fs::is_directory(path / "frames"));
  CHECK(directory.file("history.csv") == path / "history.csv");
  CHECK(directory.frame(42) == path / "frames" / "000042.vtu");
  CHECK(directory.frame(1234567) == path / "frames" / "1234567.vtu");
}

TEST_CASE("OutputDirectory: earlier results are refused on every rank and stay as they are", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  for (const auto &name : results)
    {
      const auto path = temporary.path() / name.substr(name.find('/') + 1);
      fill(path, {name});
      INFO(name);
      CHECK_THROWS_AS(OutputDirectory(environment(path)), FileError);
      CHECK_THROWS_WITH(OutputDirectory(environment(path)), Contains("--overwrite") && Contains("--restart"));
      CHECK(files(path) == std::set<std::string>{name});
    }
}

TEST_CASE("OutputDirectory: files that are no results do not matter and survive --overwrite", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  const auto                     path = temporary.path();
  fill(path, foreign);
  CHECK_NOTHROW(OutputDirectory(environment(path)));

  fill(path, results);
  CommandLine line;
  line.overwrite = true;
  const OutputDirectory directory(environment(path, line));
  CHECK(files(path).size() == foreign.size() + results.size());
  directory.prepare();
  CHECK(files(path) == std::set<std::string>(foreign.begin(), foreign.end()));
  CHECK_NOTHROW(OutputDirectory(environment(path)));
}

TEST_CASE("OutputDirectory: --restart keeps all, but its checkpoint has to exist", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  const auto                     path = temporary.path();
  fill(path, results);
  CommandLine line;
  line.restart = (path / "checkpoint.h5").string();
  OutputDirectory(environment(path, line)).prepare();
  CHECK(files(path).size() == results.size());

  line.restart = (path / "missing.h5").string();
  CHECK_THROWS_AS(OutputDirectory(environment(path, line)), FileError);
  CHECK_THROWS_WITH(OutputDirectory(environment(path, line)), Contains("missing.h5"));
}

TEST_CASE("OutputDirectory: --restart into a folder with the results of another run is refused", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  const auto                     old = temporary.path() / "old", other = temporary.path() / "other";
  fill(old, results);
  CommandLine line;
  line.restart = (old / "checkpoint.h5").string();
  CHECK_NOTHROW(OutputDirectory(environment(other, line)));
  fill(other, {"history.csv"});
  CHECK_THROWS_AS(OutputDirectory(environment(other, line)), FileError);
  CHECK_THROWS_WITH(OutputDirectory(environment(other, line)), Contains("other"));
}

TEST_CASE("OutputDirectory: --check touches nothing", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  CommandLine                    line;
  line.check      = true;
  const auto path = temporary.path() / "new";
  OutputDirectory(environment(path, line)).prepare();
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("OutputDirectory: a file in the place of a folder is an error", "[output_directory]")
{
  const test::TemporaryDirectory temporary;
  fill(temporary.path(), {"file"});
  CHECK_THROWS_AS(OutputDirectory(environment(temporary.path() / "file")), FileError);
  CHECK_THROWS_AS(OutputDirectory(environment(temporary.path() / "file" / "below")).prepare(), FileError);
}

TEST_CASE("Text files: what is written is read on every rank", "[text_file]")
{
  const test::TemporaryDirectory temporary;
  const Environment              env(MPI_COMM_WORLD);
  const auto                     file = temporary.path() / "text";
  for (const std::string text : {"first\nsecond", ""})
    {
      write_text(env, file, text);
      CHECK(read_text(env, file) == text);
    }
  CHECK_THROWS_AS(read_text(env, temporary.path() / "missing"), FileError);
  CHECK_THROWS_WITH(read_text(env, temporary.path() / "missing"), Contains("No such file"));
  CHECK_THROWS_AS(read_text(env, temporary.path()), FileError);
  CHECK_THROWS_AS(write_text(env, temporary.path() / "no" / "folder", "x"), FileError);
}
