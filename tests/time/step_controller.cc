#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <sherd/time/step_controller.h>

using namespace sherd;

namespace
{

/// A controller whose step is 1 and whose bound is @p largest.
StepController controller(double largest, double initial = 1.)
{
  StepController result(StepControlSettings{.initial = initial});
  result.bound(.6 * largest / .99, 1.);
  return result;
}

} // namespace

TEST_CASE("Factors of paper Eq. (13)")
{
  struct Row
  {
    int    newton;
    double factor;
  };
  const auto row = GENERATE(Row{0, 1.5}, Row{1, 1.5}, Row{3, 1.5}, Row{4, 1.1}, Row{5, .5}, Row{12, .5});
  auto       c   = controller(100.);
  c.accept(row.newton);
  CHECK(c.step() == Approx(row.factor).epsilon(1e-14));
  c.accept(row.newton);
  CHECK(c.step() == Approx(row.factor * row.factor).epsilon(1e-14));
}

TEST_CASE("A refinement reduces the step to a fifth")
{
  auto c = controller(100.);
  c.refine();
  CHECK(c.step() == Approx(.2).epsilon(1e-14));
}

TEST_CASE("The step stays below dt_max = 0.99 dx_min / (0.6 c_R)")
{
  StepController c(StepControlSettings{.initial = 1e-3});
  c.bound(.00125, 5.6821); // theory F.3, obstacle data: 3.67e-4 without the factor
  CHECK(c.largest() == Approx(.99 * 3.6665e-4).epsilon(1e-4));
  CHECK(c.step() == c.largest());
  c.accept(2);
  CHECK(c.step() == c.largest());
  c.bound(.00125 / 2., 5.6821);
  CHECK(c.step() == Approx(.5 * .99 * 3.6665e-4).epsilon(1e-4));
  c.bound(.00125, 5.6821);
  CHECK(c.step() < .6 * c.largest());
}

TEST_CASE("Rejections halve the step, then take a fifth; an accepted step forgets them")
{
  auto c = controller(100.);
  c.reject("test");
  CHECK(c.step() == Approx(.5).epsilon(1e-14));
  c.reject("test");
  CHECK(c.step() == Approx(.1).epsilon(1e-14));
  c.reject("test");
  CHECK(c.step() == Approx(.02).epsilon(1e-14));
  c.accept(4);
  CHECK(c.step() == Approx(.022).epsilon(1e-14));
  c.reject("test");
  CHECK(c.step() == Approx(.011).epsilon(1e-14));
}

TEST_CASE("Below the smallest step the run ends with the reason")
{
  auto c = controller(2.);
  int  n = 0;
  try
    {
      for (; n < 100; ++n)
        c.reject("the residual is not finite");
      FAIL("the step size never ended");
    }
  catch (const NoConvergence &error)
    {
      CHECK_THAT(error.what(), Catch::Contains("the residual is not finite"));
      // The share of the bound that was reached is a small number, not a rounded zero.
      CHECK_THAT(error.what(), !Catch::Contains("0.000000"));
    }
  // 1/2 * 1/2 * (1/5)^k < 1e-8 first for k = 11.
  CHECK(n == 11);
  // A checkpoint of now goes on with the step there was before the rejections.
  CHECK(c.step() == 1.);
  c.reject("test");
  CHECK(c.step() == .5);
}

TEST_CASE("A restored controller goes on alike")
{
  auto a = controller(2.);
  a.reject("test");
  a.accept(3);
  StepController b(StepControlSettings{.initial = 77.});
  b.restore(a.state());
  for (const int newton : {3, 5, 4})
    {
      a.reject("test");
      b.reject("test");
      CHECK(b.step() == a.step());
      a.accept(newton);
      b.accept(newton);
      CHECK(b.step() == a.step());
    }
  CHECK(b.largest() == a.largest());
}

TEST_CASE("Without a bound the smallest step follows the first one")
{
  StepController c(StepControlSettings{.initial = 1e-6});
  CHECK_NOTHROW(c.reject("test"));
  CHECK(c.step() == Approx(5e-7));
}

TEST_CASE("A rejection starts from the step that was attempted")
{
  // The step that was cut to end in time failed: half of that, not half of what would have been taken.
  auto         c  = controller(100., 50.);
  const double dt = c.step_within(2.);
  CHECK(dt == 2.);
  c.reject("test", dt);
  CHECK(c.step() == Approx(1.));
}

