// label: unit
#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/base/exceptions.h>
#include <sherd/space/ordering.h>
#include <sherd/space/shell_space.h>
#include <space/shared_out.h>

using namespace sherd;

namespace
{

SpaceTopology topology_of(const Surface<2, 2> &surface)
{
  SpaceTopology topology;
  topology.n_points = surface.n_control_points();
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto [p, local] = surface.locate_element(e);
      for (const int i : surface.patch(p).basis.functions_of(local))
        topology.points.push_back(surface.point(p, i));
      topology.offsets.push_back(static_cast<int>(topology.points.size()));
    }
  return topology;
}

std::vector<int> points_of(const SpaceTopology &topology, int e)
{
  return {topology.points.begin() + topology.offsets[e], topology.points.begin() + topology.offsets[e + 1]};
}

/// Neighbours of every control point by the definition: it shares an element with them.
std::vector<std::set<int>> neighbours(const SpaceTopology &topology)
{
  std::vector<std::set<int>> result(topology.n_points);
  for (std::size_t e = 0; e + 1 < topology.offsets.size(); ++e)
    for (const int a : points_of(topology, static_cast<int>(e)))
      for (const int b : points_of(topology, static_cast<int>(e)))
        result[a].insert(b);
  return result;
}

Surface<2, 2> refined_plate()
{
  auto surface = shapes::plate<2, 2>({1., 1.}, {4, 4});
  test::refine_at_random(surface, 2, 3, 73);
  return surface;
}

} // namespace

TEST_CASE("The ranks share control points and elements out, each once")
{
  const auto surface    = refined_plate();
  const auto topology   = topology_of(surface);
  const int  n_ranks    = GENERATE(1, 2, 3, 7);
  const int  n_elements = surface.n_elements();

  std::vector<int> owners(topology.n_points, 0), element_owners(n_elements, 0);
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      const auto d = distribute(topology, n_ranks, rank);
      for (const auto point : d.owned)
        ++owners[point];
      REQUIRE(d.owns.size() == d.elements.size());
      for (std::size_t k = 0; k < d.elements.size(); ++k)
        {
          CHECK(static_cast<bool>(d.owns[k]) == (d.element_owner[d.elements[k]] == rank));
          element_owners[d.elements[k]] += d.owns[k];
        }
      CHECK(d.element_owner == distribute(topology, n_ranks, 0).element_owner);
    }
  CHECK(std::all_of(owners.begin(), owners.end(), [](int n) { return n == 1; }));
  CHECK(std::all_of(element_owners.begin(), element_owners.end(), [](int n) { return n == 1; }));
}

TEST_CASE("A rank knows all it needs to fill its rows, and no more")
{
  const auto surface  = refined_plate();
  const auto topology = topology_of(surface);
  const auto expected = neighbours(topology);
  const int  n_ranks  = GENERATE(1, 2, 5);
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      const auto          d       = distribute(topology, n_ranks, rank);
      const int           n_owned = static_cast<int>(d.owned.size());
      const std::set<int> owned(d.owned.begin(), d.owned.end());
      std::set<int>       active, needed;
      for (int e = 0; e < surface.n_elements(); ++e)
        {
          const auto points = points_of(topology, e);
          if (std::any_of(points.begin(), points.end(), [&](int i) { return owned.count(i) > 0; }))
            {
              active.insert(e);
              needed.insert(points.begin(), points.end());
            }
        }
      CHECK(std::set<int>(d.elements.begin(), d.elements.end()) == active);
      CHECK(d.elements.size() == active.size());
      CHECK(std::is_sorted(d.ghosts.begin(), d.ghosts.end()));

      // Local numbers: owned, then ghosts.
      std::vector<std::int64_t> ids = d.owned;
      ids.insert(ids.end(), d.ghosts.begin(), d.ghosts.end());
      CHECK(std::set<int>(ids.begin(), ids.end()) == needed);
      CHECK(ids.size() == needed.size());
      for (int i = 0; i < topology.n_points; ++i)
        if (needed.count(i))
          CHECK(ids[d.local[i]] == i);
        else
          CHECK(d.local[i] == -1);

      for (std::size_t k = 0; k < d.elements.size(); ++k)
        {
          std::vector<int> points;
          for (int at = d.element_offsets[k]; at < d.element_offsets[k + 1]; ++at)
            points.push_back(static_cast<int>(ids[d.element_points[at]]));
          CHECK(points == points_of(topology, d.elements[k]));
        }

      REQUIRE(d.graph.n_rows() == n_owned);
      for (int a = 0; a < n_owned; ++a)
        {
          const auto    row = d.graph.row(a);
          std::set<int> columns;
          for (const int b : row)
            columns.insert(static_cast<int>(ids[b]));
          CHECK(std::is_sorted(row.begin(), row.end()));
          CHECK(columns == expected[d.owned[a]]);
          CHECK(row.size() == columns.size());
        }
    }
}

TEST_CASE("Neighbours in space are neighbours in memory")
{
  // A long strip, 40 x 3 elements: columns of five control points, each of which meets two columns to each side. A
  // level of the search is thus two columns, and neighbours lie in the same level or in the next.
  const auto topology = topology_of(shapes::plate<2, 2>({40., 3.}, {40, 3}));
  const auto d        = distribute(topology, 1, 0);
  int        width    = 0;
  for (int a = 0; a < d.graph.n_rows(); ++a)
    for (const int b : d.graph.row(a))
      width = std::max(width, std::abs(a - b));
  CHECK(width < 4 * 5);
  const auto first = [&](std::size_t k) {
    return *std::min_element(d.element_points.begin() + d.element_offsets[k],
                             d.element_points.begin() + d.element_offsets[k + 1]);
  };
  for (std::size_t k = 1; k < d.elements.size(); ++k)
    CHECK(first(k - 1) <= first(k));
}

