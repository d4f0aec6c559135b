// label: verification
#include <catch2/catch.hpp>

#include <sherd/fracture/branch.h>
#include <sherd/fracture/crack_density/at1.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/fracture/degradation/quartic.h>
#include <sherd/fracture/homogeneous.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace sherd;
using crack_density::AT1, crack_density::FourthOrder;
using degradation::Cubic, degradation::Quadratic, degradation::Quartic;

namespace
{
constexpr double Gc = .7, l0 = .02, stiffness = 50.; // E-bar of the uniaxial law Psi = E-bar eps^2 / 2

struct Peak
{
  double stress, strain, phi; ///< in the units sigma_0, eps_0 of theory C.3
};

/// Stress and strain of the homogeneous equilibrium at phase phi.
template <class Function, class Density = FourthOrder>
Peak equilibrium(const Function &g, const double phi, const Density &density = {})
{
  const double strain = std::sqrt(2. * homogeneous_history(g, density, phi, Gc, l0) / stiffness);
  return {g.value(phi) * stiffness * strain / std::sqrt(stiffness * Gc / l0), strain / std::sqrt(Gc / (l0 * stiffness)),
          phi};
}

/// Largest stress along the path from intact to broken: a scan, refined three times around its best point.
template <class Function, class Density = FourthOrder>
Peak peak(const Function &g, const Density &density = {})
{
  double low = 1e-3, high = 1. - 1e-9;
  Peak   best{0., 0., 0.};
  for (int level = 0; level < 4; ++level)
    {
      const double step = (high - low) / 1000;
      for (int i = 0; i <= 1000; ++i)
        if (const auto state = equilibrium(g, low + i * step, density); state.stress > best.stress)
          best = state;
      low  = std::max(1e-3, best.phi - 2. * step);
      high = std::min(1. - 1e-9, best.phi + 2. * step);
    }
  return best;
}

/// Newton's method on the homogeneous phase equation r = load g'(phi) + phi - 1, in units of Gc / (2 l0).
struct NewtonResult
{
  double phi;
  int    iterations;
};

NewtonResult newton(const double load, double phi, const std::function<double(double)> &tangent,
                    const double largest_step)
{
  const Cubic g;
  for (int iteration = 0; iteration < 200; ++iteration)
    {
      const double residual = load * g.first(phi) + phi - 1.;
      if (std::abs(residual) < 1e-14)
        return {phi, iteration};
      phi += std::clamp(-residual / tangent(phi), -largest_step, largest_step);
    }
  return {phi, 200};
}

/// 2 l0 H / Gc at mu = 12 l0 H / Gc.
double load_at(const double mu)
{
  return mu / 6.;
}

/// Driving energy at mu.
double history_at(const double mu)
{
  return mu * Gc / (12. * l0);
}
} // namespace

TEST_CASE("homogeneous state: phase and history are inverse to each other")
{
  const auto check = [](const auto &g) {
    for (const double phi : {1e-3, .1, .5, .9, .99})
      {
        const double history = homogeneous_history(g, phi, Gc, l0);
        CHECK(homogeneous_phase(g, history, Gc, l0) == Approx(phi).epsilon(1e-10));
      }
    CHECK(homogeneous_phase(g, 0., Gc, l0) == 1.);
  };
  check(Quadratic{});
  check(Cubic(1e-4));
  check(Cubic(.1));
  check(Cubic(1.));
}

TEST_CASE("homogeneous state: closed form for quadratic degradation")
{
  for (const double history : {.1, 1., 100.})
    CHECK(homogeneous_phase(Quadratic{}, history, Gc, l0) == Approx(1. / (1. + 4. * l0 * history / Gc)).epsilon(1e-14));
}

TEST_CASE("homogeneous state: onset of damage for cubic degradation")
{
  // s -> 0: intact below mu = 1, phi = 1 / mu above; s moves both by O(s / |mu - 1|).
  for (const double mu : {.5, .8})
    CHECK(homogeneous_phase(Cubic(1e-8), history_at(mu), Gc, l0) == Approx(1.).epsilon(1e-7));
  for (const double mu : {1.2, 2., 20.})
    CHECK(homogeneous_phase(Cubic(1e-8), history_at(mu), Gc, l0) == Approx(1. / mu).epsilon(1e-7));
}

