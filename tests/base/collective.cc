// label: unit
// ranks: 1 2 3
#include <catch2/catch.hpp>

#include <sherd/base/collective.h>

using namespace sherd;

namespace
{
int rank()
{
  int result;
  MPI_Comm_rank(MPI_COMM_WORLD, &result);
  return result;
}

int n_ranks()
{
  int result;
  MPI_Comm_size(MPI_COMM_WORLD, &result);
  return result;
}

template <class E>
void check_one_rank_throws(int thrower)
{
  const auto task = [&] {
    if (rank() == thrower)
      throw E("from rank " + std::to_string(thrower));
  };
  CHECK_THROWS_AS(collectively(MPI_COMM_WORLD, task), E);
  CHECK_THROWS_WITH(collectively(MPI_COMM_WORLD, task), "from rank " + std::to_string(thrower));
}
} // namespace

TEST_CASE("collectively: the error of any one rank reaches all, type and message", "[collective]")
{
  for (int thrower = 0; thrower < n_ranks(); ++thrower)
    {
      check_one_rank_throws<InvalidParameter>(thrower);
      check_one_rank_throws<FileError>(thrower);
      check_one_rank_throws<DimensionMismatch>(thrower);
      check_one_rank_throws<NoConvergence>(thrower);
      check_one_rank_throws<StoppedEarly>(thrower);
      check_one_rank_throws<Error>(thrower);
      check_one_rank_throws<std::runtime_error>(thrower);
    }
}

TEST_CASE("collectively: of several errors that of the lowest rank is thrown everywhere", "[collective]")
{
  const auto task = [] {
    if (rank() == n_ranks() - 1)
      throw FileError("last");
    if (rank() > 0)
      throw NoConvergence("middle");
  };
  if (n_ranks() == 2)
    CHECK_THROWS_AS(collectively(MPI_COMM_WORLD, task), FileError);
  if (n_ranks() == 3)
    CHECK_THROWS_AS(collectively(MPI_COMM_WORLD, task), NoConvergence);
}

TEST_CASE("collectively: without errors every rank gets its own result", "[collective]")
{
  CHECK(collectively(MPI_COMM_WORLD, [] { return 10 * rank(); }) == 10 * rank());
  CHECK_NOTHROW(collectively(MPI_COMM_WORLD, [] {}));
}

TEST_CASE("on_root: runs once and shares the failure", "[collective]")
{
  int calls = 0;
  on_root(MPI_COMM_WORLD, [&] { ++calls; });
  CHECK(calls == (rank() == 0 ? 1 : 0));
  CHECK_THROWS_AS(on_root(MPI_COMM_WORLD, [] { throw FileError("no disk"); }), FileError);
}

TEST_CASE("broadcast: the text of the root arrives, also if it is empty", "[collective]")
{
  for (int root = 0; root < n_ranks(); ++root)
    for (const std::string text : {"", "a\nb", "\0\xff"})
      CHECK(broadcast(MPI_COMM_WORLD, rank() == root ? text : "something else", root) == text);
}
