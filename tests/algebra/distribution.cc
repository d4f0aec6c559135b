// label: unit
// ranks: 1 2 3
#include <catch2/catch.hpp>

#include <sherd/algebra/distribution.h>
#include <sherd/base/exceptions.h>

#include "model_system.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Ids dealt out to the ranks in turn, the larger first; every rank sees the first id of the next one.
Distribution dealt(int n)
{
  const int                 rank = rank_of_world(), n_ranks = ranks_of_world();
  std::vector<std::int64_t> owned, ghosts;
  for (int id = n - 1; id >= 0; --id)
    if (id % n_ranks == rank)
      owned.push_back(id);
  if (n_ranks > 1)
    ghosts.push_back((rank + 1) % n_ranks);
  return Distribution(MPI_COMM_WORLD, owned, ghosts);
}

} // namespace

TEST_CASE("Local and global ids lead to each other")
{
  const auto distribution = dealt(20);

  CHECK(distribution.n_global() == 20);
  CHECK(distribution.n_ghosts() == (ranks_of_world() > 1 ? 1 : 0));
  CHECK(distribution.n_local() == distribution.n_owned() + distribution.n_ghosts());
  int n_here = 0;
  for (std::int64_t id = 0; id < 20; ++id)
    if (const int local = distribution.local(id); local >= 0)
      {
        ++n_here;
        CHECK(distribution.global(local) == id);
        CHECK((local < distribution.n_owned()) == (id % ranks_of_world() == rank_of_world()));
      }
  CHECK(n_here == distribution.n_local());
  CHECK(distribution.local(20) == -1);
  CHECK(distribution.local(-1) == -1);
  for (int a = 1; a < distribution.n_owned(); ++a)
    CHECK(distribution.global(a) < distribution.global(a - 1)); // the order given is kept
}

TEST_CASE("A rank may own nothing and still see others' control points")
{
  std::vector<std::int64_t> owned, ghosts;
  if (rank_of_world() == 0)
    owned = {0, 1, 2};
  else
    ghosts = {2};
  const auto distribution = std::make_shared<const Distribution>(MPI_COMM_WORLD, owned, ghosts);
  CHECK(distribution->n_global() == 3);

  Vector x(distribution, 2);
  for (std::size_t i = 0; i < x.owned().size(); ++i)
    x.owned()[i] = static_cast<double>(i);
  x.update_ghosts();
  CHECK(x.local()[x.local().size() - 2] == 4.);
  CHECK(gather(x) == std::vector<double>{0., 1., 2., 3., 4., 5.});
}

TEST_CASE("All ranks refuse ids without exactly one owner")
{
  const bool                first = rank_of_world() == 0;
  std::vector<std::int64_t> none, owned = {0, 1};
  CHECK_THROWS_AS(Distribution(MPI_COMM_WORLD, first ? std::vector<std::int64_t>{0, 0} : none, none), InvalidParameter);
  CHECK_THROWS_AS(Distribution(MPI_COMM_WORLD, first ? std::vector<std::int64_t>{0, 2} : none, none), InvalidParameter);
  CHECK_THROWS_AS(Distribution(MPI_COMM_WORLD, first ? owned : none, {first ? 1 : 0, first ? 1 : 2}), InvalidParameter);
  if (ranks_of_world() > 1)
    {
      CHECK_THROWS_AS(Distribution(MPI_COMM_WORLD, owned, none), InvalidParameter);
      CHECK_THROWS_AS(Distribution(MPI_COMM_WORLD, first ? owned : none, {1}), InvalidParameter);
    }
}
