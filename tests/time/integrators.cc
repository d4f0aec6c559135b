// label: verification
#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

#include <Eigen/Dense>

#include <sherd/time/generalized_alpha.h>
#include <sherd/time/newmark.h>

#include "one_point.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

using Pattern = std::vector<double>;

/// Sizes of the steps of one cycle. The last one is what paper Eq. (13) does: growth by 1.5, a fifth at a refinement.
const Pattern constant  = {1.};
const Pattern alternate = {1., 1.5, .5};
const Pattern sawtooth  = {1., 1.5, 2.25, 3.375, 5.0625, 1.0125};

/// @p n_cycles of the pattern, scaled to end at t = 2.
Pattern steps(const Pattern &pattern, int n_cycles)
{
  double sum = 0.;
  for (const double s : pattern)
    sum += s;
  Pattern sizes;
  for (int c = 0; c < n_cycles; ++c)
    for (const double s : pattern)
      sizes.push_back(2. * s / (sum * n_cycles));
  return sizes;
}

/// Error of position, velocity at t = 2 of a damped, forced oscillator, against a fine classical Runge-Kutta solution.
template <class Integrator>
double error(const Integrator &integrator, const Pattern &sizes)
{
  const Oscillator  oscillator{4., .1, 3.};
  static const auto exact = [&] {
    double       x = 1., v = -.5, t = 0.;
    const int    n = 20000;
    const double h = 2. / n;
    for (int i = 0; i < n; ++i, t = i * h)
      {
        const double k1 = v, l1 = oscillator.force(x, v, t);
        const double k2 = v + h / 2 * l1, l2 = oscillator.force(x + h / 2 * k1, v + h / 2 * l1, t + h / 2);
        const double k3 = v + h / 2 * l2, l3 = oscillator.force(x + h / 2 * k2, v + h / 2 * l2, t + h / 2);
        const double k4 = v + h * l3, l4 = oscillator.force(x + h * k3, v + h * l3, t + h);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
      }
    return std::pair(x, v);
  }();
  const auto end = oscillator.run(integrator, sizes, 1., -.5);
  return std::hypot(end.position.local()[0] - exact.first, end.velocity.local()[0] - exact.second);
}

/// Observed order from two resolutions of the same pattern.
template <class Integrator>
double order(const Integrator &integrator, const Pattern &pattern, int n_cycles)
{
  return std::log2(error(integrator, steps(pattern, n_cycles)) / error(integrator, steps(pattern, 2 * n_cycles)));
}

/// Amplification of (x, v dt, a dt^2) of the undamped oscillator in one step: three runs from the unit vectors.
Eigen::Matrix3d amplification(const Stage &stage, double omega2)
{
  const auto d =
      std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0}, std::vector<std::int64_t>{});
  Eigen::Matrix3d A;
  const double    scale[3] = {1., stage.dt, stage.dt * stage.dt};
  for (int k = 0; k < 3; ++k)
    {
      Motion  old{Vector(d, 1), Vector(d, 1), Vector(d, 1)};
      Vector *unit[3]        = {&old.position, &old.velocity, &old.acceleration};
      unit[k]->local()[0]    = 1. / scale[k];
      const auto   next      = Oscillator{omega2}.step(stage, old, 0.);
      const double values[3] = {next.position.local()[0], next.velocity.local()[0], next.acceleration.local()[0]};
      for (int i = 0; i < 3; ++i)
        A(i, k) = values[i] * scale[i];
    }
  return A;
}

double spectral_radius(const Eigen::Matrix3d &A)
{
  return A.eigenvalues().cwiseAbs().maxCoeff();
}

} // namespace

TEST_CASE("Constants of generalized-alpha are those of its table")
{
  struct Row
  {
    double rho, alpha_m, alpha_f, gamma, beta;
  };
  // theory F: (2 - rho)/(1 + rho), 1/(1 + rho), 1/2 + alpha_m - alpha_f, (1 + alpha_m - alpha_f)^2 / 4
  const auto row   = GENERATE(Row{0., 2., 1., 1.5, 1.}, Row{.5, 1., 2. / 3., 5. / 6., 4. / 9.},
                              Row{.8, 2. / 3., 5. / 9., 11. / 18., 25. / 81.}, Row{1., .5, .5, .5, .25});
  const auto check = [&](const Stage &s) {
    CHECK(s.dt == .3);
    CHECK(s.alpha_m == Approx(row.alpha_m).epsilon(1e-14));
    CHECK(s.alpha_f == Approx(row.alpha_f).epsilon(1e-14));
    CHECK(s.gamma == Approx(row.gamma).epsilon(1e-14));
    CHECK(s.beta == Approx(row.beta).epsilon(1e-14));
    CHECK(s.mass_weight() == Approx(row.alpha_m / (row.alpha_f * row.beta * .09)).epsilon(1e-14));
  };
  check(PlainGeneralizedAlpha(row.rho).stage(.3, .3));
  check(PlainGeneralizedAlpha(row.rho).stage(.3, .1));
  check(GeneralizedAlpha(row.rho).stage(.3, .3));
}

