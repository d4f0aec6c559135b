// label: unit
// ranks: 1 2 3
#include <csignal>

#include <catch2/catch.hpp>

#include <sherd/base/stop_request.h>

using namespace sherd;

namespace
{
volatile std::sig_atomic_t seen = 0;

void note(int signal)
{
  seen = signal;
}
} // namespace

TEST_CASE("stop_requested: nothing without signal and limit", "[stop_request]")
{
  const Environment env(MPI_COMM_WORLD);
  const StopSignals signals;
  CHECK_FALSE(stop_requested(env));
}

TEST_CASE("stop_requested: a signal on the last rank stops all ranks for the same reason", "[stop_request]")
{
  const Environment env(MPI_COMM_WORLD);
  for (const auto &[signal, reason] :
       {std::pair(SIGTERM, "signal SIGTERM"), {SIGINT, "signal SIGINT"}, {SIGUSR1, "signal SIGUSR1"}})
    {
      const StopSignals signals;
      if (env.rank() == env.n_ranks() - 1)
        {
          std::raise(signal);
          CHECK(received_stop_signal() == signal);
        }
      CHECK(stop_requested(env) == reason);
      CHECK(stop_requested(env) == reason); // it stays requested
    }
  CHECK_FALSE(stop_requested(env)); // and ends with the object
}

TEST_CASE("stop_requested: the wall limit holds on every rank", "[stop_request]")
{
  CommandLine line;
  line.max_wall_minutes = 1e-9;
  const Environment env(MPI_COMM_WORLD, line);
  while (env.elapsed_seconds() < 1e-7)
    {
    }
  CHECK(stop_requested(env) == "the limit of 1e-09 minutes (--max-wall)");

  line.max_wall_minutes = 60.;
  CHECK_FALSE(stop_requested(Environment(MPI_COMM_WORLD, line)));
}

TEST_CASE("StopSignals: earlier handlers come back, and a second signal acts as usual", "[stop_request]")
{
  const auto before = std::signal(SIGINT, note);
  {
    const StopSignals signals;
    std::raise(SIGINT);
    CHECK(seen == 0);
  }
  std::raise(SIGINT);
  CHECK(seen == SIGINT);

  {
    const StopSignals signals;
    std::raise(SIGUSR1);
    struct sigaction action;
    sigaction(SIGUSR1, nullptr, &action);
    CHECK(action.sa_handler == SIG_DFL);
  }
  std::signal(SIGINT, before);
}