TEST_CASE("homogeneous state: peak stresses of the table in theory C.3")
{
  // The strain and the phase of a maximum are found only to the root of the rounding of the stress.
  const auto check = [](const auto &g, const double stress, const double strain, const double phi,
                        const double digits_phi) {
    const Peak found = peak(g);
    INFO(found.stress << ' ' << found.strain << ' ' << found.phi);
    CHECK(std::abs(found.stress - stress) < 5.1e-8);
    CHECK(std::abs(found.strain - strain) < 1.5e-7);
    CHECK(std::abs(found.phi - phi) < digits_phi);
  };
  check(Quadratic{}, .2296397, .4082483, .75, 1e-6);
  check(Quadratic{}, 9. / (16. * std::sqrt(6.)), 1. / std::sqrt(6.), .75, 1e-6);
  check(Cubic(1e-4), .4182543, .4303457, .89984, 6e-6);
  check(Cubic(1e-2), .4157126, .4312901, .88732, 6e-6);
  check(Cubic(.1), .3991876, .4328640, .84248, 6e-6);
  check(Cubic(1.), .3069193, .4319023, .75572, 6e-6);
  check(Cubic(1e-9), 1.2 * std::pow(.9, 1.5) / std::sqrt(6.), 1. / std::sqrt(5.4), .9, 1e-6);
}

TEST_CASE("homogeneous state: peak stress of quartic degradation in theory C.3")
{
  const Peak found = peak(Quartic(1e-9));
  INFO(found.stress << ' ' << found.strain << ' ' << found.phi);
  CHECK(std::abs(found.stress - .3041187) < 5.1e-8);
  CHECK(std::abs(found.strain - .3247595) < 1.5e-7);
  CHECK(std::abs(found.phi - 8. / 9.) < 1e-6);
  // Onset at Gc / (24 l0), then phi = sqrt(Gc / (24 l0 Psi)).
  const double onset = branch::onset(Quartic(1e-9), Gc, l0);
  CHECK(onset == Approx(Gc / (24. * l0)).epsilon(1e-8));
  for (const double load : {1.2, 2., 20.})
    CHECK(homogeneous_phase(Quartic(1e-9), load * onset, Gc, l0) == Approx(1. / std::sqrt(load)).epsilon(1e-7));
}

TEST_CASE("homogeneous state: AT1 is elastic up to its peak, theory C.3")
{
  // Up to the width of the bound, within which both stress and strain lie.
  for (const double width : {1e-2, 1e-3, 1e-5})
    {
      const AT1  density(width);
      const Peak found = peak(Quadratic{}, density);
      INFO(found.stress << ' ' << found.strain << ' ' << found.phi);
      CHECK(std::abs(found.stress - std::sqrt(3. / 8)) < 2. * width);
      CHECK(std::abs(found.strain - std::sqrt(3. / 8)) < width);
      CHECK(std::abs(found.phi - 1.) < 1.5 * width);

      const double onset = 3. * Gc / (16. * l0);
      CHECK(homogeneous_phase(Quadratic{}, density, 0., Gc, l0) == 1.);
      CHECK(homogeneous_phase(Quadratic{}, density, .99 * onset, Gc, l0) >= 1. - width);
      for (const double load : {1.2, 2., 20.}) // then phi = onset / Psi
        CHECK(homogeneous_phase(Quadratic{}, density, load * onset, Gc, l0) == Approx(1. / load).epsilon(1e-12));
      CHECK(std::isinf(branch::onset(Quadratic{}, density, Gc, l0)));
    }
}

TEST_CASE("homogeneous state: strain grows all along the path, there is no snap-back")
{
  for (const double slope : {1e-4, 1e-2, .1, 1.})
    {
      double last = 0.;
      for (int i = 1; i < 1000; ++i)
        {
          const double strain = equilibrium(Cubic(slope), 1. - i / 1000.).strain;
          CHECK(strain > last);
          last = strain;
        }
    }
}

