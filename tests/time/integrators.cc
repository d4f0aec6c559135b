#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <sherd/time/any_integrator.h>
#include <sherd/time/backward_euler.h>
#include <sherd/time/bathe.h>
#include <sherd/time/central_difference.h>
#include <sherd/time/generalized_alpha.h>
#include <sherd/time/hht.h>
#include <sherd/time/implicit_midpoint.h>
#include <sherd/time/newmark.h>
#include <sherd/time/quasi_static.h>
#include <sherd/time/update.h>
#include <sherd/time/wbz.h>

using namespace sherd;

namespace
{

/// The stage of a scheme that has one.
template <class Integrator>
Stage only_stage(const Integrator &integrator, double dt, double previous_dt)
{
  const auto stages = integrator.stages(dt, previous_dt);
  REQUIRE(stages.size() == 1);
  return stages.front();
}

/// The update formulas of Newmark's family.
void check_weights(const Stage &s)
{
  CHECK(s.start.x_of_x == 1.);
  CHECK(s.start.x_of_v == 1.);
  CHECK(s.start.x_of_a == .5 - s.beta);
  CHECK(s.start.v_of_v == 1.);
  CHECK(s.start.v_of_a == 1. - s.gamma);
  for (const double w : {s.before.x_of_x, s.before.x_of_v, s.before.x_of_a, s.before.v_of_v, s.before.v_of_a})
    CHECK(w == 0.);
}

struct Row
{
  double parameter, alpha_m, alpha_f, gamma, beta;
};

void check_constants(const Stage &s, const Row &row)
{
  CHECK(s.dt == .3);
  CHECK(s.alpha_m == Approx(row.alpha_m).epsilon(1e-14));
  CHECK(s.alpha_f == Approx(row.alpha_f).epsilon(1e-14));
  CHECK(s.gamma == Approx(row.gamma).epsilon(1e-14));
  CHECK(s.beta == Approx(row.beta).epsilon(1e-14));
  CHECK(s.mass_weight() == Approx(row.alpha_m / (row.alpha_f * row.beta * .09)).epsilon(1e-14));
  check_weights(s);
}

/// A motion of four values, all different.
Motion some_motion(double shift)
{
  const auto d =
      std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0, 1}, std::vector<std::int64_t>{});
  Motion m{Vector(d, 2), Vector(d, 2), Vector(d, 2)};
  for (int i = 0; i < 4; ++i)
    {
      m.position.local()[i]     = 1. + i + .1 * shift;
      m.velocity.local()[i]     = -.3 * i + .1 - shift;
      m.acceleration.local()[i] = .7 * i * i - 1. + .5 * shift;
    }
  return m;
}

} // namespace

TEST_CASE("Constants of generalized-alpha are those of its table")
{
  // theory F: (2 - rho)/(1 + rho), 1/(1 + rho), 1/2 + alpha_m - alpha_f, (1 + alpha_m - alpha_f)^2 / 4
  const auto row = GENERATE(Row{0., 2., 1., 1.5, 1.}, Row{.5, 1., 2. / 3., 5. / 6., 4. / 9.},
                            Row{.8, 2. / 3., 5. / 9., 11. / 18., 25. / 81.}, Row{1., .5, .5, .5, .25});
  check_constants(only_stage(PlainGeneralizedAlpha(row.parameter), .3, .3), row);
  check_constants(only_stage(PlainGeneralizedAlpha(row.parameter), .3, .1), row);
  check_constants(only_stage(GeneralizedAlpha(row.parameter), .3, .3), row);
}

TEST_CASE("Constants of HHT are those of its table")
{
  const auto row =
      GENERATE(Row{0., 1., 1., .5, .25}, Row{-.1, 1., .9, .6, .3025}, Row{-1. / 3., 1., 2. / 3., 5. / 6., 4. / 9.});
  check_constants(only_stage(PlainHHT(row.parameter), .3, .3), row);
  check_constants(only_stage(PlainHHT(row.parameter), .3, .1), row);
  check_constants(only_stage(HHT(row.parameter), .3, .3), row);
}

