// label: unit
// ranks: 1 2 3
#include <chrono>
#include <numeric>
#include <thread>

#include <catch2/catch.hpp>

#include <sherd/base/timers.h>

using namespace sherd;

namespace
{
double work(int milliseconds)
{
  const auto start = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double total(const std::map<std::string, double> &seconds)
{
  return std::accumulate(seconds.begin(), seconds.end(), 0., [](double sum, const auto &s) { return sum + s.second; });
}
} // namespace

TEST_CASE("PhaseTimers: repeated phases add up", "[timers]")
{
  PhaseTimers timers;
  double      least = 0.;
  for (int i = 0; i < 3; ++i)
    {
      const auto timing = timers.measure("solve");
      least += work(2);
    }
  work(5);
  // The clock of the test runs inside that of the phase; how far outside, only the load of the machine limits.
  CHECK(timers.seconds().at("solve") >= least);
  CHECK(timers.seconds().size() == 1);
}

TEST_CASE("PhaseTimers: an inner phase stops the clock of the outer one", "[timers]")
{
  PhaseTimers timers;
  const auto  start = std::chrono::steady_clock::now();
  double      outer, inner;
  {
    const auto a = timers.measure("solve");
    outer        = work(3);
    {
      const auto b = timers.measure("assembly");
      inner        = work(20);
      const auto c = timers.measure("assembly");
      inner += work(5);
    }
    outer += work(3);
  }
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CHECK(timers.seconds().at("assembly") >= inner);
  CHECK(timers.seconds().at("solve") >= outer);
  CHECK(total(timers.seconds()) <= whole);
}

TEST_CASE("PhaseTimers: a phase ends when an exception leaves it", "[timers]")
{
  PhaseTimers timers;
  CHECK_THROWS_AS(
      [&] {
        const auto timing = timers.measure("solve");
        throw 1;
      }(),
      int);
  const double seconds = timers.seconds().at("solve");
  {
    const auto timing = timers.measure("output");
    work(2);
  }
  CHECK(timers.seconds().at("solve") == seconds);
}

TEST_CASE("PhaseTimers: the maximum holds every phase of every rank", "[timers]")
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);

  PhaseTimers timers;
  {
    const auto all  = timers.measure("all");
    const auto mine = timers.measure("only rank " + std::to_string(rank));
    work(1 + rank);
  }
  const auto maximum = timers.maximum(MPI_COMM_WORLD);
  REQUIRE(maximum.size() == static_cast<std::size_t>(n_ranks + 1));
  CHECK(maximum.at("all") >= timers.seconds().at("all"));
  for (int r = 0; r < n_ranks; ++r)
    CHECK(maximum.at("only rank " + std::to_string(r)) >= 1e-3 * (1 + r));
  CHECK(maximum.at("only rank " + std::to_string(rank)) == timers.seconds().at("only rank " + std::to_string(rank)));

  const double mine  = total(maximum);
  double       least = mine, most = mine;
  MPI_Allreduce(&mine, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  CHECK(least == most);
}
