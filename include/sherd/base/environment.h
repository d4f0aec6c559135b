#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>

#include <mpi.h>

#include <sherd/base/command_line.h>

/// The world a program runs in: its ranks, its command line, its exit status.
namespace sherd
{

/// Starts MPI (MPI_THREAD_FUNNELED) and the linear algebra on construction, ends both on destruction. One a process,
/// the first object of main(). run() makes its own; only programs that do not use run() need it.
class MpiSession
{
public:
  /// @throws std::runtime_error  if MPI does not offer MPI_THREAD_FUNNELED.
  MpiSession(int &argc, char **&argv);
  ~MpiSession();

  MpiSession(const MpiSession &)            = delete;
  MpiSession &operator=(const MpiSession &) = delete;
};

/// Ranks and command line of a run. A handle: cheap to copy, safe to keep while the MpiSession lives.
class Environment
{
public:
  /// @param comm  used as it is, not duplicated; stays with its owner.
  explicit Environment(MPI_Comm comm, CommandLine command_line = {});

  MPI_Comm comm() const { return comm_; }
  int      rank() const { return rank_; }
  int      n_ranks() const { return n_ranks_; }

  const CommandLine &command_line() const { return command_line_; }

  /// Wall seconds since this environment, or the one it was copied from, was made.
  double elapsed_seconds() const;

private:
  MPI_Comm                              comm_;
  int                                   rank_, n_ranks_;
  CommandLine                           command_line_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Exit status of a program. An exception that is no Error is `unexpected`.
enum class ExitStatus
{
  done          = 0,
  unexpected    = 1,
  bad_input     = 2, ///< InvalidParameter, FileError, DimensionMismatch
  not_converged = 3, ///< NoConvergence
  stopped_early = 4  ///< StoppedEarly
};

/// Runs @p program on every rank of MPI_COMM_WORLD and returns the exit status, the same on every rank. Call it once,
/// from main().
///
/// With --help, @p program is not entered; rank 0 prints the usage and what @p parameter_reference returns.
/// SIGTERM, SIGINT and SIGUSR1 become requests to stop while @p program runs (base/stop_request.h).
///
/// Errors. Every rank, whether @p program returned or threw, reports to the others on a communicator of its own. If
/// all of them arrive, the message of the lowest rank that failed is printed once, by rank 0, as "error: ..." (or
/// "stopped: ..." for StoppedEarly), and its status is everybody's. A rank that failed waits three seconds for the
/// others. If one of them does not come, it is most likely in a collective call that the failed rank will never join;
/// the failed rank then prints its message and ends the job by MPI_Abort with its status, so that nothing hangs. What
/// can fail on a single rank should therefore go through collectively() or on_root() (base/collective.h), which make
/// all ranks throw the same error.
int run(int argc, char **argv, const std::function<void(const Environment &)> &program,
        const std::function<std::string()> &parameter_reference = {});

/// What run() does, inside an MPI session that exists already: for tests and for programs that embed the library.
/// Collective over @p comm. @p arguments are those behind the program's @p name; rank 0 writes the text of --help to
/// @p out and the message of an error to @p err.
ExitStatus execute(MPI_Comm comm, const std::string &name, std::span<const std::string> arguments,
                   const std::function<void(const Environment &)> &program,
                   const std::function<std::string()> &parameter_reference, std::ostream &out, std::ostream &err);

} // namespace sherd
