#include <sherd/base/environment.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <vector>

#include <Tpetra_Core.hpp>

#include <sherd/base/collective.h>
#include <sherd/base/stop_request.h>
#include <sherd/base/threads.h>

namespace sherd
{

MpiSession::MpiSession(int &argc, char **&argv)
{
  int provided;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED)
    throw std::runtime_error("this MPI library does not support threads (MPI_THREAD_FUNNELED)");

  set_threads_of_rank(MPI_COMM_WORLD);

  // Kokkos would answer --help and other options that belong to the program, so it sees the name only.
  int    n_arguments = argc > 0 ? 1 : 0;
  char  *arguments[] = {argc > 0 ? argv[0] : nullptr, nullptr};
  char **handle      = arguments;
  Tpetra::initialize(&n_arguments, &handle);
}

MpiSession::~MpiSession()
{
  Tpetra::finalize();
  MPI_Finalize();
}

Environment::Environment(MPI_Comm comm, CommandLine command_line) : comm_(comm), command_line_(std::move(command_line))
{
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &n_ranks_);
}

double Environment::elapsed_seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

namespace
{

ExitStatus exit_status(ErrorKind kind)
{
  switch (kind)
    {
    case ErrorKind::none:
      return ExitStatus::done;
    case ErrorKind::invalid_parameter:
    case ErrorKind::file_error:
    case ErrorKind::dimension_mismatch:
      return ExitStatus::bad_input;
    case ErrorKind::no_convergence:
      return ExitStatus::not_converged;
    case ErrorKind::stopped_early:
      return ExitStatus::stopped_early;
    case ErrorKind::unexpected:
    case ErrorKind::error:
      break;
    }
  return ExitStatus::unexpected;
}

std::string heading(ErrorKind kind)
{
  return kind == ErrorKind::stopped_early ? "stopped: " : "error: ";
}

/// True if all ranks of @p comm call this, false if @p patience ends first.
bool all_arrive(MPI_Comm comm, std::chrono::duration<double> patience)
{
  MPI_Request request;
  MPI_Ibarrier(comm, &request);
  const auto start = std::chrono::steady_clock::now();
  for (int arrived = 0;;)
    {
      MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
      if (arrived)
        return true;
      if (std::chrono::steady_clock::now() - start > patience)
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

/// The failure of the whole job, the same on every rank; does not return if a rank failed that others wait for.
Failure agree_or_abort(MPI_Comm comm, const Failure &local, std::ostream &err)
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  if (local.kind == ErrorKind::none)
    {
      MPI_Request request;
      MPI_Ibarrier(comm, &request);
      MPI_Wait(&request, MPI_STATUS_IGNORE);
    }
  // Ranks that fail together lose patience one after the other, so that one of them speaks for all.
  else if (!all_arrive(comm, std::chrono::duration<double>(3. + 0.2 * rank)))
    {
      err << heading(local.kind) << local.message << " (on rank " << rank << "; others did not follow)" << std::endl;
      MPI_Abort(comm, static_cast<int>(exit_status(local.kind)));
    }
  return agree(comm, local);
}

Failure attempt(const std::function<void()> &task)
{
  try
    {
      task();
    }
  catch (...)
    {
      return describe(std::current_exception());
    }
  return {};
}

} // namespace

ExitStatus execute(MPI_Comm comm, const std::string &name, std::span<const std::string> arguments,
                   const std::function<void(const Environment &)> &program,
                   const std::function<std::string()> &parameter_reference, std::ostream &out, std::ostream &err)
{
  MPI_Comm world, reports;
  MPI_Comm_dup(comm, &world);
  MPI_Comm_dup(comm, &reports);
  int rank;
  MPI_Comm_rank(comm, &rank);

  const auto local = attempt([&] {
    const Environment env(world, parse_command_line(name, arguments));
    if (env.command_line().help)
      {
        if (rank == 0)
          out << usage(name) << (parameter_reference ? parameter_reference() : "") << std::flush;
        return;
      }
    const StopSignals signals;
    program(env);
  });

  out << std::flush;
  const auto failure = agree_or_abort(reports, local, err);
  if (failure.kind != ErrorKind::none && rank == 0)
    err << heading(failure.kind) << failure.message << std::endl;
  MPI_Comm_free(&reports);
  MPI_Comm_free(&world);
  return exit_status(failure.kind);
}

int run(int argc, char **argv, const std::function<void(const Environment &)> &program,
        const std::function<std::string()> &parameter_reference)
{
  const MpiSession               session(argc, argv);
  const auto                     name = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "PROGRAM";
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  return static_cast<int>(execute(MPI_COMM_WORLD, name, arguments, program, parameter_reference, std::cout, std::cerr));
}

} // namespace sherd