TEST_CASE("Constants of WBZ are those of its table")
{
  // alpha_B = (rho - 1)/(rho + 1): 1 - alpha_B, 1, 1/2 - alpha_B, (1 - alpha_B)^2 / 4
  const auto row = GENERATE(Row{0., 2., 1., 1.5, 1.}, Row{.5, 4. / 3., 1., 5. / 6., 4. / 9.}, Row{1., 1., 1., .5, .25});
  check_constants(only_stage(PlainWBZ(row.parameter), .3, .3), row);
  check_constants(only_stage(PlainWBZ(row.parameter), .3, .1), row);
  check_constants(only_stage(WBZ(row.parameter), .3, .3), row);
}

TEST_CASE("Constants of the family after a change of the step size")
{
  // rho = 1/2: delta = -1/3; sigma = 2: D = 5/6, delta/sigma = -1/6.
  const Stage s = only_stage(GeneralizedAlpha(.5), .2, .1);
  CHECK(s.alpha_f == Approx(2. / 3.));
  CHECK(s.alpha_m == Approx(1.));
  CHECK(s.gamma == Approx(.8));
  CHECK(s.beta == Approx(.4225));
  check_weights(s);

  // rho = 0: delta = -1; sigma = 1/5: D = 5, delta/sigma = -5.
  const Stage t = only_stage(GeneralizedAlpha(0.), .02, .1);
  CHECK(t.alpha_f == Approx(1.));
  CHECK(t.alpha_m == Approx(1.2));
  CHECK(t.gamma == Approx(1.1));
  CHECK(t.beta == Approx(.64));

  // HHT, alpha = -1/4: delta = alpha; sigma = 2: D = 7/8, delta/sigma = -1/8.
  const Stage h = only_stage(HHT(-.25), .2, .1);
  CHECK(h.alpha_f == Approx(.75));
  CHECK(h.alpha_m == Approx(1.));
  CHECK(h.gamma == Approx(5. / 7.));

  // WBZ, rho = 1/2: delta = -1/3 again, alpha_f = 1.
  const Stage w = only_stage(WBZ(.5), .2, .1);
  CHECK(w.alpha_f == Approx(1.));
  CHECK(w.alpha_m == Approx(1.4));
  CHECK(w.gamma == Approx(.8));

  // rho = 1 does not depend on the past.
  for (const Stage &u : {only_stage(GeneralizedAlpha(1.), .02, .1), only_stage(ImplicitMidpoint(), .02, .1)})
    {
      CHECK(u.alpha_m == Approx(.5));
      CHECK(u.alpha_f == Approx(.5));
      CHECK(u.gamma == Approx(.5));
      CHECK(u.beta == Approx(.25));
    }
}

TEST_CASE("Newmark's scheme is generalized-alpha without shifted levels")
{
  const Stage s = only_stage(Newmark(.3025, .6), .5, .1);
  CHECK(s.dt == .5);
  CHECK(s.alpha_m == 1.);
  CHECK(s.alpha_f == 1.);
  CHECK(s.gamma == .6);
  CHECK(s.beta == .3025);
  check_weights(s);
  CHECK(only_stage(Newmark(), 1., 1.).beta == .25);
  CHECK(only_stage(Newmark(), 1., 1.).gamma == .5);
}

TEST_CASE("Both stages of Bathe's scheme have the same weight of the mass at its default split")
{
  const auto stages = Bathe().stages(.3, .1);
  REQUIRE(stages.size() == 2);
  CHECK(stages[0].dt == Approx((2. - std::sqrt(2.)) * .3).epsilon(1e-15));
  CHECK(stages[1].dt == .3);
  CHECK(stages[0].mass_weight() == Approx(stages[1].mass_weight()).epsilon(1e-14));
}

TEST_CASE("An integrator chosen at run time has the stages of the one it was made from")
{
  const auto same = [](const Stages &a, const Stages &b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      {
        CHECK(a[k].dt == b[k].dt);
        CHECK(a[k].alpha_m == b[k].alpha_m);
        CHECK(a[k].alpha_f == b[k].alpha_f);
        CHECK(a[k].gamma == b[k].gamma);
        CHECK(a[k].beta == b[k].beta);
        CHECK(a[k].before.x_of_x == b[k].before.x_of_x);
      }
  };
  AnyIntegrator any = GeneralizedAlpha(.3);
  same(any.stages(.2, .1), GeneralizedAlpha(.3).stages(.2, .1));
  any = Bathe(.5);
  same(any.stages(.2, .1), Bathe(.5).stages(.2, .1));
  const AnyIntegrator copy = any;
  same(copy.stages(.2, .1), any.stages(.2, .1));
  STATIC_REQUIRE(!std::is_constructible_v<AnyIntegrator, CentralDifference>);
}

