// label: unit
#include <catch2/catch.hpp>

#include <geometry/patch_samples.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;
using shapes::Fit;

namespace
{

template <int degree, class Distance>
double largest(const Surface<degree, 3> &surface, const Distance &distance)
{
  double result = 0.;
  for (int p = 0; p < surface.n_patches(); ++p)
    for (int k = 0; k < 121; ++k)
      {
        const auto &domain = surface.patch(p).basis.domain();
        const auto  X      = test::position_at(surface.patch(p), domain.min[0] + domain.size()[0] * (k % 11) / 10.,
                                               domain.min[1] + domain.size()[1] * (k / 11) / 10.);
        result             = std::max(result, std::abs(distance(X)));
      }
  return result;
}

} // namespace

TEST_CASE("The closed cylinder is round, smooth across its interfaces, and open at its ends only")
{
  const auto cylinder = shapes::closed_cylinder<2>(1.5, 4., 4, {2, 3});
  CHECK(cylinder.n_patches() == 4);
  CHECK(cylinder.interfaces().size() == 4);
  CHECK(cylinder.edges().size() == 2);
  CHECK(cylinder.edge("left").size() == 4);
  CHECK(test::n_free_sides(cylinder) == 8);
  CHECK(cylinder.n_control_points() == 4 * 16); // (2 + 2) x (4 (3 + 1)), closed around
  CHECK(largest(cylinder, [](const Point<3> &X) { return std::hypot(X[1], X[2]) - 1.5; }) < 1e-14);
  CHECK(test::largest_gap(cylinder) < 1e-14);
  CHECK(test::kinks(cylinder)[1] < 1e-7);
  CHECK(test::area(cylinder) == Approx(2. * M_PI * 1.5 * 4.).epsilon(1e-6)); // quadrature of a rational speed
  for (const auto &joined : cylinder.interfaces())
    CHECK(normals_agree(joined));
  for (const int n : {3, 6})
    CHECK(shapes::closed_cylinder<3>(1., 1., n, {1, 1}).interfaces().size() == static_cast<std::size_t>(n));

  // Interpolated: one patch, joined to itself.
  const auto smooth = shapes::closed_cylinder<3>(1., 1., 1, {1, 12}, Fit::smooth);
  CHECK(smooth.n_patches() == 1);
  CHECK(smooth.interfaces().size() == 1);
  CHECK(smooth.edges().size() == 2);
  CHECK(largest(smooth, [](const Point<3> &X) { return std::hypot(X[1], X[2]) - 1.; }) < 1e-3);
  CHECK(smooth.n_control_points() == 4 * 14); // 15 around the patch, of which the ends are one

  CHECK_THROWS_WITH(shapes::closed_cylinder<2>(1., 1., 2, {1, 1}), Catch::Contains("patches = 2"));
  CHECK_THROWS_AS(shapes::closed_cylinder<2>(1., 1., 0, {1, 1}, Fit::smooth), InvalidParameter);
}

TEST_CASE("The closed torus has no edge")
{
  const double R = 2., r = .5;
  const auto   torus = shapes::closed_torus<2>(R, r, {4, 3}, {2, 2});
  CHECK(torus.n_patches() == 12);
  CHECK(torus.interfaces().size() == 24);
  CHECK(torus.edges().empty());
  CHECK(torus.n_control_points() == 12 * 9); // two rows of 4 are shared in each direction: 3 x 3 each
  CHECK(largest(torus, [&](const Point<3> &X) { return std::hypot(std::hypot(X[0], X[1]) - R, X[2]) - r; }) < 1e-14);
  CHECK(test::kinks(torus)[1] < 1e-7);
  CHECK(test::area(torus) == Approx(4. * M_PI * M_PI * R * r).epsilon(1e-4));
  for (const auto &joined : torus.interfaces())
    CHECK(normals_agree(joined));
  CHECK_THROWS_WITH(shapes::closed_torus<2>(2., 1., {4, 2}, {1, 1}), Catch::Contains("patches[1] = 2"));
}