TEST_CASE("Constants of generalized-alpha after a change of the step size")
{
  // rho = 1/2: delta = -1/3; sigma = 2: D = 5/6, delta/sigma = -1/6.
  const Stage s = GeneralizedAlpha(.5).stage(.2, .1);
  CHECK(s.alpha_f == Approx(2. / 3.));
  CHECK(s.alpha_m == Approx(1.));
  CHECK(s.gamma == Approx(.8));
  CHECK(s.beta == Approx(.4225));

  // rho = 0: delta = -1; sigma = 1/5: D = 5, delta/sigma = -5.
  const Stage t = GeneralizedAlpha(0.).stage(.02, .1);
  CHECK(t.alpha_f == Approx(1.));
  CHECK(t.alpha_m == Approx(1.2));
  CHECK(t.gamma == Approx(1.1));
  CHECK(t.beta == Approx(.64));

  // rho = 1 does not depend on the past.
  const Stage u = GeneralizedAlpha(1.).stage(.02, .1);
  CHECK(u.alpha_m == Approx(.5));
  CHECK(u.gamma == Approx(.5));
  CHECK(u.beta == Approx(.25));
}

TEST_CASE("Newmark's scheme is generalized-alpha without shifted levels")
{
  const Stage s = Newmark(.3025, .6).stage(.5, .1);
  CHECK(s.dt == .5);
  CHECK(s.alpha_m == 1.);
  CHECK(s.alpha_f == 1.);
  CHECK(s.gamma == .6);
  CHECK(s.beta == .3025);
  CHECK(Newmark().stage(1., 1.).beta == .25);
  CHECK(Newmark().stage(1., 1.).gamma == .5);
}

TEST_CASE("Integrators refuse parameters without a stable scheme")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double rho : {-1e-12, 1.0000001, -1., nan})
    {
      CHECK_THROWS_AS(GeneralizedAlpha(rho), InvalidParameter);
      CHECK_THROWS_AS(PlainGeneralizedAlpha(rho), InvalidParameter);
    }
  CHECK_THROWS_AS(Newmark(.25, .49), InvalidParameter);
  CHECK_THROWS_AS(Newmark(.2, .5), InvalidParameter);
  CHECK_THROWS_AS(Newmark(nan, .5), InvalidParameter);
  CHECK_THROWS_AS(Newmark(.25, nan), InvalidParameter);
  CHECK_THROWS_WITH(GeneralizedAlpha(1.5), Catch::Contains("1.5") && Catch::Contains("[0, 1]"));
}

TEST_CASE("The predictor keeps the velocity and obeys the update formulas")
{
  const auto d =
      std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0, 1}, std::vector<std::int64_t>{});
  Motion old{Vector(d, 2), Vector(d, 2), Vector(d, 2)};
  for (int i = 0; i < 4; ++i)
    {
      old.position.local()[i]     = 1. + i;
      old.velocity.local()[i]     = -.3 * i + .1;
      old.acceleration.local()[i] = .7 * i * i - 1.;
    }
  const Stage stage     = GeneralizedAlpha(.3).stage(.2, .5);
  const auto  predicted = predict(stage, old);
  auto        moved     = predicted;
  for (int i = 0; i < 4; ++i)
    move(stage, moved, i, .01 * (i + 1));
  // Both obey x_{n+1} = x_n + dt v_n + dt^2 [(1/2 - beta) a_n + beta a_{n+1}] and the same for v.
  for (const Motion *next : {&predicted, static_cast<const Motion *>(&moved)})
    for (int i = 0; i < 4; ++i)
      {
        const double x = old.position.local()[i], v = old.velocity.local()[i], a = old.acceleration.local()[i];
        const double a1 = next->acceleration.local()[i];
        CHECK(next->position.local()[i] ==
              Approx(x + .2 * v + .04 * ((.5 - stage.beta) * a + stage.beta * a1)).margin(1e-13));
        CHECK(next->velocity.local()[i] == Approx(v + .2 * ((1. - stage.gamma) * a + stage.gamma * a1)).margin(1e-13));
      }
  for (int i = 0; i < 4; ++i)
    CHECK(predicted.velocity.local()[i] == old.velocity.local()[i]);
}

TEST_CASE("Rates keep their digits however small the step is")
{
  // x = 1 has an absolute precision of 1e-16; divided by dt^2 = 1e-20 the difference x_{n+1} - x_n would say nothing.
  const Oscillator oscillator{.omega2 = 1.};
  const double     dt  = 1e-10;
  const auto       end = oscillator.run(GeneralizedAlpha(.5), std::vector<double>(5, dt), 1., .5);
  CHECK(end.acceleration.local()[0] == Approx(-1.).epsilon(1e-8));
  CHECK(end.velocity.local()[0] == Approx(.5 - 5. * dt).epsilon(1e-14));
}

