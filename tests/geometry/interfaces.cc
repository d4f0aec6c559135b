// label: unit
#include <set>

#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>
#include <sherd/geometry/shapes/box.h>
#include <sherd/geometry/shapes/sphere.h>
#include <sherd/spline/independence.h>

using namespace sherd;

namespace
{

/// Both sides of every interface carry the same functions, with the same weights, and share their control points.
template <int degree, int spacedim>
void check_interfaces(const Surface<degree, spacedim> &surface)
{
  for (const auto &[first, second, reversed] : surface.interfaces())
    {
      const auto &a = surface.patch(first.patch), &b = surface.patch(second.patch);
      const auto  on_a = internal::side_functions(a.basis, first.side, false);
      const auto  on_b = internal::side_functions(b.basis, second.side, reversed);
      REQUIRE(on_a.size() == on_b.size());
      double gamma = 0.;
      for (std::size_t k = 0; k < on_a.size(); ++k)
        {
          const int i = on_a[k].index, j = on_b[k].index;
          REQUIRE(on_a[k].marks == on_b[k].marks);
          REQUIRE(surface.point(first.patch, i) == surface.point(second.patch, j));
          CHECK(a.control_points.row(i) == b.control_points.row(j));
          CHECK(a.weights[i] == b.weights[j]);
          gamma = std::max(gamma, std::abs(a.basis.function(i).gamma - b.basis.function(j).gamma));
        }
      CHECK(gamma < 1e-14);
      // The functions do not depend on each other along the interface either: collocation at the centres of their
      // knots, or a least-squares version of it, has full rank.
      const auto                         &knots = a.basis.initial_knots()[1 - internal::normal_direction(first.side)];
      const internal::SideRuler           ruler(knots, false);
      constexpr int                       n_samples = 6;
      std::set<internal::SideRuler::Mark> ends;
      for (const auto &f : on_a)
        ends.insert(f.marks.begin(), f.marks.end());
      std::vector<double> ends_at;
      for (const auto mark : ends)
        ends_at.push_back(ruler.parameter(mark));
      Eigen::MatrixXd collocation = Eigen::MatrixXd::Zero(n_samples * (ends_at.size() - 1), on_a.size());
      for (std::size_t k = 0; k < on_a.size(); ++k)
        {
          const auto &along = a.basis.function(on_a[k].index).knots[1 - internal::normal_direction(first.side)];
          for (std::size_t e = 0; e + 1 < ends_at.size(); ++e)
            for (int s = 0; s < n_samples; ++s)
              {
                const double x = ends_at[e] + (s + .5) / n_samples * (ends_at[e + 1] - ends_at[e]);
                if (const int m = span_index<degree>(along, x); m >= 0)
                  collocation(e * n_samples + s, k) = evaluate_piece<degree>(along, m, x).value;
              }
        }
      CHECK(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(collocation).rank() == collocation.cols());
    }
  for (int point = 0; point < surface.n_control_points(); ++point)
    for (const auto &[p, local] : surface.locations_of(point))
      CHECK(surface.point(p, local) == point);
}

/// Refines at random a few times and checks all that must not change.
template <int degree, int spacedim>
void check_random_refinement(Surface<degree, spacedim> surface, int levels, unsigned seed)
{
  std::mt19937 random(seed);
  check_interfaces(surface);
  const auto      before = surface;
  Eigen::VectorXd field(surface.n_control_points());
  for (auto &value : field)
    value = test::symmetric(random);
  Eigen::VectorXd refined = field;
  for (int level = 1; level <= levels; ++level)
    {
      std::vector<int> marked;
      for (int k = 0; k < 3; ++k)
        marked.push_back(static_cast<int>(random() % surface.n_control_points()));
      // Points on interfaces now and then, and some of their neighbours.
      const auto &interface = surface.interfaces()[random() % surface.interfaces().size()];
      const auto  shared    = points_along(surface, interface.first);
      const auto  next      = second_row_along(surface, interface.second);
      marked.push_back(shared[random() % shared.size()]);
      marked.push_back(next[random() % next.size()]);
      const auto refinement = surface.refine_to(marked, test::halved(surface, level));
      refined               = refinement.transfer.apply(refined);
      REQUIRE(static_cast<int>(refinement.parent.size()) == surface.n_elements());
      REQUIRE(refinement.transfer.n_rows() == surface.n_control_points());
      for (int i = 0; i < refinement.transfer.n_rows(); ++i)
        {
          const auto columns = refinement.transfer.row_columns(i);
          const auto values  = refinement.transfer.row_values(i);
          CHECK(std::is_sorted(columns.begin(), columns.end()));
          CHECK(std::accumulate(values.begin(), values.end(), 0.) == Approx(1.).epsilon(1e-13));
        }
      check_interfaces(surface);
    }
  double moved = 0., changed = 0.;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      CHECK(check_independence(surface.patch(p).basis).independent());
      const auto &domain = surface.patch(p).basis.domain();
      for (int k = 0; k < 40; ++k)
        {
          std::array<double, 2> at;
          for (int d = 0; d < 2; ++d)
            at[d] = domain.min[d] + .5 * (1. + test::symmetric(random)) * domain.size()[d];
          if (k % 4 == 0) // on a side
            at[k / 4 % 2] = k / 8 % 2 ? domain.max[k / 4 % 2] : domain.min[k / 4 % 2];
          moved   = std::max(moved, (test::position_at(surface.patch(p), at[0], at[1]) -
                                   test::position_at(before.patch(p), at[0], at[1]))
                                        .norm());
          changed = std::max(changed, std::abs(test::field_at(surface, p, refined, at[0], at[1]) -
                                               test::field_at(before, p, field, at[0], at[1])));
        }
    }
  CHECK(moved < 1e-13);
  CHECK(changed < 1e-13);
}

} // namespace

