#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/fracture/crack_density/any.h>
#include <sherd/fracture/degradation/any.h>
#include <sherd/fracture/irreversibility/any.h>

using namespace sherd;

TEST_CASE("policies chosen at run time: a degradation function is the one chosen, with its residual")
{
  const auto check = [](const auto &g) {
    const degradation::Any          plain(g), stiff(g, .1);
    const degradation::WithResidual expected(g, .1);
    for (const double phi : {-.05, 0., .3, .9, 1., 1.05})
      {
        CHECK(plain.value(phi) == g.value(phi));
        CHECK(plain.first(phi) == g.first(phi));
        CHECK(plain.second(phi) == g.second(phi));
        CHECK(stiff.value(phi) == expected.value(phi));
        CHECK(stiff.first(phi) == expected.first(phi));
        CHECK(stiff.second(phi) == expected.second(phi));
      }
    CHECK(stiff.residual() == .1);
  };
  check(degradation::Cubic(.2));
  check(degradation::Quadratic{});
  check(degradation::Quartic(.3));
  check(degradation::Rational(3., .2));
  CHECK_THROWS_AS(degradation::Any(degradation::Cubic(), 1.), InvalidParameter);
}

TEST_CASE("policies chosen at run time: a crack density is the one chosen")
{
  const auto check = [](const auto &density) {
    const crack_density::Any any(density);
    for (const double x : {.1, .5, .999, 1., 3.})
      {
        CHECK(any.local(x) == density.local(x));
        CHECK(any.local_first(x) == density.local_first(x));
        CHECK(any.local_second(x) == density.local_second(x));
        CHECK(any.c1(x) == density.c1(x));
        CHECK(any.c2(x) == density.c2(x));
        CHECK(any.profile(x) == density.profile(x));
      }
  };
  check(crack_density::FourthOrder{});
  check(crack_density::SecondOrder{});
  check(crack_density::AT1(.02));
}

TEST_CASE("policies chosen at run time: an irreversibility is the one chosen")
{
  const auto check = [](const auto &policy) {
    const irreversibility::Any any(policy);
    for (const double memory : {0., .4, .8})
      for (const double x : {.1, .5, .9})
        {
          CHECK(any.trial(memory, x) == policy.trial(memory, x));
          CHECK(any.is_loading(memory, x) == policy.is_loading(memory, x));
          CHECK(any.resistance(memory, x) == policy.resistance(memory, x));
          CHECK(any.resistance_stiffness(memory, x) == policy.resistance_stiffness(memory, x));
          CHECK(any.commit(memory, .7, x) == policy.commit(memory, .7, x));
          CHECK(any.initial(memory, x) == policy.initial(memory, x));
        }
  };
  check(irreversibility::History{});
  check(irreversibility::Penalty(100.));
  check(irreversibility::None{});
}
