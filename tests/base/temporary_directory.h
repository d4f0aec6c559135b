#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <mpi.h>

#include <sherd/base/collective.h>

namespace sherd::test
{

/// A new empty folder that all ranks of MPI_COMM_WORLD share; it is removed with the object. Collective.
class TemporaryDirectory
{
public:
  TemporaryDirectory()
  {
    std::string name = (std::filesystem::temp_directory_path() / "sherd-test-XXXXXX").string();
    on_root(MPI_COMM_WORLD, [&] {
      if (!mkdtemp(name.data()))
        throw FileError("cannot make " + name);
    });
    path_ = broadcast(MPI_COMM_WORLD, name);
  }

  ~TemporaryDirectory()
  {
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (rank == 0)
      std::filesystem::remove_all(path_, ignored);
  }

  TemporaryDirectory(const TemporaryDirectory &)            = delete;
  TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

  const std::filesystem::path &path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace sherd::test
