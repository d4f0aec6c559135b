// label: unit
#include <limits>

#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/element_geometry.h>

using namespace sherd;

namespace
{

template <int degree, int spacedim>
void check_linear_precision()
{
  const auto plate = shapes::plate<degree, spacedim>({.3, 7.}, {5, 3});
  REQUIRE(plate.n_elements() == 15);
  REQUIRE(plate.n_control_points() == (5 + degree) * (3 + degree));
  std::mt19937 random(3);
  double       largest = 0.;
  for (int k = 0; k < 50; ++k)
    {
      const double    u = 2.5 * (1. + test::symmetric(random)), v = 1.5 * (1. + test::symmetric(random));
      Point<spacedim> expected = Point<spacedim>::Zero();
      expected[0]              = u / 5. * .3;
      expected[1]              = v / 3. * 7.;
      largest                  = std::max(largest, (test::position_at(plate.patch(0), u, v) - expected).norm());
    }
  CHECK(largest < 1e-14); // rounding of lengths up to 7

  // Its elements are equal rectangles, .06 x 7/3, and their metric is constant and exact.
  for (int e = 0; e < plate.n_elements(); ++e)
    {
      const auto g    = element_geometry(plate, e);
      double     area = 0., defect = 0.;
      for (const auto &q : g.reference)
        {
          area += q.dA;
          defect =
              std::max({defect, std::abs(q.covariant[0] / (.06 * .06) - 1.), std::abs(q.covariant[1] / (49. / 9.) - 1.),
                        std::abs(q.covariant[2]), std::abs(q.laplace_1), std::abs(q.laplace_2)});
        }
      CHECK(area == Approx(.06 * 7. / 3.).epsilon(1e-13));
      CHECK(defect < 1e-10); // second derivatives lose digits to 1/size^2
      CHECK(shortest_edge(g) == Approx(.06).epsilon(1e-13));
      CHECK_FALSE(g.denominator);
    }
}

} // namespace

TEST_CASE("The plate is linear in its parameters")
{
  check_linear_precision<2, 2>();
  check_linear_precision<3, 2>();
  check_linear_precision<2, 3>();
  check_linear_precision<4, 3>();
}

TEST_CASE("The plate's edges lie where their names say")
{
  const auto plate = shapes::plate<2, 2>({2., 3.}, {4, 6});
  const auto along = [&](const std::string &name, int d, double value) {
    REQUIRE(plate.edge(name).size() == 1);
    const auto points = points_along(plate, plate.edge(name).front());
    const auto X      = plate.control_points();
    for (const int i : points)
      CHECK(X(i, d) == Approx(value).margin(1e-15));
    return points.size();
  };
  CHECK(along("left", 0, 0.) == 8);
  CHECK(along("right", 0, 2.) == 8);
  CHECK(along("bottom", 1, 0.) == 6);
  CHECK(along("top", 1, 3.) == 6);
}

TEST_CASE("A plate without extent or without elements is refused")
{
  const double bad =
      GENERATE(0., -1., std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS((shapes::plate<2, 2>({bad, 1.}, {1, 1})), InvalidParameter);
  CHECK_THROWS_AS((shapes::plate<2, 2>({1., bad}, {1, 1})), InvalidParameter);
  CHECK_THROWS_AS((shapes::plate<2, 2>({1., 1.}, {0, 1})), InvalidParameter);
  CHECK_THROWS_AS((shapes::plate<2, 2>({1., 1.}, {1, -4})), InvalidParameter);
}

TEST_CASE("The message about a bad plate names the length and its value")
{
  CHECK_THROWS_WITH((shapes::plate<2, 2>({1., -2e-9}, {1, 1})),
                    Catch::Contains("size[1]") && Catch::Contains("-2e-09"));
  CHECK_THROWS_WITH((shapes::plate<2, 2>({1., 1.}, {3, 0})), Catch::Contains("elements[1] = 0"));
}
