// label: unit
// ranks: 1 2 3
#include <map>

#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/space/supports.h>

using namespace sherd;

namespace
{

Supports corner_supports()
{
  Supports supports;
  supports.fix("bottom", Component::y);
  supports.prescribe("left", Component::x, [](double t) { return 2. * t; });
  supports.prescribe("bottom", Component::x, [](double t) { return -t; });
  return supports;
}

} // namespace

TEST_CASE("Supports are kept in the order of their declaration")
{
  const auto supports = corner_supports();
  REQUIRE(supports.list().size() == 3);
  CHECK(supports.list()[0].edge == "bottom");
  CHECK(supports.list()[0].component == Component::y);
  CHECK(supports.list()[0].displacement(3.) == 0.);
  CHECK(supports.list()[1].displacement(3.) == 6.);
  CHECK(supports.list()[2].displacement(3.) == -3.);
}

TEST_CASE("Every supported unknown of a rank is listed once, and the last declaration holds")
{
  const Environment env(MPI_COMM_WORLD);
  auto              surface = shapes::plate<2, 2>({1., 1.}, {4, 4});
  test::refine_at_random(surface, 2, 3, 73);
  const ShellSpace<2, 2> space(env, surface);
  const auto             supports = corner_supports();
  const auto            &d        = space.distribution();

  // By position: the control points of a straight edge lie on it.
  std::map<std::pair<int, int>, int> expected;
  const auto                         X = surface.control_points();
  for (int i = 0; i < surface.n_control_points(); ++i)
    if (d.local[i] >= 0)
      {
        if (X(i, 0) == 0.)
          expected[{d.local[i], 0}] = 1;
        if (X(i, 1) == 0.)
          {
            expected[{d.local[i], 1}] = 0;
            expected[{d.local[i], 0}] = 2;
          }
      }
  std::map<std::pair<int, int>, int> found;
  for (const auto &c : constraints(supports, space))
    {
      CHECK(found.count({c.point, c.component}) == 0);
      found[{c.point, c.component}] = c.support;
    }
  CHECK(found == expected);

  int own = 0;
  for (const auto &[unknown, support] : found)
    own += unknown.first < static_cast<int>(d.owned.size()) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_INT, MPI_SUM, env.comm());
  const auto n_bottom = points_along(surface, surface.edge("bottom").front()).size();
  const auto n_left   = points_along(surface, surface.edge("left").front()).size();
  CHECK(own == static_cast<int>(2 * n_bottom + n_left - 1));
}

TEST_CASE("Supports follow refinement")
{
  auto             surface = shapes::plate<2, 2>({1., 1.}, {2, 2});
  ShellSpace<2, 2> space(Environment(MPI_COMM_SELF), surface);
  Supports         supports;
  supports.fix("right", Component::y);
  CHECK(constraints(supports, space).size() == 4);
  test::refine_everywhere(surface, 1);
  space.rebuild();
  CHECK(constraints(supports, space).size() == 6);
}

TEST_CASE("Supports that cannot be are refused")
{
  const auto             surface = shapes::plate<2, 2>({1., 1.}, {2, 2});
  const ShellSpace<2, 2> space(Environment(MPI_COMM_SELF), surface);
  Supports               supports;
  SECTION("an unknown edge")
  {
    supports.fix("rim", Component::x);
    CHECK_THROWS_AS(constraints(supports, space), InvalidParameter);
    CHECK_THROWS_WITH(constraints(supports, space), Catch::Contains("rim") && Catch::Contains("left"));
  }
  SECTION("a component that the plane does not have")
  {
    supports.fix("left", Component::z);
    CHECK_THROWS_AS(constraints(supports, space), InvalidParameter);
    CHECK_THROWS_WITH(constraints(supports, space), Catch::Contains("left"));
  }
}