TEST_CASE("More ranks than control points leave some empty")
{
  const auto topology = topology_of(shapes::plate<2, 2>({1., 1.}, {1, 1}));
  int        n_empty = 0, n_owned = 0;
  for (int rank = 0; rank < 12; ++rank)
    {
      const auto d = distribute(topology, 12, rank);
      n_owned += static_cast<int>(d.owned.size());
      if (d.owned.empty())
        {
          ++n_empty;
          CHECK(d.ghosts.empty());
          CHECK(d.elements.empty());
          CHECK(d.graph.n_rows() == 0);
          CHECK(d.element_offsets == std::vector<int>{0});
        }
      else
        CHECK(d.elements == std::vector<int>{0});
    }
  CHECK(n_owned == 9);
  CHECK(n_empty >= 3);
}

TEST_CASE("Ranks get control points of similar cost, also where the mesh is graded")
{
  // Fine along a diagonal: there elements and rows of the matrix are as many as elsewhere in a far larger area.
  auto surface = shapes::plate<2, 2>({1., 1.}, {16, 16});
  for (const double h : {1. / 32, 1. / 64})
    {
      std::vector<int> marked;
      const auto       X = surface.control_points();
      for (int i = 0; i < X.rows(); ++i)
        if (std::abs(X(i, 0) - X(i, 1)) < .1)
          marked.push_back(i);
      surface.refine(marked, {{h, h}});
    }
  const auto topology = topology_of(surface);
  const int  n_ranks  = GENERATE(2, 3, 5);
  double     elements = 0., blocks = 0., most_elements = 0., most_blocks = 0.;
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      const auto d = distribute(topology, n_ranks, rank);
      elements += static_cast<double>(d.elements.size()) / n_ranks;
      blocks += static_cast<double>(d.graph.columns.size()) / n_ranks;
      most_elements = std::max(most_elements, static_cast<double>(d.elements.size()));
      most_blocks   = std::max(most_blocks, static_cast<double>(d.graph.columns.size()));
    }
  CHECK(most_blocks < 1.03 * blocks);
  // Elements on a border count on both sides, and parts have borders of different length.
  CHECK(most_elements < 1.08 * elements);
}

TEST_CASE("Another rule may share the control points out, as long as it names ranks")
{
  const auto topology = topology_of(refined_plate());
  for (int rank = 0; rank < 4; ++rank)
    {
      const auto d = distribute(topology, 4, rank, test::leaving_out(2));
      CHECK((rank == 2) == d.owned.empty());
      CHECK((rank == 2) == d.elements.empty());
    }
  const auto of = [&](int rank, int surplus) {
    return [=](const SparseGraph &graph, std::span<const int>, int) {
      return std::vector<int>(graph.n_rows() + surplus, rank);
    };
  };
  CHECK(distribute(topology, 2, 1, of(1, 0)).owned.size() == static_cast<std::size_t>(topology.n_points));
  CHECK_THROWS_AS(distribute(topology, 2, 0, of(2, 0)), InvalidParameter);
  CHECK_THROWS_AS(distribute(topology, 2, 0, of(-1, 0)), InvalidParameter);
  CHECK_THROWS_AS(distribute(topology, 2, 0, of(0, 1)), DimensionMismatch);
}

TEST_CASE("The space follows its surface")
{
  const Environment env(MPI_COMM_SELF);
  auto              surface = shapes::plate<2, 3>({1., 1.}, {3, 2});
  ShellSpace<2, 3>  space(env, surface);
  CHECK(space.n_unknowns() == 4 * 5 * 4);
  CHECK(space.n_active_elements() == 6);
  CHECK(space.distribution().ghosts.empty());
  CHECK(&space.surface() == &surface);

  test::refine_everywhere(surface, 1);
  space.rebuild();
  CHECK(space.n_unknowns() == 4 * 8 * 6);
  REQUIRE(space.n_active_elements() == 24);
  const auto &d = space.distribution();
  for (int k = 0; k < 24; ++k)
    {
      std::vector<int> points;
      for (const int a : space.points_of(k))
        points.push_back(static_cast<int>(d.owned[a]));
      const auto expected = surface.patch(0).basis.functions_of(d.elements[k]);
      CHECK(points == std::vector<int>(expected.begin(), expected.end()));
    }
}

TEST_CASE("Patches that share no control point are numbered apart")
{
  auto plate = shapes::plate<2, 2>({1., 1.}, {2, 2}).patch(0);
  auto other = plate;
  other.control_points.col(0).array() += 1.;
  const Surface<2, 2>    surface({plate, other}, {});
  const ShellSpace<2, 2> space(Environment(MPI_COMM_SELF), surface);
  const auto            &d = space.distribution();
  REQUIRE(d.elements.size() == 8);
  for (int k = 0; k < 8; ++k)
    for (const int a : space.points_of(k))
      CHECK((d.owned[a] < 16) == (d.elements[k] < 4));
}