TEST_CASE("Motion under constant acceleration is exact, whatever the steps do")
{
  const double rho   = GENERATE(0., .5, 1.);
  const auto   sizes = steps(sawtooth, 3);
  const auto   d =
      std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0}, std::vector<std::int64_t>{});
  Motion m{Vector(d, 1), Vector(d, 1), Vector(d, 1)};
  m.velocity.local()[0]     = -.5;
  m.acceleration.local()[0] = 1.;
  double previous = sizes[0], t = 0.;
  for (const double dt : sizes)
    {
      const auto stage = GeneralizedAlpha(rho).stage(dt, previous);
      Motion     next  = predict(stage, m);
      // a_{n+1} = 1 balances a constant force; x from the update formula.
      const double x =
          m.position.local()[0] + dt * m.velocity.local()[0] + dt * dt * ((.5 - stage.beta) * 1. + stage.beta * 1.);
      move(stage, next, 0, x - next.position.local()[0]);
      m = next;
      t += dt;
      previous = dt;
    }
  CHECK(m.position.local()[0] == Approx(-.5 * t + .5 * t * t).margin(1e-12));
  CHECK(m.velocity.local()[0] == Approx(-.5 + t).margin(1e-12));
}

TEST_CASE("Generalized-alpha is of second order under constant and under changing steps")
{
  const double rho     = GENERATE(0., .5, .8, 1.);
  const auto   pattern = GENERATE(constant, alternate, sawtooth);
  CAPTURE(rho, pattern);
  const int n = pattern.size() == 1 ? 320 : pattern.size() == 3 ? 100 : 60;
  CHECK(order(GeneralizedAlpha(rho), pattern, n) == Approx(2.).margin(.05));
}

TEST_CASE("Constants that ignore the change of the step fall towards first order")
{
  const double rho     = GENERATE(0., .5, .8);
  const auto   pattern = GENERATE(alternate, sawtooth);
  CAPTURE(rho, pattern);
  // At rho = 0.8 the first-order part is small and shows on fine steps only.
  const int n = rho > .7 ? 2000 : 400;
  CHECK(order(PlainGeneralizedAlpha(rho), pattern, n) < 1.3);
  CHECK(order(PlainGeneralizedAlpha(rho), constant, 320) == Approx(2.).margin(.05));
  const auto sizes = steps(pattern, n);
  CHECK(error(GeneralizedAlpha(rho), sizes) < .2 * error(PlainGeneralizedAlpha(rho), sizes));
}

TEST_CASE("Newmark: the trapezoidal rule is of second order, damping makes it first")
{
  const auto pattern = GENERATE(constant, alternate, sawtooth);
  CAPTURE(pattern);
  const int n = pattern.size() == 1 ? 640 : 200;
  CHECK(order(Newmark(), pattern, n) == Approx(2.).margin(.05));
  CHECK(order(Newmark(.3025, .6), pattern, 4 * n) == Approx(1.).margin(.1));
}

TEST_CASE("Spectral radius at high frequency is rho_inf")
{
  const double rho = GENERATE(0., .3, .5, .8, 1.);
  CAPTURE(rho);
  const Stage stage = GeneralizedAlpha(rho).stage(1., 1.);
  // Three eigenvalues meet there: the distance falls with the cube root of 1/(omega dt)^2.
  CHECK(spectral_radius(amplification(stage, 1e12)) == Approx(rho).margin(5e-4));
  CHECK(spectral_radius(amplification(stage, 1e-6)) == Approx(1.).margin(1e-8));
}

TEST_CASE("No frequency grows over a cycle of changing steps")
{
  const double rho     = GENERATE(0., .5, .8, 1.);
  const auto   pattern = GENERATE(alternate, sawtooth);
  CAPTURE(rho, pattern);
  const auto sizes = steps(pattern, 1);
  for (double omega2 = 1e-4; omega2 < 1e8; omega2 *= 3.)
    {
      Eigen::Matrix3d A        = Eigen::Matrix3d::Identity();
      double          previous = sizes.back();
      for (const double dt : sizes)
        {
          // amplification() works in units of its own step; change those of (v, a) at every change of the step.
          Eigen::Matrix3d units = Eigen::Matrix3d::Identity();
          units(1, 1)           = dt / previous;
          units(2, 2)           = units(1, 1) * units(1, 1);
          A                     = amplification(GeneralizedAlpha(rho).stage(dt, previous), omega2) * units * A;
          previous              = dt;
        }
      CAPTURE(omega2);
      CHECK(spectral_radius(A) < 1. + 1e-4);
    }
}
