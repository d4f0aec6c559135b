// label: verification
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include <Eigen/Dense>

#include <sherd/time/any_integrator.h>
#include <sherd/time/backward_euler.h>
#include <sherd/time/bathe.h>
#include <sherd/time/central_difference.h>
#include <sherd/time/generalized_alpha.h>
#include <sherd/time/hht.h>
#include <sherd/time/implicit_midpoint.h>
#include <sherd/time/newmark.h>
#include <sherd/time/wbz.h>

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

/// Error of position, velocity at t = 2 of an oscillator, against a fine classical Runge-Kutta solution.
template <class Integrator>
double error(const Oscillator &oscillator, const Integrator &integrator, const Pattern &sizes)
{
  static std::vector<std::pair<double, std::pair<double, double>>> known; // by damping
  auto exact = std::find_if(known.begin(), known.end(), [&](const auto &e) { return e.first == oscillator.damping; });
  if (exact == known.end())
    {
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
      exact = known.insert(known.end(), {oscillator.damping, {x, v}});
    }
  const auto end = oscillator.run(integrator, sizes, 1., -.5);
  return std::hypot(end.position.local()[0] - exact->second.first, end.velocity.local()[0] - exact->second.second);
}

const Oscillator damped{4., .1, 3.};
const Oscillator undamped{4., 0., 3.};

/// Observed order from two resolutions of the same pattern.
template <class Integrator>
double order(const Integrator &integrator, const Pattern &pattern, int n_cycles, const Oscillator &oscillator = damped)
{
  return std::log2(error(oscillator, integrator, steps(pattern, n_cycles)) /
                   error(oscillator, integrator, steps(pattern, 2 * n_cycles)));
}

/// Amplification of (x, v dt, a dt^2) of the undamped oscillator in one step: three runs from the unit vectors.
Eigen::Matrix3d amplification(const Stages &stages, double omega2)
{
  const auto d =
      std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0}, std::vector<std::int64_t>{});
  Eigen::Matrix3d A;
  const double    dt       = stages.back().dt;
  const double    scale[3] = {1., dt, dt * dt};
  for (int k = 0; k < 3; ++k)
    {
      Motion  old{Vector(d, 1), Vector(d, 1), Vector(d, 1)};
      Vector *unit[3]        = {&old.position, &old.velocity, &old.acceleration};
      unit[k]->local()[0]    = 1. / scale[k];
      const auto   next      = Oscillator{omega2}.step(stages, old, 0.);
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

/// A scheme with what the table of theory F says of it.
struct Row
{
  std::string   name;
  AnyIntegrator integrator;
  double        rho_inf;
};

std::vector<Row> second_order()
{
  std::vector<Row> rows;
  for (const double rho : {0., .25, .5, .8, 1.})
    rows.push_back({"generalized-alpha " + std::to_string(rho), GeneralizedAlpha(rho), rho});
  for (const double alpha : {0., -.05, -.1, -1. / 3.})
    rows.push_back({"HHT " + std::to_string(alpha), HHT(alpha), (1. + alpha) / (1. - alpha)});
  for (const double rho : {0., .5, .8, 1.})
    rows.push_back({"WBZ " + std::to_string(rho), WBZ(rho), rho});
  rows.push_back({"trapezoidal rule", Newmark(), 1.});
  rows.push_back({"midpoint", ImplicitMidpoint(), 1.});
  rows.push_back({"Bathe", Bathe(), 0.});
  rows.push_back({"Bathe 1/2", Bathe(.5), 0.});
  return rows;
}

} // namespace

TEST_CASE("Rates keep their digits however small the step is")
{
  // x = 1 has an absolute precision of 1e-16; divided by dt^2 = 1e-20 the difference x_{n+1} - x_n would say nothing.
  const Oscillator oscillator{.omega2 = 1.};
  const double     dt = 1e-10;
  for (const AnyIntegrator &integrator :
       {AnyIntegrator(GeneralizedAlpha(.5)), AnyIntegrator(HHT(-.1)), AnyIntegrator(BackwardEuler())})
    {
      const auto end = oscillator.run(integrator, std::vector<double>(5, dt), 1., .5);
      CHECK(end.acceleration.local()[0] == Approx(-1.).epsilon(1e-8));
      CHECK(end.velocity.local()[0] == Approx(.5 - 5. * dt).epsilon(1e-14));
    }
}

TEST_CASE("Motion under constant acceleration is exact, whatever the steps do")
{
  const Oscillator falling{.omega2 = 0., .gravity = 1.};
  const auto       sizes = steps(sawtooth, 3);
  for (const auto &row : second_order())
    {
      CAPTURE(row.name);
      const auto end = falling.run(row.integrator, sizes, .3, -.5);
      CHECK(end.position.local()[0] == Approx(.3 - .5 * 2. + .5 * 4.).margin(1e-12));
      CHECK(end.velocity.local()[0] == Approx(-.5 + 2.).margin(1e-12));
    }
}

