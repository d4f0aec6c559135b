// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/assembly/scatter.h>

using namespace sherd;

namespace
{

SpaceDistribution some_space(int n_ranks, int rank)
{
  auto surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  test::refine_at_random(surface, 2, 3, 73);
  SpaceTopology topology;
  topology.n_points = surface.n_control_points();
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto functions = surface.patch(0).basis.functions_of(e);
      topology.points.insert(topology.points.end(), functions.begin(), functions.end());
      topology.offsets.push_back(static_cast<int>(topology.points.size()));
    }
  return distribute(topology, n_ranks, rank);
}

} // namespace

TEST_CASE("Row ranges cover the owned rows without overlap and know all their elements")
{
  const auto space    = some_space(2, GENERATE(0, 1));
  const int  n_ranges = GENERATE(1, 2, 3, 8);
  const auto ranges   = row_ranges(space, n_ranges);
  REQUIRE(static_cast<int>(ranges.size()) == n_ranges);
  int end = 0;
  for (const auto &range : ranges)
    {
      CHECK(range.begin == end);
      end = range.end;
      std::vector<int> expected;
      for (int e = 0; e < static_cast<int>(space.elements.size()); ++e)
        for (int k = space.element_offsets[e]; k < space.element_offsets[e + 1]; ++k)
          if (space.element_points[k] >= range.begin && space.element_points[k] < range.end)
            {
              expected.push_back(e);
              break;
            }
      CHECK(range.elements == expected);

      // About equal work: entries of the rows, to within one row.
      const int work = space.graph.offsets[range.end] - space.graph.offsets[range.begin];
      CHECK(std::abs(work - space.graph.columns.size() / double(n_ranges)) < 60.);
    }
  CHECK(end == static_cast<int>(space.owned.size()));
}

TEST_CASE("More ranges than rows, and no rows at all")
{
  const auto space  = some_space(1, 0);
  const auto ranges = row_ranges(space, 500);
  int        end    = 0;
  for (const auto &range : ranges)
    {
      CHECK(range.begin == end);
      CHECK(range.end >= range.begin);
      CHECK((range.begin < range.end || range.elements.empty()));
      end = range.end;
    }
  CHECK(end == static_cast<int>(space.owned.size()));

  SpaceDistribution empty;
  empty.element_offsets = {0};
  for (const auto &range : row_ranges(empty, 3))
    {
      CHECK(range.begin == 0);
      CHECK(range.end == 0);
      CHECK(range.elements.empty());
    }
  CHECK_NOTHROW(ScatterMap(empty));
}

TEST_CASE("The scatter map points to the column of every pair of an element's control points")
{
  const auto       space = some_space(3, GENERATE(0, 1, 2));
  const ScatterMap map(space);
  for (int e = 0; e < static_cast<int>(space.elements.size()); ++e)
    {
      const std::vector<int> points(space.element_points.begin() + space.element_offsets[e],
                                    space.element_points.begin() + space.element_offsets[e + 1]);
      const auto             positions = map.positions(e);
      REQUIRE(positions.size() == points.size() * points.size());
      for (std::size_t a = 0; a < points.size(); ++a)
        if (points[a] < static_cast<int>(space.owned.size()))
          for (std::size_t b = 0; b < points.size(); ++b)
            CHECK(space.graph.row(points[a])[positions[a * points.size() + b]] == points[b]);
    }
}