TEST_CASE("The box has folds of 90 degrees, normals outward, and a name for each fold")
{
  const auto box = shapes::box<2>({1., 2., 3.}, {2, 3, 4});
  CHECK(box.n_patches() == 6);
  CHECK(box.interfaces().size() == 12);
  CHECK(box.edges().size() == 12);
  CHECK(test::area(box) == Approx(22.).epsilon(1e-14));
  CHECK(test::largest_gap(box) == 0.);
  for (const double kink : test::kinks(box))
    CHECK(kink == Approx(.5 * M_PI).epsilon(1e-14));
  const Point<3> middle(.5, 1., 1.5);
  for (int p = 0; p < 6; ++p)
    {
      const auto &patch  = box.patch(p);
      const auto  centre = patch.basis.domain().centre();
      const auto  out    = test::position_at(patch, centre[0], centre[1]) - middle;
      CHECK(out.normalized().dot(test::normal_at(patch, centre[0], centre[1])) == Approx(1.));
    }
  for (const auto &joined : box.interfaces())
    CHECK(normals_agree(joined));
  for (const auto &edge : box.edge("left front"))
    for (const int i : points_along(box, edge))
      CHECK(box.control_points().row(i).head(2).norm() < 1e-15);

  const auto open = shapes::box<2>({1., 1., 1.}, {2, 2, 2}, shapes::Lid::open);
  CHECK(open.n_patches() == 5);
  CHECK(open.interfaces().size() == 8);
  REQUIRE(open.edge("rim").size() == 4);
  for (const auto &edge : open.edge("rim"))
    for (const int i : points_along(open, edge))
      CHECK(open.control_points()(i, 2) == 1.);
  CHECK_THROWS_WITH(shapes::box<2>({1., 1., 0.}, {1, 1, 1}), Catch::Contains("size[2]"));
  CHECK_THROWS_WITH(shapes::box<2>({1., 1., 1.}, {1, 0, 1}), Catch::Contains("elements[1] = 0"));
}

TEST_CASE("Any number of patches meets at the centre of a polygon")
{
  for (const int n : {3, 4, 5, 8})
    {
      const auto polygon = shapes::polygon<2>(2., n, 3);
      CHECK(polygon.n_patches() == n);
      CHECK(polygon.interfaces().size() == static_cast<std::size_t>(n));
      CHECK(polygon.n_control_points() == 16 * n + 4 * n + 1);
      CHECK(test::area(polygon) == Approx(.5 * n * 4. * std::sin(2. * M_PI / n)).epsilon(1e-13));
      CHECK(test::kinks(polygon)[1] < 1e-7);
      CHECK(polygon.edge("outer").size() == 2 * static_cast<std::size_t>(n));
      CHECK(polygon.locations_of(polygon.point(0, 0)).size() == static_cast<std::size_t>(n));
    }
  CHECK_THROWS_WITH((shapes::polygon<2, 2>(1., 2, 1)), Catch::Contains("sides = 2"));
}

TEST_CASE("Surfaces are joined where their sides coincide, and keep their names elsewhere")
{
  const auto left  = shapes::plate<2, 3>({1., 1.}, {2, 2});
  auto       moved = left.patch(0);
  moved.control_points.col(0).array() += 1.;
  const Surface<2, 3> right({moved}, {{"right", {{0, Side::u_max}}}, {"seam", {{0, Side::u_min}}}});
  const auto          both = join<2, 3>({left, right});
  CHECK(both.interfaces().size() == 1);
  CHECK(both.edges().size() == 4); // left, bottom, top of the first; right of the second; not the seam
  REQUIRE(both.edge("right").size() == 1);
  CHECK(both.edge("right").front().patch == 1);
  CHECK(both.n_control_points() == 4 * 7);
  CHECK_THROWS_AS((join<2, 3>({})), InvalidParameter);
}