TEST_CASE("The schemes of second order keep it under changing steps")
{
  const auto pattern = GENERATE(constant, alternate, sawtooth);
  const int  n       = pattern.size() == 1 ? 320 : pattern.size() == 3 ? 100 : 60;
  for (const auto &row : second_order())
    {
      CAPTURE(row.name, pattern);
      CHECK(order(row.integrator, pattern, n) == Approx(2.).margin(.05));
    }
}

TEST_CASE("Constants that ignore the change of the step fall towards first order")
{
  struct Pair
  {
    std::string   name;
    AnyIntegrator plain, full;
    int           n; ///< where little is shifted, the first-order part is small and shows on fine steps only
  };
  const Pair pairs[] = {{"generalized-alpha 0", PlainGeneralizedAlpha(0.), GeneralizedAlpha(0.), 400},
                        {"generalized-alpha .5", PlainGeneralizedAlpha(.5), GeneralizedAlpha(.5), 400},
                        {"generalized-alpha .8", PlainGeneralizedAlpha(.8), GeneralizedAlpha(.8), 2000},
                        {"HHT -.1", PlainHHT(-.1), HHT(-.1), 2000},
                        {"HHT -1/3", PlainHHT(-1. / 3.), HHT(-1. / 3.), 400},
                        {"WBZ 0", PlainWBZ(0.), WBZ(0.), 400},
                        {"WBZ .5", PlainWBZ(.5), WBZ(.5), 400}};
  for (const auto &pair : pairs)
    for (const auto &pattern : {alternate, sawtooth})
      {
        CAPTURE(pair.name, pattern);
        CHECK(order(pair.plain, pattern, pair.n) < 1.3);
        CHECK(order(pair.plain, constant, 320) == Approx(2.).margin(.05));
        const auto sizes = steps(pattern, pair.n);
        CHECK(error(damped, pair.full, sizes) < .2 * error(damped, pair.plain, sizes));
      }
}

TEST_CASE("Backward Euler and a damping Newmark scheme are of first order")
{
  const auto pattern = GENERATE(constant, alternate, sawtooth);
  CAPTURE(pattern);
  const int n = pattern.size() == 1 ? 2560 : 800;
  CHECK(order(Newmark(.3025, .6), pattern, n) == Approx(1.).margin(.1));
  CHECK(order(BackwardEuler(), pattern, n) == Approx(1.).margin(.03));
}

TEST_CASE("Central differences are of second order without damping, up to twice the inverse of the frequency")
{
  const auto pattern = GENERATE(constant, alternate, sawtooth);
  CAPTURE(pattern);
  CHECK(order(CentralDifference(), pattern, pattern.size() == 1 ? 320 : 60, undamped) == Approx(2.).margin(.05));
  const auto stages = CentralDifference().stages(1., 1.);
  for (const double omega : {.1, 1., 1.9, 1.9999})
    CHECK(spectral_radius(amplification(stages, omega * omega)) == Approx(1.).margin(1e-7));
  CHECK(spectral_radius(amplification(stages, 2.001 * 2.001)) > 1.05);
}

TEST_CASE("Central differences with damping are stable up to their largest step")
{
  // x and the velocity half a step before: a_n = -x_n - 2 xi v_{n-1/2}, omega = 1.
  for (const double xi : {0., .05, .3, .9})
    {
      CAPTURE(xi);
      const CentralDifference scheme(xi);
      const double            b      = scheme.stiffness_factor(1.);
      const auto              radius = [&](double dt) {
        Eigen::Matrix2d A;
        A << 1. - dt * dt, dt * (1. - b * dt), -dt, 1. - b * dt;
        return A.eigenvalues().cwiseAbs().maxCoeff();
      };
      CHECK(b == 2. * xi);
      CHECK(scheme.stiffness_factor(0.) == 0.); // nothing is free to vibrate
      CHECK(radius(.999 * scheme.largest_step(1.)) < 1. + 1e-12);
      CHECK(radius(1.01 * scheme.largest_step(1.)) > 1.01);
      // A slow motion, a hundredth of the largest frequency, loses xi / 100 of critical damping.
      CHECK(std::log(radius(1e-3)) == Approx(-xi * 1e-3).epsilon(1e-2).margin(1e-12));
    }
}

TEST_CASE("Spectral radius at high frequency is rho_inf")
{
  // Eigenvalues meet there: their distance falls with the cube root of 1/(omega dt)^2.
  for (const auto &row : second_order())
    {
      CAPTURE(row.name);
      CHECK(spectral_radius(amplification(row.integrator.stages(1., 1.), 1e12)) == Approx(row.rho_inf).margin(5e-4));
      CHECK(spectral_radius(amplification(row.integrator.stages(1., 1.), 1e-6)) == Approx(1.).margin(1e-8));
    }
  CHECK(spectral_radius(amplification(BackwardEuler().stages(1., 1.), 1e12)) == Approx(0.).margin(5e-4));
}

