// label: verification
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <sherd/fracture/crack_density/second_order.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/fracture/homogeneous.h>
#include <sherd/fracture/irreversibility/none.h>

#include "body.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

using Healing = BrittleShell<2, 2, Split, degradation::Quadratic, crack_density::SecondOrder, irreversibility::None>;

const double bulk = Units().moduli().bulk;

/// Homogeneous body under the load Hbar = l0 H / Gc.
template <class Model>
void stretch(Body<Model> &body, double load)
{
  const double lambda = biaxial_stretch(load, bulk);
  body.deform([&](const Point<2> &X) { return Point<2>(lambda * X); });
}

/// The stable phase under a homogeneous load.
double stable_phase(double load)
{
  return homogeneous_phase(degradation::Cubic(), load, 1., 1.);
}

} // namespace

TEST_CASE("Homogeneous states lie on the curve of theory C.3")
{
  // One element has one field value; sixteen have many that should agree.
  const int                   n = GENERATE(1, 4);
  Body<Glass>                 cubic(Units().model(), {2., 2.}, {n, n}, tight());
  const std::array<double, 8> loads = {.02, .06, .083, .084, .0925987, .12, .3, 2.};
  for (const double load : loads)
    {
      CAPTURE(n, load);
      stretch(cubic, load);
      REQUIRE(cubic.peak_load() == Approx(load).epsilon(1e-9));
      cubic.solver.equilibrate_phase(cubic.state);
      CHECK(cubic.largest_phase() == Approx(stable_phase(load)).margin(1e-7));
      CHECK(cubic.smallest_phase() == Approx(stable_phase(load)).margin(1e-7));
    }

  // Peak stress: eps = 0.4303457 eps0 gives phi = 0.89984 and sigma = 0.4182543 sigma0.
  stretch(cubic, .5 * .4303457 * .4303457);
  cubic.solver.equilibrate_phase(cubic.state);
  const double phi = cubic.state.phase.local()[0];
  CHECK(phi == Approx(.89984).margin(2e-5));
  CHECK(degradation::Cubic().value(phi) * .4303457 == Approx(.4182543).margin(1e-6));
}

TEST_CASE("The quadratic function has one state for each load, also of second order")
{
  Body<Healing> body(Units().model<Healing>(), {2., 2.}, {3, 3}, tight());
  for (const double load : {1e-3, .5 / 6., 1., 30.})
    {
      stretch(body, load);
      body.solver.equilibrate_phase(body.state);
      CHECK(body.largest_phase() == Approx(1. / (1. + 4. * load)).epsilon(1e-7));
      CHECK(body.smallest_phase() == Approx(1. / (1. + 4. * load)).epsilon(1e-7));
      CHECK(body.is_stable());
    }
}

TEST_CASE("A load that jumps across the threshold ends on the stable branch")
{
  const std::array<int, 2> elements = GENERATE(std::array<int, 2>{1, 1}, std::array<int, 2>{12, 1});
  const auto               settings = GENERATE(NewtonSettings(), tight());
  // The distance to the root is the tolerance over the slope of the residual there, mu - 1 = 0.2 or more.
  const double margin = 10. * settings.phase_tolerance + 1e-8;
  Body<Glass>  body(Units().model(), {.5 * elements[0], .5}, elements, settings);
  for (const double load : {.168, .17, .2, .5, 1.})
    {
      CAPTURE(elements, settings.phase_tolerance, load);
      body.state.phase.fill(1.);
      stretch(body, .1);
      body.solver.equilibrate_phase(body.state);
      REQUIRE(body.largest_phase() == Approx(stable_phase(.1)).margin(margin));
      stretch(body, load);
      body.solver.equilibrate_phase(body.state);
      CHECK(body.largest_phase() == Approx(stable_phase(load)).margin(margin));
      CHECK(body.smallest_phase() == Approx(stable_phase(load)).margin(margin));
      CHECK(body.is_stable());
    }
}

TEST_CASE("Two hundred random jumps of the load never end on the false branch")
{
  Body<Glass>                            body(Units().model(), {4., .5}, {8, 1});
  std::mt19937                           random(42);
  std::uniform_real_distribution<double> exponent(std::log(.02), std::log(3.));
  int                                    given_up = 0;
  for (int k = 0; k < 200; ++k)
    {
      double before = std::exp(exponent(random)), after = std::exp(exponent(random));
      if (before > after)
        std::swap(before, after);
      CAPTURE(k, before, after);
      body.state.phase.fill(stable_phase(before));
      stretch(body, after);
      try
        {
          body.solver.equilibrate_phase(body.state);
          // phi depends on the load like 1/mu: 1e-5 over the slope mu - 1, which vanishes at the threshold 1/12.
          const double slope = std::max(std::abs(12. * after - 1.), .02);
          CHECK(body.largest_phase() == Approx(stable_phase(after)).margin(2e-5 / slope));
          CHECK(body.smallest_phase() == Approx(stable_phase(after)).margin(2e-5 / slope));
          CHECK(body.is_stable());
        }
      catch (const NoConvergence &)
        {
          ++given_up;
        }
    }
  CHECK(given_up == 0);
}

