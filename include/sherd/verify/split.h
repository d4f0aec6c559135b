#pragma once

#include <sherd/material/split/split.h>
#include <sherd/verify/random_state.h>
#include <sherd/verify/report.h>
#include <sherd/verify/shell_split.h>

#include <algorithm>

namespace sherd::verify
{

/// Checks an energy split of the plane at random states with J > 1 and J < 1: stresses against energies, tangents
/// against stresses, energies not negative and zero at rest (theory B). For splits of the shell see shell_split.h.
///
/// `CHECK(verify::split(my_split).passed())` is a test of a new split.
/// @param n_states  number of states, half of them stretched and half compressed.
/// @param seed      of the random states.
template <EnergySplit<2> Split>
Report split(const Split &split, const int n_states = 20, const std::uint32_t seed = 1)
{
  Report        report;
  RandomNumbers random(seed);
  const double  scale = split.bulk() + split.shear();
  for (int n = 0; n < n_states; ++n)
    {
      const MetricState state = random_state(random, n % 2 == 0 ? 1.25 : .8);
      const Voigt       path(random(-1., 1.), random(-1., 1.), random(-1., 1.));
      const auto        at = [&](const double h) {
        return split.respond(MetricState{state.reference, state.current + h * path}.point());
      };

      const auto  response = at(0.);
      const Voigt half     = .5 * voigt_weight.cwiseProduct(path);
      report.add(
          "driving stress is the derivative of the active energy",
          check_derivative([&](const double h) { return at(h).energy_active; }, response.driving.membrane.dot(half)));
      report.add("stresses sum to the derivative of the energy",
                 check_derivative([&](const double h) { return at(h).energy_active + at(h).energy_passive; },
                                  (response.stress_active + response.stress_passive).membrane.dot(half)));
      report.add("active tangent is the derivative of the active stress",
                 check_derivative([&](const double h) { return at(h).stress_active.membrane; },
                                  Voigt(response.tangent_active.membrane * half)));
      report.add("passive tangent is the derivative of the passive stress",
                 check_derivative([&](const double h) { return at(h).stress_passive.membrane; },
                                  Voigt(response.tangent_passive.membrane * half)));
      report.add("energies are not negative", std::max({0., -response.energy_active, -response.energy_passive}), 0.);

      const auto rest = split.respond(MetricState{state.reference, state.reference}.point());
      report.add("energy and stress vanish at rest, relative to the moduli",
                 (std::abs(rest.energy_active) + std::abs(rest.energy_passive) +
                  (rest.stress_active + rest.stress_passive).membrane.cwiseAbs().sum()) /
                     scale,
                 1e-14);
    }
  return report;
}

} // namespace sherd::verify