TEST_CASE("Patches that coincide along sides are joined whatever way their parameters run")
{
  std::mt19937 random(5);
  const auto   left  = test::bilinear<2, 2>({Point<2>(0., 0.), Point<2>(1., 0.), Point<2>(0., 1.), Point<2>(1., 1.)},
                                         test::equal_knots<2>(3, 0., 3.), test::equal_knots<2>(2, -1., 1.));
  const auto   right = test::bilinear<2, 2>({Point<2>(1., 0.), Point<2>(3., 0.), Point<2>(1., 1.), Point<2>(3., 2.)},
                                          test::equal_knots<2>(4, 0., 1.), test::equal_knots<2>(2, 5., 9.));
  std::set<std::array<int, 3>> seen;
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b)
      {
        std::vector<Patch<2, 2>> patches{test::reoriented(left, a), test::reoriented(right, b)};
        const auto               interfaces = find_interfaces(patches);
        REQUIRE(interfaces.size() == 1);
        const auto &found = interfaces.front();
        seen.insert({static_cast<int>(found.first.side), static_cast<int>(found.second.side), found.reversed});
        Surface<2, 2> surface(patches, {}, interfaces);
        CHECK(surface.n_control_points() == 5 * 4 + 6 * 4 - 4);
        check_interfaces(surface);
        if (b == (3 * a) % 8)
          check_random_refinement(surface, 2, 8 * a + b);
      }
  CHECK(seen.size() == 4 * 4 * 2);
}

TEST_CASE("A surface without interfaces numbers its patches one after the other")
{
  std::mt19937        random(3);
  const auto          patches = test::star<2, 2>(3, 2, random);
  const Surface<2, 2> surface(patches, {});
  CHECK(surface.n_control_points() == 3 * 16);
  for (int p = 0; p < 3; ++p)
    for (int i = 0; i < 16; ++i)
      {
        CHECK(surface.point(p, i) == 16 * p + i);
        CHECK(surface.locations_of(16 * p + i).size() == 1);
      }
}

TEST_CASE("Where several patches meet they share one control point")
{
  const int    n = GENERATE(2, 3, 4, 5);
  std::mt19937 random(n);
  const auto   patches    = test::star<2, 2>(n, 2, random);
  const auto   interfaces = find_interfaces(patches);
  CHECK(static_cast<int>(interfaces.size()) == (n == 2 ? 1 : n));
  const Surface<2, 2> surface(patches, {}, interfaces);
  // n patches of 4 x 4, their sides shared but for one point in the centre that all have.
  CHECK(surface.n_control_points() == (n == 2 ? 28 : 16 * n - 4 * n + 1));
  std::size_t most = 0;
  for (int point = 0; point < surface.n_control_points(); ++point)
    most = std::max(most, surface.locations_of(point).size());
  CHECK(static_cast<int>(most) == n);
  check_interfaces(surface);
}

TEST_CASE("Refinement crosses interfaces, and changes neither surface nor fields")
{
  const unsigned seed = GENERATE(1u, 2u);
  std::mt19937   random(seed);
  SECTION("two to five patches around a corner")
  {
    const int  n       = GENERATE(2, 3, 4, 5);
    const auto patches = test::star<2, 2>(n, 3, random);
    check_random_refinement(Surface<2, 2>(patches, {}, find_interfaces(patches)), 4, seed);
  }
  SECTION("degree 3")
  {
    const auto patches = test::star<3, 2>(3, 3, random);
    check_random_refinement(Surface<3, 2>(patches, {}, find_interfaces(patches)), 3, seed);
  }
  SECTION("a closed surface of six rational patches")
  {
    const auto patches    = test::ball<2>(4, random);
    const auto interfaces = find_interfaces(patches);
    CHECK(interfaces.size() == 12);
    check_random_refinement(Surface<2, 3>(patches, {}, interfaces), 4, seed);
  }
  SECTION("the sphere, with its corners of three patches")
  {
    check_random_refinement(shapes::sphere<2>(1., 3), 3, seed);
    check_random_refinement(shapes::sphere<3>(1., 2), 2, seed);
  }
  SECTION("a box, with folds and corners of three patches")
  {
    check_random_refinement(shapes::box<2>({1., 2., 3.}, {2, 3, 4}), 3, seed);
  }
  SECTION("an open box, with corners of two patches on its rim")
  {
    check_random_refinement(shapes::box<2>({1., 2., 3.}, {2, 3, 4}, shapes::Lid::open), 3, seed);
  }
}

