// label: unit
// ranks: 1 2 3
#include <map>
#include <tuple>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/edge_geometry.h>
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
  CHECK(describe(supports.list()[0].region) == "edge \"bottom\"");
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

TEST_CASE("Corners, patches and the whole surface")
{
  auto surface = shapes::plate<2, 3>({2., 1.}, {4, 3});
  test::refine_at_random(surface, 2, 3, 31);
  auto upper = shapes::plate<2, 3>({2., 1.}, {2, 2}).patch(0);
  upper.control_points.col(1).array() += 1.;
  const Surface<2, 3> both({surface.patch(0), upper}, {{"left", {{0, Side::u_min}, {1, Side::u_min}}},
                                                       {"right", {{0, Side::u_max}, {1, Side::u_max}}},
                                                       {"bottom", {{0, Side::v_min}}},
                                                       {"top", {{1, Side::v_max}}}});
  const auto          X = both.control_points();

  SECTION("a corner is the control point there")
  {
    for (const auto &[corner, x, y] :
         {std::tuple(Corner{"left", "bottom"}, 0., 0.), std::tuple(Corner{"bottom", "right"}, 2., 0.),
          std::tuple(Corner{"right", "top"}, 2., 2.)})
      {
        const auto points = points_of(corner, both);
        REQUIRE(points.size() == 1);
        CHECK(X(points[0], 0) == x);
        CHECK(X(points[0], 1) == y);
      }
  }
  SECTION("a patch and the whole surface")
  {
    const auto points = points_of(PatchRegion{1}, both);
    REQUIRE(points.size() == 16);
    for (const int i : points)
      CHECK(both.locate_point(i).patch == 1);
    CHECK(static_cast<int>(points_of(WholeSurface{}, both).size()) == both.n_control_points());
  }
  SECTION("the last one declared holds the unknown")
  {
    Supports supports;
    supports.fix(WholeSurface{}, Component::z);
    supports.fix(Corner{"left", "bottom"});
    supports.prescribe(PatchRegion{1}, Component::z, [](double t) { return t; });
    const auto holder = holders(supports, both);
    const int  corner = points_of(Corner{"left", "bottom"}, both).front();
    for (int i = 0; i < both.n_control_points(); ++i)
      {
        CHECK(holder[3 * i] == (i == corner ? 1 : -1));
        CHECK(holder[3 * i + 1] == (i == corner ? 1 : -1));
        CHECK(holder[3 * i + 2] == (both.locate_point(i).patch == 1 ? 2 : i == corner ? 1 : 0));
      }
  }
}

TEST_CASE("A clamped edge holds both outer rows, and may move")
{
  const auto surface = shapes::plate<3, 3>({1., 1.}, {4, 4});
  Supports   supports;
  supports.clamp("left");
  supports.prescribe_clamped("left", Component::z, [](double t) { return 3. * t; });
  const auto holder = holders(supports, surface);
  for (int i = 0; i < surface.n_control_points(); ++i)
    {
      const bool outer = i % 7 < 2; // seven functions along u
      CHECK(holder[3 * i] == (outer ? 0 : -1));
      CHECK(holder[3 * i + 1] == (outer ? 0 : -1));
      CHECK(holder[3 * i + 2] == (outer ? 1 : -1));
    }
  CHECK(supports.list()[1].displacement(2.) == 6.);
}

TEST_CASE("Position and tangent plane stay along a clamped edge, whatever the rest does")
{
  const std::string edge    = GENERATE("inner", "outer", "start", "end");
  auto              surface = test::quarter_turn<2, 3>(1., 0., 1.5, 2.);
  for (const int level : {1, 2})
    test::refine_everywhere(surface, level);
  std::mt19937 random(19);
  for (int level = 3; level < 5; ++level)
    {
      const auto first = points_along(surface, surface.edge(edge).front());
      const auto near  = second_row_along(surface, surface.edge(edge).front());
      surface.refine({first[random() % first.size()], near[random() % near.size()]},
                     {{std::ldexp(1., -level), std::ldexp(1., -level)}});
    }
  Supports supports;
  supports.clamp(edge);
  const auto holder = holders(supports, surface);
  auto       moved  = surface.patch(0);
  for (int i = 0; i < surface.n_control_points(); ++i)
    for (int d = 0; d < 3; ++d)
      if (const double shift = .2 * test::symmetric(random); holder[3 * i + d] < 0)
        moved.control_points(i, d) += shift;
  const Surface<2, 3> deformed({moved}, surface.edges());
  for (const auto &[name, sides] : surface.edges())
    {
      const auto before = edge_geometry(surface, sides.front()), after = edge_geometry(deformed, sides.front());
      double     shift = 0., turn = 0.;
      for (std::size_t e = 0; e < before.size(); ++e)
        for (std::size_t q = 0; q < before[e].quadrature.size(); ++q)
          {
            const auto &a = before[e].quadrature[q], &b = after[e].quadrature[q];
            shift = std::max(shift, (a.position - b.position).norm());
            turn  = std::max(turn, (a.A1.cross(a.A2).normalized() - b.A1.cross(b.A2).normalized()).norm());
          }
      if (name == edge)
        {
          CHECK(shift < 1e-15);
          CHECK(turn < 1e-13); // slopes of the outer functions cancel at 2^4 elements
        }
      else
        CHECK(turn > 1e-2);
    }
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
    CHECK_THROWS_WITH(constraints(supports, space), Catch::Contains("left") && Catch::Contains("x or y"));
  }
  SECTION("edges that do not meet")
  {
    supports.fix(Corner{"left", "right"});
    CHECK_THROWS_AS(constraints(supports, space), InvalidParameter);
    CHECK_THROWS_WITH(constraints(supports, space),
                      Catch::Contains("0 corners") && Catch::Contains("\"bottom\", \"top\""));
  }
  SECTION("a corner of an edge that does not exist")
  {
    supports.fix(Corner{"left", "rim"});
    CHECK_THROWS_WITH(constraints(supports, space), Catch::Contains("rim") && Catch::Contains("bottom"));
  }
  SECTION("edges that meet more than once")
  {
    const Surface<2, 2>    sides({surface.patch(0)},
                                 {{"sides", {{0, Side::u_min}, {0, Side::u_max}}}, {"bottom", {{0, Side::v_min}}}});
    const ShellSpace<2, 2> wide(Environment(MPI_COMM_SELF), sides);
    supports.fix(Corner{"sides", "bottom"});
    CHECK_THROWS_WITH(constraints(supports, wide), Catch::Contains("2 corners"));
  }
  SECTION("a patch that does not exist")
  {
    supports.fix(PatchRegion{1});
    CHECK_THROWS_WITH(constraints(supports, space), Catch::Contains("patch 1") && Catch::Contains("0 to 0"));
  }
}