TEST_CASE("A load that is not homogeneous ends on the stable branch")
{
  Body<Glass>                            body(Units().model(), {8., 6.}, {16, 12});
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> phase(0., 2. * M_PI);
  int                                    given_up = 0, broken = 0;
  for (const double load : {.09, .1, .13, .168, .2, .35, .5, 1., 2.})
    {
      // A smooth field of biaxial stretch, scaled to the load at its highest point.
      const double a = phase(random), b = phase(random), c = phase(random);
      const auto   pull = [&](double size) {
        body.deform([&](const Point<2> &X) {
          return Point<2>(X[0] + size * (X[0] + 1.5 * std::sin(.6 * X[0] + a) * std::cos(.5 * X[1] + b)),
                          X[1] + size * (X[1] + 1.2 * std::cos(.4 * X[0] + c) * std::sin(.7 * X[1])));
        });
      };
      pull(1e-3);
      const double size = 1e-3 * std::sqrt(load / body.peak_load());
      pull(size);
      CAPTURE(load, body.peak_load());
      REQUIRE(body.peak_load() == Approx(load).epsilon(.1));
      body.state.phase.fill(1.);
      try
        {
          body.solver.equilibrate_phase(body.state);
          CHECK(body.is_stable());
          CHECK(body.largest_phase() < 1.01);
          CHECK(body.smallest_phase() > -.05);
          broken += body.smallest_phase() < .9;
        }
      catch (const NoConvergence &)
        {
          ++given_up;
        }
    }
  CHECK(given_up == 0);
  CHECK(broken >= 5);
}

TEST_CASE("The overshoot beside a pre-crack is sound")
{
  // h = 3 l0: so coarse that phi > 1 beside the crack, which is neither an error nor a false branch.
  Body<Glass> body(Units().model(), {72., 12.}, {24, 4});
  body.crack(PreCrack<2>({Segment<2>{{37.5, -30.}, {37.5, 90.}}}, 1.));
  body.solver.equilibrate_phase(body.state);
  const auto result = body.solver.attempt(body.state, 1e-3);
  REQUIRE(result.state);
  CHECK(body.smallest_phase() < 0.);
  CHECK(result.largest_phase > 1. + 1e-4);
  CHECK(result.switched == 0);
  CHECK(result.newton <= 1);
}

TEST_CASE("Values that are not finite are a failed attempt, not a crash")
{
  const double bad   = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const int    which = GENERATE(0, 1, 2, 3, 4);
  // H = infinity is a point that cannot carry anything; it is refused like the others.
  CAPTURE(bad, which);
  Body<Glass> body(Units().model(), {4., 4.}, {4, 4});
  Vector     *fields[] = {&body.state.position, &body.state.velocity, &body.state.acceleration, &body.state.phase};
  if (which < 4)
    fields[which]->local()[9] = bad;
  else
    body.state.history[3][2] = bad;
  const auto result = body.solver.attempt(body.state, 1e-3);
  CHECK_FALSE(result.state);
  CHECK_FALSE(result.failure.empty());
  if (which == 0 || which > 2)
    CHECK_THROWS_AS(body.solver.equilibrate_phase(body.state), NoConvergence);

  // The solver is as good as new afterwards.
  body.state = State<2, 2>(body.space);
  CHECK(body.solver.attempt(body.state, 1e-3).state);
}

TEST_CASE("A support that goes nowhere is a failed attempt")
{
  // One element: nothing but supported points, whose residual is not looked at.
  Supports supports;
  for (const auto &edge : {"left", "right", "bottom", "top"})
    for (const auto component : {Component::x, Component::y})
      supports.prescribe(edge, component, [](double) { return std::numeric_limits<double>::quiet_NaN(); });
  Body<Glass> body(Units().model(), {1., 1.}, {1, 1}, {}, supports);
  CHECK_FALSE(body.solver.attempt(body.state, 1e-3).state);
}

TEST_CASE("History keeps the damage when the load goes; without it cracks heal")
{
  // Every edge follows a triangular pulse of homogeneous stretch.
  const double peak = biaxial_stretch(.4, bulk) - 1., half = 1.;
  const auto   pulse = [&](double t) { return peak * (t < half ? t / half : std::max(0., 2. - t / half)); };
  Supports     supports;
  supports.fix("left", Component::x);
  supports.fix("bottom", Component::y);
  supports.prescribe("right", Component::x, pulse);
  supports.prescribe("top", Component::y, pulse);

  // Returns the phase at the peak and at the end.
  int        switched = 0;
  const auto run      = [&](auto &body) {
    std::array<double, 2> phases{};
    const int             n = 20;
    for (int i = 0; i < 2 * n; ++i)
      {
        auto result = body.solver.attempt(body.state, half / n);
        INFO(result.failure);
        REQUIRE(result.state);
        body.state = *result.state;
        switched += result.switched;
        if (i == n - 1)
          phases[0] = body.smallest_phase();
      }
    phases[1] = body.largest_phase();
    return phases;
  };
  Body<Glass> keeping(Units().model(), {1., 1.}, {2, 2}, {}, supports);
  const auto  kept = run(keeping);
  CHECK(kept[0] == Approx(stable_phase(.4)).margin(.02));
  CHECK(kept[1] == Approx(stable_phase(.4)).margin(.02));
  CHECK(kept[1] < kept[0] + 1e-3);
  // The load crosses the threshold in one step: without a switch of the branch it would not have been accepted.
  CHECK(switched >= 1);

  Body<Healing> forgetting(Units().model<Healing>(), {1., 1.}, {2, 2}, {}, supports);
  const auto    healed = run(forgetting);
  CHECK(healed[0] == Approx(1. / (1. + 4. * .4)).margin(.02));
  CHECK(healed[1] == Approx(1.).margin(1e-3));
}