TEST_CASE("A patch is joined to itself")
{
  const auto kind  = GENERATE(test::Closed::ring, test::Closed::moebius, test::Closed::torus);
  const auto patch = test::closed_patch<2>(kind, 6, 5);
  auto       found = find_interfaces(std::vector{patch});
  REQUIRE(found.size() == (kind == test::Closed::torus ? 2 : 1));
  CHECK(found.front().reversed == (kind == test::Closed::moebius));
  const Surface<2, 3> surface({patch}, {}, found);
  CHECK(surface.n_control_points() == 7 * (kind == test::Closed::torus ? 6 : 7));
  check_random_refinement(surface, 3, 4);
}

TEST_CASE("A shared control point refines all of its patches, another one only where it must")
{
  std::mt19937 random(1);
  const auto   patches = test::star<2, 2>(4, 4, random);
  const auto   joined  = Surface<2, 2>(patches, {}, find_interfaces(patches));
  const auto   grown   = [&](const Surface<2, 2> &surface) {
    std::vector<int> patches_grown;
    for (int p = 0; p < 4; ++p)
      if (surface.patch(p).basis.n_elements() > 16)
        patches_grown.push_back(p);
    return patches_grown;
  };
  int centre = 0;
  while (joined.locations_of(centre).size() < 4)
    ++centre;
  auto surface = joined;
  surface.refine_to({centre}, test::halved(surface, 1));
  CHECK(grown(surface) == std::vector<int>{0, 1, 2, 3});

  // The support of the function in the far corner of patch 2 touches no other patch.
  surface         = joined;
  const auto away = [&] {
    const auto points = surface.points_of_patch(2);
    int        best   = points[0];
    for (const int point : points)
      if (surface.control_points().row(point).norm() > surface.control_points().row(best).norm())
        best = point;
    return best;
  }();
  surface.refine_to({away}, test::halved(surface, 1));
  CHECK(grown(surface) == std::vector<int>{2});
}

TEST_CASE("Sides that do not fit are refused with a reason")
{
  std::mt19937 random(2);
  auto         patches    = test::star<2, 2>(3, 2, random);
  const auto   interfaces = find_interfaces(patches);
  const auto   surface    = [&] { return Surface<2, 2>(patches, {}, interfaces); };
  const int    moved      = internal::side_functions(patches[0].basis, interfaces[0].first.side, false)[1].index;
  SECTION("a gap")
  {
    patches[0].control_points(moved, 0) += 1e-6;
    CHECK_THROWS_WITH(surface(), Catch::Contains("cannot be joined") && Catch::Contains("apart"));
    CHECK(find_interfaces(patches).size() == 2);
  }
  SECTION("different weights")
  {
    patches[0].weights[moved] = 1.1;
    CHECK_THROWS_WITH(surface(), Catch::Contains("weights"));
  }
  SECTION("other elements")
  {
    auto refined = Surface<2, 2>({patches[0]}, {});
    test::refine_everywhere(refined, 3);
    patches[0] = refined.patch(0);
    CHECK_THROWS_WITH(surface(), Catch::Contains("refined"));
  }
  SECTION("the wrong direction")
  {
    auto wrong        = interfaces;
    wrong[0].reversed = !wrong[0].reversed;
    CHECK_THROWS_WITH((Surface<2, 2>(patches, {}, wrong)), Catch::Contains("apart"));
  }
  SECTION("a side that is joined twice, or to itself")
  {
    auto twice = interfaces;
    twice.push_back(interfaces[0]);
    CHECK_THROWS_WITH((Surface<2, 2>(patches, {}, twice)), Catch::Contains("two interfaces"));
    CHECK_THROWS_AS((Surface<2, 2>(patches, {}, {{{0, Side::u_min}, {0, Side::u_min}, false}})), InvalidParameter);
  }
  SECTION("a patch that does not exist")
  {
    CHECK_THROWS_WITH((Surface<2, 2>(patches, {}, {{{0, Side::u_min}, {7, Side::u_min}, false}})),
                      Catch::Contains("patch 7"));
  }
  SECTION("three sheets along one curve")
  {
    patches.push_back(patches[0]);
    CHECK_THROWS_WITH(find_interfaces(patches), Catch::Contains("third side"));
  }
}
