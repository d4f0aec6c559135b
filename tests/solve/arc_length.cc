// ranks: 1 2
#include <catch2/catch.hpp>

#include "koiter_body.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("a truss is followed through both limit points along its exact path")
{
  Truss               truss;
  ArcLength           path(truss.solver, truss.state, {.first_factor = .1});
  std::vector<double> heights, factors;
  double              previous = Truss::rise;
  while (path.state().time < 2. && heights.size() < 100)
    {
      const int iterations = path.advance();
      CHECK(iterations >= 1);
      const double z = truss.height(path.state());
      // The load is small beside the forces in the strip; Newton stops at 1e-8 of those.
      CHECK(path.state().time == Approx(Truss::load_factor(z)).margin(1e-5));
      CHECK(z < previous); // goes on and never back
      previous = z;
      heights.push_back(z);
      factors.push_back(path.state().time);
    }
  REQUIRE(path.state().time >= 2.);
  CHECK(heights.back() < -Truss::rise);
  CHECK(path.state().step == static_cast<int>(heights.size()));

  // Both limit points are on it: the load is symmetric, largest and smallest at z = +- rise / sqrt(3).
  const double limit   = Truss::load_factor(Truss::rise / std::sqrt(3.));
  double       largest = 0., smallest = 0.;
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (heights[i] > 0.)
      largest = std::max(largest, factors[i]);
    else
      smallest = std::min(smallest, factors[i]);
  CHECK(largest <= limit * (1. + 1e-6));
  CHECK(largest >= .95 * limit);
  CHECK(smallest >= -limit * (1. + 1e-6));
  CHECK(smallest <= -.95 * limit);
}

TEST_CASE("a bar is followed beyond its limit load")
{
  Bar       bar({}, Bar::pull(-1.));
  ArcLength path(bar.solver, bar.state, {.first_factor = .02});
  double    largest = 0.;
  for (int i = 0; i < 60 && bar.stretch(path.state()) > .3; ++i)
    {
      path.advance();
      CHECK(-path.state().time == Approx(Bar::force(bar.stretch(path.state()))).margin(1e-8));
      largest = std::max(largest, path.state().time);
    }
  CHECK(bar.stretch(path.state()) <= .3);
  CHECK(largest <= Bar::limit_load + 1e-8);
  CHECK(largest >= .99 * Bar::limit_load);
}

TEST_CASE("the length of a step is the root mean square of its displacement")
{
  // The bar stays homogeneous: u = (stretch - 1) x, whose root mean square over the length is |u(L)| / sqrt(3). The
  // control points carry the masses int N_A dA, which is exact to the mesh size only: 4 elements.
  Bar       bar({}, Bar::pull(-1.));
  ArcLength path(bar.solver, bar.state, {.first_factor = .02, .wanted_iterations = 1000, .largest = 1.});
  path.advance();
  const double first = bar.stretch(path.state()) - 1.;
  CHECK(std::abs(first) == Approx(.02).epsilon(.05)); // E A = 1: the linear stretch is the load
  path.advance();
  CHECK(bar.stretch(path.state()) - 1. == Approx(2. * first).epsilon(1e-5));
}

TEST_CASE("supports that move and affine loads can be followed too")
{
  Supports supports;
  supports.prescribe("right", Component::x, [](double t) { return -Bar::length * (.1 + t); });
  Bar        bar(supports, {});
  const auto start = bar.solver.solve(bar.state, 0.);
  REQUIRE(start.state);
  ArcLength path(bar.solver, *start.state, {.first_factor = .05});
  for (int i = 0; i < 6; ++i)
    {
      path.advance();
      const double stretch = .9 - path.state().time;
      CHECK(bar.stretch(path.state()) == Approx(stretch).epsilon(1e-7));
      CHECK(bar.solver.reaction("right")[0] == Approx(Bar::force(stretch)).margin(1e-7));
    }
  CHECK(path.state().time > .25);
}

TEST_CASE("steps adapt to the iterations and shrink when the corrector fails")
{
  Truss     slow, fast;
  ArcLength short_steps(slow.solver, slow.state, {.first_factor = .1, .wanted_iterations = 1});
  ArcLength long_steps(fast.solver, fast.state, {.first_factor = .1, .wanted_iterations = 12});
  for (int i = 0; i < 5; ++i)
    {
      short_steps.advance();
      long_steps.advance();
    }
  CHECK(fast.height(long_steps.state()) < slow.height(short_steps.state()));

  // A first step far beyond the limit point, given few iterations, has to be halved.
  Truss     halved;
  ArcLength far(halved.solver, halved.state, {.first_factor = 20., .max_iterations = 3});
  far.advance();
  CHECK(far.state().time == Approx(Truss::load_factor(halved.height(far.state()))).margin(1e-5));
}

TEST_CASE("a path that cannot be followed ends with a message")
{
  Truss       truss({.tolerance = 1e-8});
  ArcLength   path(truss.solver, truss.state, {.first_factor = 1., .smallest = .5, .max_iterations = 1});
  std::string text;
  try
    {
      path.advance();
    }
  catch (const NoConvergence &error)
    {
      text = error.what();
    }
  CAPTURE(text);
  CHECK(text.find("arc length: no equilibrium beyond load factor 0") != std::string::npos);
  CHECK(text.find("did not converge in 1 iterations") != std::string::npos);
  CHECK(path.state().time == 0.);
}

TEST_CASE("a path along which the loads do not change is refused")
{
  Supports supports;
  supports.prescribe("right", Component::x, [](double) { return -.1 * Bar::length; });
  Bar        bar(supports, {});
  const auto start = bar.solver.solve(bar.state, 0.);
  REQUIRE(start.state);
  ArcLength path(bar.solver, *start.state, {.first_factor = .05});
  CHECK_THROWS_WITH(path.advance(), Catch::Contains("nothing moves when the load factor changes"));
}
