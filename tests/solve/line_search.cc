#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "koiter_body.h"

#include <sherd/solve/line_search.h>

using namespace sherd;

namespace
{
/// Counts the calls of a slope.
template <class Slope>
struct Counted
{
  Slope       slope;
  mutable int calls = 0;
  double      operator()(double t) const
  {
    ++calls;
    return slope(t);
  }
};
template <class Slope>
Counted(Slope) -> Counted<Slope>;
} // namespace

TEST_CASE("a full step with a small slope is taken at once")
{
  const Counted slope{[](double t) { return 1. - .5 * t; }};
  CHECK(search_line(1., slope, {.max_trials = 5, .slope = .6}) == 1.);
  CHECK(slope.calls == 1);
}

TEST_CASE("without trials the step is always full")
{
  const Counted slope{[](double t) { return 1. - 10. * t; }};
  CHECK(search_line(1., slope, {.max_trials = 0}) == 1.);
  CHECK(slope.calls <= 1);
}

TEST_CASE("the root of a linear slope is found in one trial")
{
  const Counted slope{[](double t) { return 3. * (1. - t / .3); }};
  CHECK(search_line(3., slope, {.max_trials = 5, .slope = .1}) == Approx(.3).epsilon(1e-14));
  CHECK(slope.calls == 2);
}

TEST_CASE("a curved slope is reduced as far as asked")
{
  // Roots 0.2, 1/3 and 0.7; plain regula falsi keeps one end of each and crawls.
  const auto s0    = [](double t) { return 1. - std::pow(t / .2, 5); };
  const auto s1    = [](double t) { return std::exp(-9. * t) - std::exp(-3.); };
  const auto s2    = [](double t) { return -std::cos(M_PI / 1.4 * t); };
  const auto check = [](double root, const auto &s, double tolerance) {
    const Counted slope{s};
    const double  t = search_line(s(0.), slope, {.max_trials = 25, .slope = 1e-3, .shortest = .01});
    INFO("root " << root << ", " << slope.calls << " slopes");
    CHECK(std::abs(s(t)) <= 1e-3 * std::abs(s(0.)));
    CHECK(t == Approx(root).epsilon(tolerance));
    CHECK(slope.calls <= 20);
  };
  check(.2, s0, 1e-3);
  check(1. / 3., s1, 3e-3); // |s'| = 0.45 at the root
  check(.7, s2, 1e-3);
}

TEST_CASE("trials are limited and the best length is taken")
{
  const Counted slope{[](double t) { return 1. - std::pow(t / .2, 5); }};
  const double  t = search_line(1., slope, {.max_trials = 2, .slope = 1e-6, .shortest = .1});
  CHECK(slope.calls == 3);
  CHECK(std::abs(slope.slope(t)) <= 1.);
}

TEST_CASE("lengths stay above the shortest")
{
  CHECK(search_line(1., [](double t) { return 1. - 100. * t; }, {.max_trials = 8, .slope = .1, .shortest = .25}) ==
        .25);
}

TEST_CASE("a slope that keeps its sign calls for the full step")
{
  const Counted slope{[](double t) { return 1. + t; }};
  CHECK(search_line(1., slope, {.max_trials = 5, .slope = .5}) == 1.);
  CHECK(slope.calls == 1);
}

TEST_CASE("lengths without a finite slope are left")
{
  const auto   nan   = std::numeric_limits<double>::quiet_NaN();
  const auto   slope = [nan](double t) { return t > .3 ? nan : 1. - t / .2; };
  const double t     = search_line(1., slope, {.max_trials = 10, .slope = .1});
  CHECK(t == Approx(.2).epsilon(.02)); // s <= 0.1 there
  CHECK(search_line(1., [nan](double) { return nan; }, {.max_trials = 3}) >= .1);
}
