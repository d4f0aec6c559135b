#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/verify/degradation.h>

#include <cmath>
#include <limits>

using namespace sherd;
using degradation::Cubic, degradation::Quadratic;

TEST_CASE("degradation: derivatives and values at the ends")
{
  for (const double slope : {1e-4, .01, .1, 1.})
    {
      const auto report = verify::degradation(Cubic(slope));
      INFO("slope " << slope << '\n' << report);
      CHECK(report.passed());
    }
  const auto report = verify::degradation(Quadratic{});
  INFO(report);
  CHECK(report.passed());
}

TEST_CASE("degradation: the cubic function is Eq. (7)")
{
  const Cubic g(.3);
  for (const double phi : {-.1, .2, .7, 1.05})
    CHECK(g.value(phi) == Approx(2.7 * phi * phi - 1.7 * phi * phi * phi).epsilon(1e-14));
  CHECK(Cubic().slope() == 1e-4);
}

TEST_CASE("degradation: slope and curvature at the intact state")
{
  for (const double slope : {1e-4, .01, .1, 1.})
    {
      CHECK(Cubic(slope).first(1.) == Approx(slope).margin(1e-15));
      CHECK(Cubic(slope).second(1.) == Approx(-6. + 4. * slope).epsilon(1e-15));
    }
  CHECK(Quadratic{}.first(1.) == 2.);
  CHECK(Quadratic{}.second(1.) == 2.);
}

TEST_CASE("degradation: values are not clamped outside [0, 1]")
{
  CHECK(Cubic().value(-.01) > 0.);
  CHECK(Cubic().first(-.01) < 0.);
  CHECK(Quadratic{}.value(1.1) == Approx(1.21));
}

TEST_CASE("degradation: a slope outside (0, 1] is refused")
{
  for (const double bad : {0., -1e-4, 1.0001, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(Cubic(bad), InvalidParameter);
  CHECK_NOTHROW(Cubic(1.));
}
