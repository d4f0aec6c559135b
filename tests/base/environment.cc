// label: unit
// ranks: 1 2 3
#include <sstream>

#include <catch2/catch.hpp>

#include <sherd/base/collective.h>
#include <sherd/base/environment.h>

using namespace sherd;
using Catch::Matchers::Contains;

namespace
{
struct Outcome
{
  ExitStatus  status;
  std::string out, err;
};

Outcome outcome(const std::function<void(const Environment &)> &program, const std::vector<std::string> &arguments = {},
                const std::function<std::string()> &reference = {})
{
  std::ostringstream out, err;
  const auto         status = execute(MPI_COMM_WORLD, "prog", arguments, program, reference, out, err);
  return {status, out.str(), err.str()};
}

int rank()
{
  int result;
  MPI_Comm_rank(MPI_COMM_WORLD, &result);
  return result;
}

template <class E>
ExitStatus status_of()
{
  return outcome([](const Environment &) { throw E("message"); }).status;
}
} // namespace

TEST_CASE("Environment: knows ranks and command line, and copies refer to the same run", "[environment]")
{
  CommandLine line;
  line.case_file = "case.yaml";
  const Environment env(MPI_COMM_WORLD, line), copy(env);
  CHECK(env.rank() == rank());
  CHECK(env.n_ranks() >= 1);
  CHECK(copy.comm() == MPI_COMM_WORLD);
  CHECK(copy.command_line().case_file == "case.yaml");
  const double seconds = env.elapsed_seconds();
  CHECK(seconds >= 0.);
  CHECK(copy.elapsed_seconds() >= seconds);
}

TEST_CASE("execute: every kind of error has its exit status", "[environment]")
{
  CHECK(outcome([](const Environment &) {}).status == ExitStatus::done);
  CHECK(status_of<InvalidParameter>() == ExitStatus::bad_input);
  CHECK(status_of<FileError>() == ExitStatus::bad_input);
  CHECK(status_of<DimensionMismatch>() == ExitStatus::bad_input);
  CHECK(status_of<NoConvergence>() == ExitStatus::not_converged);
  CHECK(status_of<StoppedEarly>() == ExitStatus::stopped_early);
  CHECK(status_of<Error>() == ExitStatus::unexpected);
  CHECK(status_of<std::logic_error>() == ExitStatus::unexpected);
  CHECK(outcome([](const Environment &) { throw 42; }).status == ExitStatus::unexpected);
  CHECK(static_cast<int>(ExitStatus::bad_input) == 2);
  CHECK(static_cast<int>(ExitStatus::not_converged) == 3);
  CHECK(static_cast<int>(ExitStatus::stopped_early) == 4);
}

TEST_CASE("execute: an error of all ranks is told once, by rank 0", "[environment]")
{
  const auto [status, out, err] =
      outcome([](const Environment &env) { throw InvalidParameter("seen from rank " + std::to_string(env.rank())); });
  CHECK(status == ExitStatus::bad_input);
  CHECK(out.empty());
  CHECK(err == (rank() == 0 ? "error: seen from rank 0\n" : ""));
}

TEST_CASE("execute: a run that stopped early is not called an error", "[environment]")
{
  const auto [status, out, err] = outcome([](const Environment &) { throw StoppedEarly("at step 3"); });
  CHECK(status == ExitStatus::stopped_early);
  CHECK(err == (rank() == 0 ? "stopped: at step 3\n" : ""));
}

TEST_CASE("execute: an error of the last rank alone gives all ranks its status if nobody waits for it", "[environment]")
{
  const auto [status, out, err] = outcome([](const Environment &env) {
    if (env.rank() == env.n_ranks() - 1)
      throw NoConvergence("rank " + std::to_string(env.rank()));
  });
  int n_ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  CHECK(status == ExitStatus::not_converged);
  CHECK(err == (rank() == 0 ? "error: rank " + std::to_string(n_ranks - 1) + "\n" : ""));
}

TEST_CASE("execute: an error made collective passes through as it is", "[environment]")
{
  const auto [status, out, err] = outcome([](const Environment &env) {
    on_root(env.comm(), [] { throw FileError("no such file"); });
    MPI_Barrier(env.comm());
  });
  CHECK(status == ExitStatus::bad_input);
  CHECK(err == (rank() == 0 ? "error: no such file\n" : ""));
}

TEST_CASE("execute: a bad command line never enters the program", "[environment]")
{
  bool       entered = false;
  const auto result  = outcome([&](const Environment &) { entered = true; }, {"--chekc"});
  CHECK_FALSE(entered);
  CHECK(result.status == ExitStatus::bad_input);
  if (rank() == 0)
    CHECK_THAT(result.err, Contains("--chekc") && Contains("is --check;"));
  else
    CHECK(result.err.empty());
}

TEST_CASE("execute: --help prints usage and reference instead of running", "[environment]")
{
  bool       entered = false;
  const auto result  = outcome([&](const Environment &) { entered = true; }, {"--help"}, [] { return "REFERENCE"; });
  CHECK_FALSE(entered);
  CHECK(result.status == ExitStatus::done);
  if (rank() == 0)
    CHECK_THAT(result.out, Contains("usage: prog") && Contains("REFERENCE"));
  else
    CHECK(result.out.empty());
}

TEST_CASE("execute: messages of the program do not meet those of the error protocol", "[environment]")
{
  // A message left unreceived on the program's communicator must not be taken for a report.
  const auto result = outcome([](const Environment &env) {
    MPI_Request request;
    int         stray = 0;
    MPI_Irecv(&stray, 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, env.comm(), &request);
    MPI_Barrier(env.comm());
    MPI_Cancel(&request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    throw DimensionMismatch("sizes");
  });
  CHECK(result.status == ExitStatus::bad_input);
}