TEST_CASE("Steps end exactly where they should and leave no tiny one")
{
  auto c = controller(100.);
  CHECK(c.step_within(5.) == 1.);
  CHECK(c.step_within(1.) == 1.);
  CHECK(c.step_within(.3) == .3);
  CHECK(c.step_within(1. + 1e-12) == 1. + 1e-12);
  CHECK(c.step_within(1.2) == .6);
  CHECK(c.step_within(1.9999) == Approx(.99995));
  CHECK(c.step_within(2.) == 1.);

  std::mt19937                           random(7);
  std::uniform_real_distribution<double> size(.01, 1.);
  for (int k = 0; k < 200; ++k)
    {
      auto         d    = controller(100., size(random));
      const double end  = 3. * size(random);
      double       time = 0., smallest = 1., first = d.step();
      int          n = 0;
      while (time < end)
        {
          const double dt = d.step_within(end - time);
          smallest        = std::min(smallest, dt);
          time            = dt == end - time ? end : time + dt;
          ++n;
        }
      CHECK(time == end);
      CHECK(smallest >= std::min(.499 * first, end));
      CHECK(n <= static_cast<int>(end / first) + 2);
    }
}

TEST_CASE("Given times are hit exactly, whatever the step, and no step is tiny")
{
  std::mt19937                           random(11);
  std::uniform_real_distribution<double> size(.01, 1.);
  for (int k = 0; k < 100; ++k)
    {
      StepControlSettings settings{.initial = .3 * size(random)};
      for (int i = 0; i < 5; ++i)
        settings.times.push_back(4. * size(random));
      StepController c(settings);
      c.bound(.6 * settings.initial / .99, 1.); // the largest step is the first one
      std::vector<double> even;
      for (int i = 1; i < 7; ++i)
        even.push_back(3. / 7. * i);
      c.stop_at(even);
      c.stop_at(even); // known already
      const double        end     = 3.;
      std::vector<double> missing = even;
      for (const double time : settings.times)
        if (time < end)
          missing.push_back(time);
      std::sort(missing.begin(), missing.end());
      double shortest_gap = end;
      for (std::size_t i = 0; i < missing.size(); ++i)
        shortest_gap = std::min(shortest_gap, (i + 1 < missing.size() ? missing[i + 1] : end) - missing[i]);
      double time = 0., smallest = 1.;
      int    n = 0;
      while (time < end)
        {
          const double stop = c.next_stop(time, end), remaining = stop - time, dt = c.step_within(remaining);
          smallest = std::min(smallest, dt);
          time     = dt == remaining ? stop : time + dt;
          std::erase(missing, time);
          c.accept(2, 0., dt);
          ++n;
        }
      CHECK(time == end);
      CHECK(missing.empty());
      CHECK(smallest >= .499 * std::min(settings.initial, shortest_gap));
      CHECK(n <= static_cast<int>(end / settings.initial) + 2 * 12);
    }
}

TEST_CASE("Times that differ by rounding are one, and one at the end is the end")
{
  auto c = controller(100.);
  c.stop_at({.3, .1 + .2, 2., std::nextafter(5., 6.)});
  CHECK(c.next_stop(0., 5.) == .3);
  CHECK(c.next_stop(.3, 5.) == 2.);
  CHECK(c.next_stop(2., 5.) == 5.);
  CHECK(c.next_stop(0., .2) == .2);
  CHECK_THROWS_AS(c.stop_at({std::numeric_limits<double>::infinity()}), InvalidParameter);
}

TEST_CASE("A step that was shortened to end in time does not let the next ones grow")
{
  auto c = controller(100.);
  c.accept(2, 0., .4);
  CHECK(c.step() == 1.);
  c.accept(7, 0., .4); // so many iterations even for less
  CHECK(c.step() == Approx(.2));
  c.accept(2, 0., .2);
  CHECK(c.step() == Approx(.3));
}

TEST_CASE("Fixed steps come back after rejections and refinements")
{
  StepController c(StepControlSettings{.initial = 1., .rule = StepRule::fixed});
  c.accept(9);
  CHECK(c.step() == 1.);
  c.refine();
  CHECK(c.step() == 1.);
  c.reject("test");
  CHECK(c.step() == .5);
  c.accept(3);
  CHECK(c.step() == 1.);
  c.bound(.6 * .25 / .99, 1.);
  CHECK(c.step() == Approx(.25));
  c.accept(3);
  CHECK(c.step() == Approx(.25));
  CHECK_FALSE(c.is_inaccurate(1e9));
}

TEST_CASE("An explicit scheme limits the step without changing what comes after")
{
  auto c = controller(100.);
  c.limit(.1);
  CHECK(c.step() == .1);
  CHECK(c.step_within(.05) == .05);
  c.accept(1, 0., .1);
  CHECK(c.step() == .1);
  c.reject("test", .1);
  CHECK(c.step() == Approx(.05));
  c.accept(1);
  c.limit(std::numeric_limits<double>::infinity());
  CHECK(c.step() == Approx(.075));
}

