// label: unit
#include <catch2/catch.hpp>

#include <geometry/patch_samples.h>
#include <sherd/geometry/shapes.h>
#include <sherd/geometry/tensor_product.h>

using namespace sherd;
using test::position_at;

namespace
{

/// Largest distance between a one-patch surface and the parts that keep its parameters.
template <int degree, int spacedim>
double difference(const Surface<degree, spacedim> &whole, const Surface<degree, spacedim> &parts)
{
  double       result = 0.;
  std::mt19937 random(5);
  for (int p = 0; p < parts.n_patches(); ++p)
    for (int k = 0; k < 50; ++k)
      {
        const auto  &domain = parts.patch(p).basis.domain();
        const double u      = domain.min[0] + .5 * (1. + test::symmetric(random)) * domain.size()[0],
                     v      = domain.min[1] + .5 * (1. + test::symmetric(random)) * domain.size()[1];
        result = std::max(result, (position_at(parts.patch(p), u, v) - position_at(whole.patch(0), u, v)).norm());
      }
  return result;
}

/// A circle of radius 1 from one knot vector of degree 2, swept along z: C0 at every quadrant, closed by its seam.
Surface<2, 3> nine_point_cylinder()
{
  const double              w = std::sqrt(.5);
  const std::vector<double> u{0., 0., 0., .25, .25, .5, .5, .75, .75, 1., 1., 1.}, v{0., 0., 0., 2., 2., 2.};
  const double              X[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  Patch<2, 3>               patch{LRBasis<2>(u, v), ControlValues<3>(27, 3), Eigen::VectorXd(27)};
  for (int j = 0, k = 0; j < 3; ++j)
    for (int i = 0; i < 9; ++i, ++k)
      {
        patch.control_points.row(k) << X[i][0], X[i][1], j;
        patch.weights[k] = i % 2 == 0 ? 1. : w;
      }
  return join<2, 3>({Surface<2, 3>({patch}, name_sides("begin", "end", "bottom", "top"))});
}

} // namespace

TEST_CASE("A plate cut into 2 x 3 patches stays the same surface, with the same edges")
{
  const auto plate = test::distorted(shapes::plate<2, 3>({2., 3.}, {4, 6}), .1);
  const auto parts = split_patches(plate, {2, 3});
  REQUIRE(parts.n_patches() == 6);
  CHECK(parts.n_elements() == 24);
  CHECK(parts.interfaces().size() == 7);
  // One row of control points more for each cut, since splines are C0 there: (6 + 1) x (8 + 2).
  CHECK(parts.n_control_points() == 70);
  CHECK(difference(plate, parts) < 1e-15 * 30);
  CHECK(test::largest_gap(parts) < 1e-14);
  CHECK(test::area(parts) == Approx(test::area(plate)).epsilon(1e-13));
  CHECK(parts.edge("left").size() == 3);
  CHECK(parts.edge("top").size() == 2);
  for (const auto &[name, d, value] :
       {std::tuple{"left", 0, 0.}, std::tuple{"right", 0, 2.}, std::tuple{"bottom", 1, 0.}, std::tuple{"top", 1, 3.}})
    for (const auto &edge : parts.edge(name))
      for (const int i : points_along(parts, edge))
        CHECK(std::abs(parts.control_points()(i, d) - value) < 1e-15);
  CHECK(parts.patch(1).basis.domain().min == std::array{2., 0.});
  CHECK(parts.patch(1).basis.domain().max == std::array{4., 2.});
}

TEST_CASE("Curved rational patches are cut exactly, at knots and between them, degrees 2 to 4")
{
  const auto check = [](const auto &roof) {
    auto parts = split_patches(roof, 0, Direction::u, 1.);
    parts      = split_patches(parts, 1, Direction::v, .7);
    CHECK(parts.n_patches() == 4);
    CHECK(difference(roof, parts) < 1e-14);
    CHECK(test::kinks(parts)[1] < 1e-7); // normals from rounded tangents; acos-free angle
  };
  check(shapes::roof<2>(2., 3., .6, {2, 3}));
  check(shapes::roof<3>(2., 3., .6, {2, 3}));
  check(shapes::roof<4>(2., 3., .6, {2, 3}));
  check(shapes::roof<3>(2., 3., .6, {2, 3}, shapes::Fit::smooth));
}

TEST_CASE("Cutting twice is cutting once, and in any order")
{
  const auto plate = shapes::plate<2, 2>({1., 1.}, {4, 4});
  const auto once  = split_patches(plate, {2, 2});
  const auto twice = split_patches(split_patches(plate, 0, Direction::v, 2.), 0, Direction::u, 2.);
  CHECK(twice.n_patches() == 4);
  CHECK(twice.n_control_points() == once.n_control_points());
  // A cut where there is one already is at the boundary of its patch.
  CHECK_THROWS_AS(split_patches(once, 0, Direction::u, 2.), InvalidParameter);
}

TEST_CASE("A cut goes on through joined patches, however they are turned")
{
  // Five patches around a point: a line of constant u of one arrives as a line of constant v in the one before.
  const auto star = shapes::polygon<2, 2>(1., 5, 2);
  const auto cut  = split_patches(star, 3, Direction::u, 1.);
  CHECK(cut.n_patches() == 7);
  CHECK(cut.interfaces().size() == 5 + 1 + 2); // one old interface in two
  CHECK(test::largest_gap(cut) < 1e-15);
  CHECK(test::area(cut) == Approx(test::area(star)).epsilon(1e-14));
  CHECK(cut.edge("outer").size() == 12);

  // Round the equator of a sphere and back.
  const auto sphere = shapes::sphere<2>(1., 4);
  const auto ring   = split_patches(sphere, 5, Direction::u, 1.);
  CHECK(ring.n_patches() == 10);
  CHECK(ring.interfaces().size() == 20);
  CHECK(test::largest_gap(ring) < 1e-14);
  CHECK(test::area(ring) == Approx(test::area(sphere)).epsilon(1e-13));

  // The seam of a closed patch: the cut ends where it began.
  const auto seam = shapes::closed_cylinder<2>(1., 2., 1, {2, 8}, shapes::Fit::smooth);
  REQUIRE(seam.interfaces().size() == 1);
  const auto halves = split_patches(seam, 0, Direction::u, 1.);
  CHECK(halves.n_patches() == 2);
  CHECK(halves.interfaces().size() == 3);
}

TEST_CASE("All patches in m x n parts; where they are turned against each other the larger number counts")
{
  const auto box = split_patches(shapes::box<2>({1., 2., 3.}, {6, 6, 6}), {2, 2});
  CHECK(box.n_patches() == 24);
  CHECK(box.interfaces().size() == 48);
  CHECK(box.edge("bottom left").size() == 2);
  const auto star = split_patches(shapes::polygon<2, 2>(1., 3, 6), {3, 1});
  CHECK(star.n_patches() == 27); // u and v lines alternate round a point of three patches
}

TEST_CASE("C0 lines become interfaces")
{
  const auto circle = nine_point_cylinder();
  REQUIRE(circle.interfaces().size() == 1);
  const auto parts = split_at_c0_lines(circle);
  REQUIRE(parts.n_patches() == 4);
  CHECK(parts.interfaces().size() == 4);
  CHECK(parts.n_control_points() == circle.n_control_points());
  for (int p = 0; p < 4; ++p)
    CHECK(parts.patch(p).basis.initial_knots()[0].size() == 6);
  CHECK(difference(circle, parts) < 1e-14);
  CHECK(test::kinks(parts)[1] < 1e-7);
  CHECK(parts.edge("top").size() == 4);
  CHECK(test::area(parts) == Approx(2. * M_PI * 2.).epsilon(1e-4)); // quadrature of a rational speed
  CHECK(split_at_c0_lines(shapes::plate<2, 2>({1., 1.}, {3, 3})).n_patches() == 1);
}

TEST_CASE("Uniformly refined patches can be cut, locally refined ones are refused")
{
  auto plate = shapes::plate<2, 2>({1., 1.}, {2, 2});
  test::refine_everywhere(plate, 1);
  const auto parts = split_patches(plate, {2, 2});
  CHECK(parts.n_patches() == 4);
  CHECK(parts.n_elements() == 16);
  CHECK(difference(plate, parts) < 1e-15);

  const auto tensor = tensor_product(plate.patch(0));
  REQUIRE(tensor);
  CHECK(tensor->basis.initial_knots()[0] == std::vector{0., 0., 0., .5, 1., 1.5, 2., 2., 2.});

  plate.refine({0}, {{.25, .25}});
  CHECK_FALSE(tensor_product(plate.patch(0)));
  CHECK_THROWS_WITH(split_patches(plate, {2, 2}), Catch::Contains("refined locally"));
}

TEST_CASE("Cuts that cannot be are refused")
{
  const auto plate = shapes::plate<2, 2>({1., 1.}, {2, 3});
  CHECK_THROWS_WITH(split_patches(plate, 1, Direction::u, 1.), Catch::Contains("patch 1") && Catch::Contains("0 to 0"));
  CHECK_THROWS_WITH(split_patches(plate, 0, Direction::v, 3.), Catch::Contains("v = 3") && Catch::Contains("0 and 3"));
  CHECK_THROWS_AS(split_patches(plate, 0, Direction::u, -.1), InvalidParameter);
  CHECK_THROWS_AS(split_patches(plate, 0, Direction::u, std::nan("")), InvalidParameter);
  CHECK_THROWS_WITH(split_patches(plate, {2, 0}), Catch::Contains("pieces[1] = 0"));
}

TEST_CASE("A cut within rounding of a knot is at the knot")
{
  const auto plate = shapes::plate<2, 2>({1., 1.}, {3, 1});
  const auto parts = split_patches(plate, 0, Direction::u, 3. * (1. / 3.) + 1e-14);
  CHECK(parts.n_elements() == 3);
  CHECK(parts.patch(0).basis.domain().max[0] == 1.);
}
