#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/fracture/homogeneous.h>
#include <sherd/fracture/irreversibility/history.h>
#include <sherd/fracture/irreversibility/none.h>
#include <sherd/fracture/irreversibility/penalty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace sherd;

namespace
{
const std::vector<double> energies{0., .2, .5, .3, .4, .7, .1};
}

TEST_CASE("irreversibility: the history field is the running maximum of the energy")
{
  const irreversibility::History policy;
  double                         accepted = 0.;
  for (std::size_t n = 0; n < energies.size(); ++n)
    {
      const double before = accepted;
      accepted            = policy.trial(before, energies[n]);

      CHECK(accepted == *std::max_element(energies.begin(), energies.begin() + n + 1));
      CHECK(policy.is_loading(before, energies[n]) == (accepted > before));
    }
}

TEST_CASE("irreversibility: an initial history stays until the energy exceeds it")
{
  const irreversibility::History policy;

  CHECK(policy.trial(10., .5) == 10.);
  CHECK_FALSE(policy.is_loading(10., .5));
  CHECK(policy.trial(10., 11.) == 11.);
}

TEST_CASE("irreversibility: without memory the energy itself drives")
{
  const irreversibility::None policy;
  for (const double energy : energies)
    {
      CHECK(policy.trial(.5, energy) == energy);
      CHECK(policy.is_loading(.5, energy));
    }
}

TEST_CASE("irreversibility: what a step and a pre-crack leave in the memory")
{
  CHECK(irreversibility::History{}.commit(.5, .7, .2) == .7);
  CHECK(irreversibility::History{}.commit(.5, .3, .2) == .5);
  CHECK(irreversibility::History{}.initial(9., .2) == 9.);
  CHECK(irreversibility::None{}.commit(.5, .7, .2) == 0.);
  CHECK(irreversibility::None{}.initial(9., .2) == 0.);
  CHECK(irreversibility::Penalty().commit(.5, .7, .2) == .8);
  CHECK(irreversibility::Penalty().commit(.9, .7, .2) == .9);
  CHECK(irreversibility::Penalty().initial(9., .25) == .75);
  CHECK(irreversibility::Penalty().initial(9., 1.01) == 0.);
}

TEST_CASE("irreversibility: only the penalty resists, and only where the phase rises above its past")
{
  const irreversibility::Penalty penalty(200.);
  CHECK(penalty.resistance(.5, .4) == 0.);
  CHECK(penalty.resistance_stiffness(.5, .4) == 0.);
  CHECK(penalty.resistance(.5, .75) == 50.);
  CHECK(penalty.resistance_stiffness(.5, .75) == 200.);
  CHECK(penalty.resistance(0., 1.) == 0.);
  for (const double phi : {0., .5, 1.5})
    {
      CHECK(irreversibility::History{}.resistance(.5, phi) == 0.);
      CHECK(irreversibility::History{}.resistance_stiffness(.5, phi) == 0.);
      CHECK(irreversibility::None{}.resistance(.5, phi) == 0.);
      CHECK(irreversibility::None{}.resistance_stiffness(.5, phi) == 0.);
    }
  for (const double bad : {0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(irreversibility::Penalty(bad), InvalidParameter);
}

TEST_CASE("irreversibility: a homogeneous body unloads along the policy's own path")
{
  // Loaded to phi_n and unloaded to zero energy: with the history the phase stays, with the penalty it rises to
  // (phi_n + 1 / (2 factor)) / (1 + 1 / (2 factor)), without memory it heals.
  const degradation::Quadratic g;
  constexpr double             Gc = .7, l0 = .02, factor = 200.;
  const double                 energy = 20. * Gc / l0, broken = homogeneous_phase(g, energy, Gc, l0);
  const auto                   unloaded = [&](const auto &policy) {
    const double memory = policy.commit(0., energy, broken);
    double       phi    = broken;
    for (int iteration = 0; iteration < 20; ++iteration) // Newton's method
      {
        const double H = policy.trial(memory, 0.);
        const double residual = 2. * l0 / Gc * g.first(phi) * H + phi - 1. + 2. * policy.resistance(memory, phi);
        const double stiffness = 2. * l0 / Gc * g.second(phi) * H + 1. + 2. * policy.resistance_stiffness(memory, phi);
        phi -= residual / stiffness;
      }
    return phi;
  };
  CHECK(unloaded(irreversibility::History{}) == Approx(broken).epsilon(1e-13));
  CHECK(unloaded(irreversibility::None{}) == Approx(1.).epsilon(1e-13));
  CHECK(unloaded(irreversibility::Penalty(factor)) ==
        Approx((broken + .5 / factor) / (1. + .5 / factor)).epsilon(1e-12));
}

TEST_CASE("irreversibility: NaN is not hidden behind the maximum")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();

  CHECK(std::isnan(irreversibility::History{}.trial(1., nan)));
  CHECK(std::isnan(irreversibility::None{}.trial(1., nan)));
  CHECK(std::isnan(irreversibility::History{}.commit(1., nan, .5)));
  CHECK(std::isnan(irreversibility::Penalty().trial(1., nan)));
  CHECK(std::isnan(irreversibility::Penalty().resistance(.5, nan)));
  CHECK(std::isnan(irreversibility::Penalty().commit(.5, 1., nan)));
}
