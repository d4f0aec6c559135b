// label: unit
// A rank that fails while others wait for it in a collective call cannot be joined: run() ends the job with its
// status. The test starts itself under mpirun, with SHERD_TEST_CHILD saying what the job should do.
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>

#include <signal.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>

#include <sherd/base/environment.h>
#include <sherd/base/exceptions.h>
#include <sherd/base/stop_request.h>

using namespace sherd;
using Catch::Matchers::Contains;

namespace
{
struct Job
{
  int         status;
  std::string text;
};

/// Runs this program again on three ranks, with nothing of this MPI job in its environment. When it writes
/// "running", mpirun gets @p signal.
Job start(const std::string &child, int signal = 0)
{
  const auto        self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command =
      "env -i PATH=\"$PATH\" HOME=\"$HOME\" LD_LIBRARY_PATH=\"$LD_LIBRARY_PATH\" ASAN_OPTIONS=detect_leaks=0 "
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
      "OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none OMP_NUM_THREADS=1 SHERD_TEST_CHILD=" +
      child + " sh -c \"echo job \\$\\$; exec mpirun -np 3 '" + self +
      "' --filenames-as-tags '[#one_rank_fails]' 2>&1\"";
  Job   job{};
  pid_t pid  = 0;
  auto *pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 256> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe))
    {
      const std::string line = buffer.data();
      if (line.starts_with("job "))
        pid = std::stoi(line.substr(4));
      if (line.find("running") != line.npos && pid > 0)
        kill(pid, signal);
      job.text += line;
    }
  job.status = WEXITSTATUS(pclose(pipe));
  return job;
}

std::size_t count(const std::string &text, const std::string &pattern)
{
  std::size_t n = 0;
  for (auto i = text.find(pattern); i != text.npos; i = text.find(pattern, i + 1))
    ++n;
  return n;
}

ExitStatus execute_child(const std::function<void(const Environment &)> &program)
{
  return execute(MPI_COMM_WORLD, "child", {}, program, {}, std::cout, std::cerr);
}

void wait_for_stop(const Environment &env)
{
  for (int i = 0; i < 2000; ++i)
    {
      if (const auto reason = stop_requested(env))
        throw StoppedEarly("end of step, " + *reason);
      if (i == 0 && env.rank() == 0)
        std::cout << "running" << std::endl;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}
} // namespace

TEST_CASE("execute: failures and signals of a job of three ranks", "[environment]")
{
  if (const char *child = std::getenv("SHERD_TEST_CHILD"))
    {
      auto status = ExitStatus::done;
      if (std::string(child) == "waiting")
        execute_child([](const Environment &env) {
          if (env.rank() == 1)
            throw InvalidParameter("bad value");
          MPI_Barrier(env.comm());
        });
      if (std::string(child) == "together")
        status = execute_child([](const Environment &) { throw NoConvergence("diverged"); });
      if (std::string(child) == "signal")
        status = execute_child(wait_for_stop);
      MPI_Finalize();
      std::_Exit(static_cast<int>(status));
    }

  SECTION("a rank that others wait for ends the job with its status and message")
  {
    const auto job = start("waiting");
    INFO(job.text);
    CHECK(job.status == 2);
    CHECK(count(job.text, "error: bad value (on rank 1;") == 1);
  }

  SECTION("ranks that fail together end in order, with one message")
  {
    const auto job = start("together");
    INFO(job.text);
    CHECK(job.status == 3);
    CHECK(count(job.text, "error: diverged") == 1);
    CHECK(job.text.find("MPI_ABORT") == std::string::npos);
  }

  SECTION("SIGUSR1 to mpirun stops all ranks with status 4")
  {
    const auto job = start("signal", SIGUSR1);
    INFO(job.text);
    CHECK(job.status == 4);
    CHECK(count(job.text, "stopped: end of step, signal SIGUSR1") == 1);
  }
}
