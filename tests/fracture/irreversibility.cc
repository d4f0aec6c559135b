#include <catch2/catch.hpp>

#include <sherd/fracture/irreversibility/history.h>
#include <sherd/fracture/irreversibility/none.h>

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

TEST_CASE("irreversibility: NaN is not hidden behind the maximum")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();

  CHECK(std::isnan(irreversibility::History{}.trial(1., nan)));
  CHECK(std::isnan(irreversibility::None{}.trial(1., nan)));
}
