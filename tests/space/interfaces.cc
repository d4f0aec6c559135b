// label: unit
#include <set>

#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>
#include <sherd/base/exceptions.h>
#include <sherd/space/shell_space.h>
#include <space/shared_out.h>

using namespace sherd;

namespace
{

Surface<2, 3> sample(unsigned seed)
{
  std::mt19937  random(seed);
  const auto    patches = test::star<2, 3>(3 + seed % 3, 3, random);
  Surface<2, 3> surface(patches, {}, find_interfaces(patches));
  for (int level = 1; level < 3; ++level)
    surface.refine_to({static_cast<int>(random() % surface.n_control_points()),
                       static_cast<int>(random() % surface.n_control_points())},
                      test::halved(surface, level));
  return surface;
}

std::set<int> points_of(const SpaceTopology &topology, int cell)
{
  return {topology.points.begin() + topology.offsets[cell], topology.points.begin() + topology.offsets[cell + 1]};
}

} // namespace

TEST_CASE("Pieces of interfaces couple the elements of both sides")
{
  const auto        surface = sample(1);
  const Environment env(MPI_COMM_SELF);
  SECTION("without continuity there are none")
  {
    const ShellSpace<2, 3> space(env, surface, continuity::None());
    CHECK(space.interface_pieces().empty());
    CHECK(space.n_active_interfaces() == 0);
    CHECK(space.n_points() == surface.n_control_points());
    CHECK(space.n_unknowns() == 4 * surface.n_control_points());
  }
  SECTION("by penalty or multiplier")
  {
    const bool             multiplier = GENERATE(false, true);
    const ShellSpace<2, 3> space(
        env, surface, multiplier ? Continuity(continuity::LagrangeMultiplier()) : Continuity(continuity::Penalty()));
    const auto pieces   = interface_pieces(surface);
    const int  n_pieces = static_cast<int>(pieces.size());
    REQUIRE(n_pieces >= 4 * 3);
    REQUIRE(space.n_active_interfaces() == n_pieces);
    CHECK(space.n_multipliers() == (multiplier ? n_pieces : 0));
    CHECK(space.n_points() == surface.n_control_points() + space.n_multipliers());
    CHECK(space.n_unknowns() == 4 * surface.n_control_points() + 2 * space.n_multipliers());
    const auto &d = space.distribution();
    for (int k = 0; k < n_pieces; ++k)
      {
        const auto       geometry = interface_geometry(surface, space.interface_pieces()[d.interfaces[k]]);
        std::vector<int> expected = geometry.sides[0].points;
        expected.insert(expected.end(), geometry.sides[1].points.begin(), geometry.sides[1].points.end());
        if (multiplier)
          expected.push_back(surface.n_control_points() + d.interfaces[k]);
        std::vector<int> points;
        for (const int a : space.points_of_interface(k))
          points.push_back(static_cast<int>(d.owned[a]));
        CHECK(points == expected);
      }
  }
}

TEST_CASE("Ranks share points, elements and pieces out, each once, and know all that they need")
{
  const auto surface = sample(GENERATE(2u, 3u, 4u));
  const bool penalty = GENERATE(false, true);
  const auto topology =
      ShellSpace<2, 3>(Environment(MPI_COMM_SELF), surface,
                       penalty ? Continuity(continuity::Penalty()) : Continuity(continuity::LagrangeMultiplier()))
          .topology();
  const int  n_ranks = GENERATE(1, 2, 3, 5);
  const bool idle    = n_ranks == 3;

  std::vector<std::set<int>> neighbours(topology.n_points);
  for (int cell = 0; cell < topology.n_cells(); ++cell)
    for (const int a : points_of(topology, cell))
      neighbours[a].merge(points_of(topology, cell));

  std::vector<int> owners(topology.n_points, 0), owners_of_pieces(topology.n_interfaces, 0),
      owners_of_elements(topology.n_elements(), 0);
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      const auto d = distribute(topology, n_ranks, rank, idle ? Partitioner(test::leaving_out(1)) : partition);
      std::vector<std::int64_t> ids = d.owned;
      ids.insert(ids.end(), d.ghosts.begin(), d.ghosts.end());
      const std::set<int> owned(d.owned.begin(), d.owned.end());
      std::set<int>       needed;
      for (const auto point : d.owned)
        ++owners[point];
      for (std::size_t k = 0; k < d.elements.size(); ++k)
        owners_of_elements[d.elements[k]] += d.owns[k];

      std::set<int> active;
      for (int k = 0; k < topology.n_interfaces; ++k)
        {
          const auto points = points_of(topology, topology.n_elements() + k);
          if (std::any_of(points.begin(), points.end(), [&](int i) { return owned.count(i) > 0; }))
            active.insert(k);
        }
      CHECK(std::set<int>(d.interfaces.begin(), d.interfaces.end()) == active);
      REQUIRE(d.interfaces.size() == active.size());
      for (std::size_t k = 0; k < d.interfaces.size(); ++k)
        {
          owners_of_pieces[d.interfaces[k]] += d.owns_interface[k];
          std::vector<int> points;
          for (int at = d.interface_offsets[k]; at < d.interface_offsets[k + 1]; ++at)
            {
              REQUIRE(d.interface_points[at] >= 0);
              points.push_back(static_cast<int>(ids[d.interface_points[at]]));
            }
          const int cell = topology.n_elements() + d.interfaces[k];
          CHECK(points == std::vector<int>(topology.points.begin() + topology.offsets[cell],
                                           topology.points.begin() + topology.offsets[cell + 1]));
        }

      REQUIRE(d.graph.n_rows() == static_cast<int>(d.owned.size()));
      for (std::size_t a = 0; a < d.owned.size(); ++a)
        {
          const auto    row = d.graph.row(static_cast<int>(a));
          std::set<int> columns;
          for (const int b : row)
            columns.insert(static_cast<int>(ids[b]));
          CHECK(std::is_sorted(row.begin(), row.end()));
          CHECK(columns == neighbours[d.owned[a]]);

          // A multiplier stands behind its control points, of which there are some here.
          if (d.owned[a] >= topology.n_control_points())
            {
              int n_before = 0;
              for (const int b : row)
                if (b < static_cast<int>(d.owned.size()) && b != static_cast<int>(a))
                  {
                    CHECK(b < static_cast<int>(a));
                    ++n_before;
                  }
              CHECK(n_before >= 1);
              CHECK(n_before >= static_cast<int>(row.size() - 1) / n_ranks);
            }
        }
    }
  const auto once = [](int n) { return n == 1; };
  CHECK(std::all_of(owners.begin(), owners.end(), once));
  CHECK(std::all_of(owners_of_elements.begin(), owners_of_elements.end(), once));
  CHECK(std::all_of(owners_of_pieces.begin(), owners_of_pieces.end(), once));
}
