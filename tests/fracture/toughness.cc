#include <catch2/catch.hpp>

#include <sherd/base/formula.h>
#include <sherd/fracture/toughness.h>

#include <limits>

using namespace sherd;

namespace
{
const double nan_value = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
}

TEST_CASE("toughness: a constant holds everywhere")
{
  const Toughness<2> Gc = .5;

  CHECK(Gc({0., 0.}) == .5);
  CHECK(Gc({1., -3.}) == .5);
}

TEST_CASE("toughness: a function of the position, or of its coordinates")
{
  const Toughness<2> tough_right([](const Point<2> &X) { return X[0] > 1. ? 10. : 1.; });
  const Toughness<2> of_x_y([](const double x, const double y) { return 1. + x + 10. * y; });
  const Toughness<3> of_x_y_z(
      [](const double x, const double y, const double z) { return 1. + x + 10. * y + 100. * z; });

  CHECK(tough_right({.5, 0.}) == 1.);
  CHECK(tough_right({1.5, 0.}) == 10.);
  CHECK(of_x_y({2., 3.}) == 33.);
  CHECK(of_x_y_z({2., 3., 4.}) == 433.);
  const Toughness<2> copy = of_x_y;
  CHECK(copy({2., 3.}) == 33.);
}

TEST_CASE("toughness: a formula of the coordinates")
{
  const Toughness<2> Gc(Formula("x > 0.5 ? 10 : 1 + y", {"x", "y"}));

  CHECK(Gc({.75, 2.}) == 10.);
  CHECK(Gc({.25, 2.}) == 3.);
  CHECK_THROWS_AS(Gc({.25, -1.}), InvalidParameter);
}

TEST_CASE("toughness: a constant that is not positive and finite is refused")
{
  for (const double bad : {0., -1., nan_value, infinity})
    CHECK_THROWS_AS(Toughness<2>(bad), InvalidParameter);
}

TEST_CASE("toughness: a bad value of a function is refused with its position")
{
  for (const double bad : {0., -1., nan_value, infinity})
    {
      const Toughness<2> Gc([bad](const Point<2> &X) { return X[0] > .5 ? bad : 1.; });

      CHECK(Gc({.5, .125}) == 1.);
      CHECK_THROWS_AS(Gc({.75, .125}), InvalidParameter);
      CHECK_THROWS_WITH(Gc({.75, .125}), Catch::Contains("(0.75, 0.125)"));
    }
}