TEST_CASE("Steps do not grow beyond a cap, and shrink from there at once")
{
  auto c = controller(100.);
  c.cap(.1);
  CHECK(c.step() == .1);
  for (int i = 0; i < 50; ++i)
    c.accept(1);
  CHECK(c.step() == .1);
  CHECK(c.largest() == .1);
  c.accept(6);
  CHECK(c.step() < .1);
  c.bound(1e3, 1.); // a mesh that would allow longer steps
  CHECK(c.largest() == .1);
}

TEST_CASE("Steps by error keep the error of a step at its tolerance")
{
  // A scheme of second order with an error that changes slowly in time: e = C(t) dt^3.
  const StepControlSettings settings{.initial = 1e-3, .rule = StepRule::error, .tolerance = 1e-4};
  StepController            c(settings);
  const auto                error = [](double t, double dt) { return (2. + std::sin(t)) * dt * dt * dt; };
  double                    time = 0., worst = 0., least = 1.;
  int                       rejected = 0, n = 0;
  while (time < 20.)
    {
      const double dt = c.step(), e = error(time, dt);
      if (c.is_inaccurate(e))
        {
          c.reject_inaccurate(e, dt);
          CHECK(c.step() < dt);
          ++rejected;
          continue;
        }
      c.accept(1, e, dt);
      CHECK(c.step() <= 1.5 * dt * (1. + 1e-14));
      time += dt;
      if (++n > 20)
        {
          worst = std::max(worst, e);
          least = std::min(least, e);
        }
    }
  CHECK(worst <= settings.tolerance);
  CHECK(least > .5 * settings.tolerance);
  CHECK(rejected <= 2);
}

TEST_CASE("A step that is too inaccurate is repeated with the one that should meet four fifths of the tolerance")
{
  StepController c(StepControlSettings{.initial = 1., .rule = StepRule::error, .tolerance = 1e-4});
  c.reject_inaccurate(2e-4, 1.);
  CHECK(c.step() == Approx(std::cbrt(.4)));
  c.reject_inaccurate(1e4, c.step());
  CHECK(c.step() == Approx(.2 * std::cbrt(.4)));
}

TEST_CASE("The error of a step that was shortened is no trend")
{
  StepController c(StepControlSettings{.initial = 1., .rule = StepRule::error, .tolerance = 1e-4});
  const double   settled = 8e-5;
  const auto     error   = [=](double dt) { return settled * dt * dt * dt; };
  c.accept(1, error(1.), 1.);
  CHECK(c.step() == Approx(1.));
  c.accept(1, error(.1), .1); // to end at a given time
  CHECK(c.step() == Approx(1.));
  c.accept(1, error(1.), 1.);
  CHECK(c.step() == Approx(1.));
}

TEST_CASE("An error that no step can mend ends the run")
{
  StepController c(StepControlSettings{.initial = 1., .rule = StepRule::error});
  CHECK(c.is_inaccurate(std::numeric_limits<double>::quiet_NaN()));
  const auto run = [&] {
    for (int n = 0; n < 100; ++n)
      c.reject_inaccurate(n % 2 ? std::numeric_limits<double>::quiet_NaN() : .5, c.step());
  };
  CHECK_THROWS_WITH(run(), Catch::Contains("estimated error") && Catch::Contains("tolerance"));
  CHECK(c.step() == 1.);
}

TEST_CASE("The rule is chosen by name")
{
  StepControlSettings settings;
  const auto          section = ParameterSection::of(settings);
  bool                found   = false;
  for (const auto &entry : section.entries())
    if (name(entry) == "rule")
      {
        std::get<Parameter>(entry).read({"error", {}});
        found = true;
      }
  CHECK(found);
  CHECK(settings.rule == StepRule::error);
}

TEST_CASE("Step control refuses settings that do not make sense")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(StepController(StepControlSettings{}), InvalidParameter);
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = -1.}), InvalidParameter);
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = nan}), InvalidParameter);
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = 1., .few = 0.}), InvalidParameter);
  // A retry of the same size would fail in the same way for ever.
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = 1., .rejected = 1.}), InvalidParameter);
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = 1., .rejected_again = 1.}), InvalidParameter);
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = 1., .tolerance = 0.}), InvalidParameter);
  CHECK_THROWS_AS(StepController(StepControlSettings{.initial = 1., .times = {nan}}), InvalidParameter);
}
