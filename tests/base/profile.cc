// label: unit
// ranks: 1 2 3
#include <chrono>
#include <thread>

#include <catch2/catch.hpp>

#include <sherd/base/profile.h>

using namespace sherd;
using Catch::Matchers::Contains;

namespace
{
void work(int milliseconds)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}
} // namespace

TEST_CASE("Profile: phases and the rest add up to the total", "[profile]")
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);

  const auto  start = std::chrono::steady_clock::now();
  PhaseTimers timers;
  for (int i = 0; i < 3; ++i)
    {
      const auto timing = timers.measure("solve");
      work(1 + rank);
    }
  work(2);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto   profile = make_profile(MPI_COMM_WORLD, timers, seconds, 100);

  CHECK(profile.n_ranks == n_ranks);
  CHECK(profile.n_threads >= 1);
  REQUIRE(profile.phases.size() == 1);
  const auto &solve = profile.phases.at("solve");
  CHECK(solve.calls == 3);
  CHECK(solve.largest >= 3e-3 * n_ranks);
  // Mean of 3 ms, 6 ms, ...
  CHECK(solve.mean >= 3e-3 * (n_ranks + 1) / 2.);
  CHECK(solve.mean <= solve.largest);
  CHECK(profile.other.mean >= 2e-3);
  CHECK(profile.other.mean <= profile.other.largest);
  double mean = seconds;
  MPI_Allreduce(MPI_IN_PLACE, &mean, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  CHECK(solve.mean + profile.other.mean == Approx(mean / n_ranks).epsilon(1e-9));
}

TEST_CASE("Profile: the peak memory grows with what is used, on the rank that uses it", "[profile]")
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const auto before = peak_memory(MPI_COMM_WORLD);
  CHECK(before.sum >= before.largest);
  CHECK(before.sum <= n_ranks * before.largest);
  CHECK(before.largest > 1000000);

  // More than any rank has used so far, every page of it touched.
  std::vector<char> much;
  if (rank == 0)
    much.assign(before.largest + 50000000, 'x');
  const auto after = peak_memory(MPI_COMM_WORLD);
  CHECK(after.largest >= before.largest + 50000000);
  CHECK(after.sum >= before.sum + 50000000);
  CHECK((rank > 0 || much.back() == 'x'));
}

TEST_CASE("Profile: the table shows every phase, the longest first", "[profile]")
{
  Profile profile;
  profile.phases        = {{"assembly", {2., 1., 40}}, {"solve", {6., 6., 7}}};
  profile.other         = {1.5, 1., 0};
  profile.total_seconds = 8.;
  profile.n_ranks       = 2;
  profile.n_threads     = 3;
  profile.memory        = {300000000, 200000000};
  profile.n_unknowns    = 100000;
  CHECK(table(profile) == "phase             largest [s]     mean [s]    share     calls\n"
                          "solve                   6.000        6.000   75.0 %         7\n"
                          "assembly                2.000        1.000   12.5 %        40\n"
                          "other                   1.500        1.000   12.5 %\n"
                          "total                   8.000, ranks: 2, threads of a rank: 3\n"
                          "peak memory of a rank: largest 200.0 MB, mean 150.0 MB; 3000 bytes per unknown (100000 "
                          "unknowns)\n");
  CHECK_THAT(table(Profile{}), Contains("0.0 %"));
}
