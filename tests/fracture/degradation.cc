#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/fracture/degradation/quartic.h>
#include <sherd/fracture/degradation/rational.h>
#include <sherd/fracture/degradation/with_residual.h>
#include <sherd/verify/degradation.h>

#include <cmath>
#include <limits>

using namespace sherd;
using degradation::Cubic, degradation::Quadratic, degradation::Quartic, degradation::Rational;
using degradation::WithResidual;

namespace
{
template <class Function>
void check(const Function &g)
{
  const auto report = verify::degradation(g);
  INFO(report);
  CHECK(report.passed());
}
} // namespace

TEST_CASE("degradation: derivatives and values at the ends")
{
  for (const double slope : {1e-4, .01, .1, 1.})
    {
      INFO("slope " << slope);
      check(Cubic(slope));
      check(Quartic(slope));
    }
  check(Quadratic{});
  for (const double slope : {.5, 2., 10., 30.})
    for (const double shape : {-.9, -.5, 0., 1.})
      {
        INFO("slope " << slope << ", shape " << shape);
        check(Rational(slope, shape));
      }
}

TEST_CASE("degradation: any function takes a residual stiffness")
{
  check(WithResidual(Cubic()));
  check(WithResidual(Quadratic{}, .1));
  check(WithResidual(Quartic(), 0.));
  check(WithResidual(Rational(3.), 1e-3));
  CHECK(WithResidual(Cubic()).value(0.) == 1e-8);
  CHECK(WithResidual(Quadratic{}, .1).value(.5) == Approx(.325).epsilon(1e-15));
  CHECK(WithResidual(Quadratic{}, .1).residual() == .1);
}

TEST_CASE("degradation: the quartic function without slope is 4 phi^3 - 3 phi^4")
{
  const Quartic g(1e-12);
  for (const double phi : {-.1, .2, .7, 1.05})
    CHECK(g.value(phi) == Approx(4. * std::pow(phi, 3) - 3. * std::pow(phi, 4)).epsilon(1e-10));
}

TEST_CASE("degradation: the rational function")
{
  // With m = 1 and P = 0 the denominator is 1 - phi + phi^2.
  const Rational g(1., 0.);
  for (const double phi : {.2, .7, 1.})
    CHECK(g.value(phi) == Approx(phi * phi / (1. - phi + phi * phi)).epsilon(1e-14));
  // Above 1 it has no pole, and goes on with the same slope and curvature.
  const Rational steep(50.);
  CHECK(steep.value(1.05) > 1.);
  CHECK(steep.first(std::nextafter(1., 2.)) == Approx(steep.first(1.)).epsilon(1e-12));
  CHECK(steep.second(std::nextafter(1., 2.)) == steep.second(1.));
  CHECK(steep.second(1.) == Approx(steep.second(std::nextafter(1., 0.))).epsilon(1e-12));
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
  for (const double slope : {1e-4, .1, 1.})
    {
      CHECK(Quartic(slope).first(1.) == Approx(slope).margin(1e-15));
      CHECK(Quartic(slope).second(1.) == Approx(-12. + 6. * slope).epsilon(1e-15));
      CHECK(Rational(slope, .3).first(1.) == Approx(slope).epsilon(1e-15));
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

TEST_CASE("degradation: parameters outside their range are refused")
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0., -1e-4, 1.0001, nan})
    {
      CHECK_THROWS_AS(Cubic(bad), InvalidParameter);
      CHECK_THROWS_AS(Quartic(bad), InvalidParameter);
    }
  CHECK_NOTHROW(Cubic(1.));
  CHECK_NOTHROW(Quartic(1.));
  for (const double bad : {0., -1., nan, infinity})
    CHECK_THROWS_AS(Rational(bad), InvalidParameter);
  for (const double bad : {-.91, nan, infinity})
    CHECK_THROWS_AS(Rational(1., bad), InvalidParameter);
  for (const double bad : {-1e-9, 1., nan})
    CHECK_THROWS_AS(WithResidual(Cubic(), bad), InvalidParameter);
}