TEST_CASE("Integrators refuse parameters without a stable scheme")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double rho : {-1e-12, 1.0000001, -1., nan})
    {
      CHECK_THROWS_AS(GeneralizedAlpha(rho), InvalidParameter);
      CHECK_THROWS_AS(PlainGeneralizedAlpha(rho), InvalidParameter);
      CHECK_THROWS_AS(WBZ(rho), InvalidParameter);
      CHECK_THROWS_AS(PlainWBZ(rho), InvalidParameter);
    }
  for (const double damping : {-1e-12, 1., 2., nan})
    CHECK_THROWS_AS(CentralDifference(damping), InvalidParameter);
  for (const double alpha : {1e-12, -.34, -1., nan})
    {
      CHECK_THROWS_AS(HHT(alpha), InvalidParameter);
      CHECK_THROWS_AS(PlainHHT(alpha), InvalidParameter);
    }
  for (const double split : {0., 1., -1., nan})
    CHECK_THROWS_AS(Bathe(split), InvalidParameter);
  CHECK_THROWS_AS(Newmark(.25, .49), InvalidParameter);
  CHECK_THROWS_AS(Newmark(.2, .5), InvalidParameter);
  CHECK_THROWS_AS(Newmark(nan, .5), InvalidParameter);
  CHECK_THROWS_AS(Newmark(.25, nan), InvalidParameter);
  CHECK_THROWS_WITH(GeneralizedAlpha(1.5), Catch::Contains("1.5") && Catch::Contains("[0, 1]"));
  CHECK_THROWS_WITH(WBZ(1.5), Catch::Contains("WBZ") && Catch::Contains("[0, 1]"));
  CHECK_THROWS_WITH(HHT(.1), Catch::Contains("HHT") && Catch::Contains("[-1/3, 0]"));
  CHECK_THROWS_WITH(Bathe(2.), Catch::Contains("Bathe") && Catch::Contains("(0, 1)"));
}

TEST_CASE("The predictor keeps the velocity and obeys the update formulas")
{
  const auto   stages = GENERATE(GeneralizedAlpha(.3).stages(.2, .5), BackwardEuler().stages(.2, .5),
                                 Bathe(.4).stages(.2, .5), CentralDifference().stages(.2, .5));
  const Motion start  = some_motion(0.);
  Motion       before = start;
  for (const Stage &stage : stages)
    {
      const auto predicted = predict(stage, start, before);
      auto       moved     = predicted;
      for (int i = 0; i < 4; ++i)
        if (stage.beta > 0.)
          move(stage, moved, i, .01 * (i + 1));
        else
          accelerate(stage, moved, i, 3. * i);
      const auto  &s = stage.start, &b = stage.before;
      const double dt = stage.dt;
      CHECK(s.x_of_x + b.x_of_x == Approx(1.).epsilon(1e-15));
      CHECK(s.v_of_v + b.v_of_v == Approx(1.).epsilon(1e-15));
      for (int i = 0; i < 4; ++i)
        {
          const auto known = [i](const Motion &m) {
            return std::array{m.position.local()[i], m.velocity.local()[i], m.acceleration.local()[i]};
          };
          const auto [x0, v0, a0] = known(start);
          const auto [x1, v1, a1] = known(before);
          const double X          = s.x_of_x * x0 + b.x_of_x * x1 + dt * (s.x_of_v * v0 + b.x_of_v * v1) +
                           dt * dt * (s.x_of_a * a0 + b.x_of_a * a1);
          const double V = s.v_of_v * v0 + b.v_of_v * v1 + dt * (s.v_of_a * a0 + b.v_of_a * a1);
          for (const Motion *next : {&predicted, static_cast<const Motion *>(&moved)})
            {
              const auto [x, v, a] = known(*next);
              CHECK(x == Approx(X + stage.beta * dt * dt * a).margin(1e-13));
              CHECK(v == Approx(V + stage.gamma * dt * a).margin(1e-13));
            }
          CHECK(predicted.velocity.local()[i] == v1);
        }
      before = some_motion(1.);
    }
}