TEST_CASE("Schemes without dissipation keep the energy of an oscillator, others lose some")
{
  const Oscillator oscillator{.omega2 = 4.};
  const auto       energy = [&](const AnyIntegrator &integrator, const Pattern &sizes) {
    const auto end = oscillator.run(integrator, sizes, 1., -.5);
    return .5 * (std::pow(end.velocity.local()[0], 2) + 4. * std::pow(end.position.local()[0], 2));
  };
  const double start = .5 * (.25 + 4.);
  const auto   sizes = steps(sawtooth, 10);
  for (const auto &row : second_order())
    {
      CAPTURE(row.name);
      if (row.rho_inf == 1.)
        CHECK(energy(row.integrator, sizes) == Approx(start).epsilon(1e-12));
      else
        CHECK(energy(row.integrator, steps(constant, 20)) < start * (1. - 1e-6));
    }
  CHECK(energy(BackwardEuler(), sizes) < .9 * start);
}

TEST_CASE("No frequency grows over a cycle of changing steps")
{
  const auto pattern = GENERATE(alternate, sawtooth);
  const auto sizes   = steps(pattern, 1);
  for (const auto &row : second_order())
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
            A                     = amplification(row.integrator.stages(dt, previous), omega2) * units * A;
            previous              = dt;
          }
        CAPTURE(row.name, pattern, omega2);
        CHECK(spectral_radius(A) < 1. + 1e-4);
      }
}

TEST_CASE("The estimate of the local error is the local error to leading order")
{
  // From (x_n, v_n) the oscillator goes to x cos + v sin; a few steps before let generalized-alpha find its a_n.
  const Oscillator oscillator{.omega2 = 4.};
  const auto       ratio = [&](const auto &integrator, double dt) {
    const auto sizes = Pattern(8, dt);
    const auto old   = oscillator.run(integrator, sizes, 1., -.5),
               next  = oscillator.step(integrator.stages(dt, dt), old, 0.);
    const double x = old.position.local()[0], v = old.velocity.local()[0];
    const double error = next.position.local()[0] - (x * std::cos(2. * dt) + .5 * v * std::sin(2. * dt));
    return displacement_error(old, next, dt, 0) / error;
  };
  for (const auto &row : second_order())
    {
      CAPTURE(row.name);
      CHECK(ratio(row.integrator, .01) == Approx(1.).margin(.1));
      CHECK(ratio(row.integrator, .0025) == Approx(1.).margin(.025));
    }
  CHECK(ratio(BackwardEuler(), .0025) == Approx(1.).margin(.025));
  CHECK(ratio(CentralDifference(), .0025) == Approx(1.).margin(.025));
}

namespace
{

/// Where the phase of a brittle oscillator is solved for (theory F.1).
enum class PhaseAt
{
  level, ///< of the balance: option A
  end    ///< of the step, while momentum is balanced at the level: option D
};

/// x(2) of x'' + phi^2 x = 0 with a phase that has no rate, phi = 1 / (1 + x^2): where phi^2 x^2 + (1 - phi)^2 is
/// least.
double brittle_oscillator(const GeneralizedAlpha &integrator, PhaseAt phase_at, int n)
{
  const auto d =
      std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0}, std::vector<std::int64_t>{});
  const auto force = [](double x, double x_phase) { return -std::pow(1. / (1. + x_phase * x_phase), 2) * x; };
  Motion     m{Vector(d, 1), Vector(d, 1), Vector(d, 1)};
  m.position.local()[0]     = 1.;
  m.velocity.local()[0]     = .5;
  m.acceleration.local()[0] = force(1., 1.);
  for (int i = 0; i < n; ++i)
    {
      const Stage stage = integrator.stages(2. / n, 2. / n).front();
      Motion      next  = predict(stage, m, m);
      const auto  r     = [&] {
        const double x = interpolate(stage.alpha_f, m.position, next.position).local()[0];
        return interpolate(stage.alpha_m, m.acceleration, next.acceleration).local()[0] -
               force(x, phase_at == PhaseAt::level ? x : next.position.local()[0]);
      };
      double dx = stage.dt * stage.dt, before = r();
      for (int k = 0; k < 30 && std::abs(dx) > 1e-15; ++k)
        {
          move(stage, next, 0, dx);
          const double after = r();
          const double slope = (after - before) / dx;
          before             = after;
          dx                 = slope != 0. ? -after / slope : 0.;
        }
      m = next;
    }
  return m.position.local()[0];
}

} // namespace

TEST_CASE("Momentum and phase have to be balanced in one configuration")
{
  const double rho   = GENERATE(.5, .8, 1.);
  const auto   order = [&](PhaseAt phase_at) {
    const double a = brittle_oscillator(GeneralizedAlpha(rho), phase_at, 100),
                 b = brittle_oscillator(GeneralizedAlpha(rho), phase_at, 200),
                 c = brittle_oscillator(GeneralizedAlpha(rho), phase_at, 400);
    return std::log2((a - b) / (b - c));
  };
  CAPTURE(rho);
  CHECK(order(PhaseAt::level) == Approx(2.).margin(.1));
  CHECK(order(PhaseAt::end) == Approx(1.).margin(.1));
}
