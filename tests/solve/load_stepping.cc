// ranks: 1 2
#include <catch2/catch.hpp>

#include "koiter_body.h"

using namespace sherd;
using namespace sherd::test;

namespace
{
/// Load factors and iterations of the steps of a run.
struct Steps
{
  std::vector<double> factors;
  std::vector<int>    iterations;

  auto observer()
  {
    return [this](const State<2, 3> &state, int n) {
      factors.push_back(state.time);
      iterations.push_back(n);
    };
  }
};

Supports ends_move(std::function<double(double)> displacement)
{
  Supports supports;
  supports.prescribe("right", Component::x, std::move(displacement));
  return supports;
}

/// The text of the exception that @p call throws.
template <class Exception, class Call>
std::string message(const Call &call)
{
  try
    {
      call();
    }
  catch (const Exception &error)
    {
      return error.what();
    }
  return "nothing thrown";
}
} // namespace

TEST_CASE("a bar in tension follows its exact law, and steps are bounded and end where they shall")
{
  Bar              bar({}, Bar::pull(2.));
  Steps            steps;
  LoadStepSettings settings{.first = .01, .largest = .3, .wanted_iterations = 20};
  const auto       observe = steps.observer();
  const auto       end     = follow_loads(bar.solver, bar.state, 1., settings, [&](const State<2, 3> &state, int n) {
    observe(state, n);
    // Newton stops at 1e-8 of the load.
    CHECK(Bar::force(bar.stretch(state)) == Approx(2. * state.time).epsilon(1e-7));
  });
  CHECK(end.time == 1.);
  CHECK(end.step == static_cast<int>(steps.factors.size()));
  CHECK(steps.factors.front() == .01);
  double previous = 0., step = 0.;
  for (const double factor : steps.factors)
    {
      CHECK(factor > previous);
      CHECK(factor - previous <= .3 * (1. + 1e-12));
      if (step > 0.)
        CHECK(factor - previous <= 1.5 * step * (1. + 1e-12));
      step     = factor - previous;
      previous = factor;
    }

  // Back to rest.
  const auto rest = follow_loads(bar.solver, end, 0., {.first = 1., .largest = .25}, [](const auto &, int) {});
  CHECK(rest.time == 0.);
  CHECK(bar.stretch(rest) == Approx(1.).margin(1e-7));
}

TEST_CASE("a first step longer than the largest is cut")
{
  Bar   bar({}, Bar::pull(.5));
  Steps steps;
  follow_loads(bar.solver, bar.state, 1., {.first = 1., .largest = .25}, steps.observer());
  CHECK(steps.factors.front() == .25);
}

TEST_CASE("steps shrink where Newton takes long and grow where it does not")
{
  Bar   slow({}, Bar::pull(2.)), fast({}, Bar::pull(2.));
  Steps few, many;
  follow_loads(slow.solver, slow.state, 1., {.first = .05, .largest = 1., .wanted_iterations = 2}, many.observer());
  follow_loads(fast.solver, fast.state, 1., {.first = .05, .largest = 1., .wanted_iterations = 20}, few.observer());
  CHECK(many.factors[1] - many.factors[0] < .05);
  CHECK(few.factors[1] - few.factors[0] == Approx(.075));
  CHECK(few.factors.size() < many.factors.size());
}

TEST_CASE("a limit point ends load control with a message that says so")
{
  // Few iterations, so that Newton does not find the bar turned inside out, which carries any load.
  Bar        bar({}, Bar::pull(-1.), {.max_iterations = 6});
  Steps      steps;
  const auto run = [&] { follow_loads(bar.solver, bar.state, 1., {.first = .05, .smallest = 1e-4}, steps.observer()); };
  const auto text = message<NoConvergence>(run);
  CAPTURE(text);
  CHECK(text.find("limit point") != std::string::npos);
  CHECK(text.find("arc length") != std::string::npos);
  CHECK(text.find("6 Newton iterations") != std::string::npos);
  REQUIRE_FALSE(steps.factors.empty());
  CHECK(steps.factors.back() <= Bar::limit_load);
  CHECK(steps.factors.back() >= Bar::limit_load - 2e-3);
}

TEST_CASE("a truss that snaps is found on the other side")
{
  Truss        truss;
  const double limit = Truss::load_factor(Truss::rise / std::sqrt(3.));
  const auto   end   = follow_loads(truss.solver, truss.state, 1.2 * limit, {.first = .2, .largest = .2},
                                    [&](const State<2, 3> &state, int) {
                                  CHECK(Truss::load_factor(truss.height(state)) == Approx(state.time).epsilon(1e-6));
                                });
  CHECK(truss.height(end) < -Truss::rise);
}