TEST_CASE("homogeneous state: arguments outside their range are refused")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0., -.1, 1.1, nan})
    CHECK_THROWS_AS(homogeneous_history(Cubic(), bad, Gc, l0), InvalidParameter);
  for (const double bad : {-1., nan, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(homogeneous_phase(Cubic(), bad, Gc, l0), InvalidParameter);
}

TEST_CASE("branch: onset is where the stiffness of the intact state turns negative")
{
  for (const double slope : {1e-4, .1, 1.})
    {
      const Cubic  g(slope);
      const double onset = branch::onset(g, Gc, l0);
      CHECK(onset == Approx(Gc / (2. * l0 * (6. - 4. * slope))).epsilon(1e-14));
      CHECK(branch::stiffness(g, .999 * onset, 1., Gc, l0) > 0.);
      CHECK(branch::stiffness(g, 1.001 * onset, 1., Gc, l0) < 0.);
    }
  CHECK(std::isinf(branch::onset(Quadratic{}, Gc, l0)));
}

TEST_CASE("branch: suspect are intact points above the onset only")
{
  const Cubic g;
  CHECK(branch::is_suspect(g, history_at(1.1), 1.0001, Gc, l0));
  CHECK(branch::is_suspect(g, history_at(1.1), .9995, Gc, l0));
  CHECK_FALSE(branch::is_suspect(g, history_at(1.1), .9, Gc, l0));
  CHECK_FALSE(branch::is_suspect(g, history_at(.9), 1.001, Gc, l0)); // an overshoot without load is normal
  CHECK_FALSE(branch::is_suspect(Quadratic{}, 1e6, 1., Gc, l0));
}

TEST_CASE("branch: the switched stiffness is positive and equals the consistent one where that is large")
{
  const Cubic g;
  for (const double mu : {.5, 1., 1.1, 5.})
    for (const double phi : {0., .3, .5, .9, 1.})
      {
        const double kappa    = branch::stiffness(g, history_at(mu), phi, Gc, l0);
        const double switched = branch::switched_stiffness(g, history_at(mu), phi, Gc, l0);
        CHECK(switched >= .02 * Gc / (2. * l0));
        if (kappa > .02 * Gc / (2. * l0))
          CHECK(switched == kappa);
      }
}

TEST_CASE("branch: Newton's method from the intact state is trapped on the false branch, however short its steps")
{
  for (const double mu : {1.05, 1.1, 1.5, 2., 5., 20.})
    for (const double largest_step : {10., branch::largest_phase_step})
      {
        const double load   = load_at(mu);
        const auto   result = newton(
              load, 1., [&](const double phi) { return load * Cubic().second(phi) + 1.; }, largest_step);

        INFO("mu = " << mu << ": phi = " << result.phi << " after " << result.iterations);
        CHECK(result.iterations <= 6);
        CHECK(result.phi > 1.);
        CHECK(result.phi < 1.002);
        CHECK(branch::is_suspect(Cubic(), history_at(mu), result.phi, Gc, l0));
        CHECK(load * Cubic().second(result.phi) + 1. < 0.); // unstable
      }
}

TEST_CASE("branch: the switched stiffness reaches the stable branch in about the iterations of theory C.2")
{
  struct Row
  {
    double mu;
    int    iterations;
  };
  for (const Row &row :
       {Row{1.01, 28}, Row{1.05, 12}, Row{1.1, 13}, Row{1.5, 18}, Row{2., 18}, Row{5., 19}, Row{20., 20}})
    {
      const double history  = history_at(row.mu);
      const auto   switched = [&](const double phi) {
        return branch::switched_stiffness(Cubic(), history, phi, Gc, l0) / (Gc / (2. * l0));
      };

      const auto result = newton(load_at(row.mu), 1., switched, branch::largest_phase_step);

      INFO("mu = " << row.mu << ": " << result.iterations << " iterations");
      CHECK(result.phi == Approx(homogeneous_phase(Cubic(), history, Gc, l0)).epsilon(1e-11)); // 1e-14 / kappa
      CHECK(std::abs(result.iterations - row.iterations) <= 1);
      CHECK_FALSE(branch::is_suspect(Cubic(), history, result.phi, Gc, l0));
    }
}
