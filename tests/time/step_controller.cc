#include <catch2/catch.hpp>

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
}