TEST_CASE("supports that move take a bar through its limit point, and their reaction is the force of the bar")
{
  Bar bar(ends_move([](double t) { return -.7 * Bar::length * t; }), {});
  follow_loads(bar.solver, bar.state, 1., {.first = .1, .largest = .1}, [&](const State<2, 3> &state, int) {
    const double stretch = 1. - .7 * state.time;
    CHECK(bar.stretch(state) == Approx(stretch).epsilon(1e-9));
    CHECK(bar.solver.reaction("right")[0] == Approx(Bar::force(stretch)).margin(1e-8));
    CHECK(bar.solver.reaction("left")[0] == Approx(-Bar::force(stretch)).margin(1e-8));
  });
}

TEST_CASE("affine loads and supports need not vanish at factor zero")
{
  Loads<3> loads;
  loads.traction("right", [](const Point<3> &, double t) { return Point<3>(.1 + .4 * t, 0., 0.); });
  Bar        bar({}, loads);
  const auto start = bar.solver.solve(bar.state, 0.);
  REQUIRE(start.state);
  CHECK(Bar::force(bar.stretch(*start.state)) == Approx(.1).epsilon(1e-7));
  const auto end = follow_loads(bar.solver, *start.state, .5, {}, [](const auto &, int) {});
  CHECK(Bar::force(bar.stretch(end)) == Approx(.3).epsilon(1e-7));

  Bar        moved(ends_move([](double t) { return .4 + .8 * t; }), {});
  const auto first = moved.solver.solve(moved.state, 0.);
  REQUIRE(first.state);
  CHECK(moved.stretch(*first.state) == Approx(1.1).epsilon(1e-9));
}

TEST_CASE("loads and supports that are not affine in the factor are refused")
{
  Loads<3> loads;
  loads.traction("right", [](const Point<3> &, double t) { return Point<3>(t * t, 0., 0.); });
  const auto loaded = message<InvalidParameter>([&] { Bar({}, loads); });
  CAPTURE(loaded);
  CHECK(loaded.find("loads that are not affine") != std::string::npos);

  Loads<3> blown;
  blown.pressure([](const Point<3> &, double t) { return std::sqrt(t); }, PressureRelease::none);
  CHECK(message<InvalidParameter>([&] { Bar({}, blown); }).find("loads that are not affine") != std::string::npos);

  Loads<3> turned;
  turned.edge_moment("right", [](const Point<3> &, double t) { return std::sin(t); });
  CHECK(message<InvalidParameter>([&] { Bar({}, turned); }).find("loads that are not affine") != std::string::npos);

  const auto moved = message<InvalidParameter>([&] { Bar(ends_move([](double t) { return std::sin(t); }), {}); });
  CAPTURE(moved);
  CHECK(moved.find("supports that are not affine") != std::string::npos);
}

TEST_CASE("an iteration that fails says why and leaves the start alone")
{
  Bar        bar({}, Bar::pull(2.), {.max_iterations = 2});
  const auto result = bar.solver.solve(bar.state, 1.);
  CHECK_FALSE(result.state);
  CAPTURE(result.failure);
  CHECK(result.failure.find("no equilibrium in 2 Newton iterations") != std::string::npos);
  CHECK(result.residuals.size() == 2);
  CHECK(bar.stretch(bar.state) == 1.);

  Loads<3>      loads = Bar::pull(1.);
  Bar           free({}, loads);
  Supports      none;
  KoiterBody<2> loose(1., 0., 1., shapes::plate<2, 3>({1., 1.}, {1, 1}), none, loads);
  const auto    floating = loose.solver.solve(loose.state, 1.);
  CHECK_FALSE(floating.state);
  CHECK_FALSE(floating.failure.empty());
}

TEST_CASE("the line search changes the way to an equilibrium, not the equilibrium")
{
  Supports supports;
  supports.clamp("left");
  Loads<3> loads;
  loads.traction("right", [](const Point<3> &, double t) { return Point<3>(0., 0., 2. * t); });
  const auto    strip = shapes::plate<2, 3>({10., 1.}, {8, 1});
  KoiterBody<2> plain(1.2e6, 0., .1, strip, supports, loads);
  KoiterBody<2> searched(1.2e6, 0., .1, strip, supports, loads, {.line_search = {.max_trials = 5}});
  const auto    a = plain.solver.solve(plain.state, 1.), b = searched.solver.solve(searched.state, 1.);
  REQUIRE(a.state);
  REQUIRE(b.state);
  CHECK((plain.displacement(*a.state, 8., .5) - searched.displacement(*b.state, 8., .5)).norm() <= 1e-5);
  CHECK(a.residuals != b.residuals); // it was at work
}
