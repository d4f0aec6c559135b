#pragma once

#include <sherd/material/split/split.h>
#include <sherd/verify/random_state.h>
#include <sherd/verify/report.h>
#include <sherd/verify/shell_split.h>
#include <sherd/verify/smooth_path.h>

#include <algorithm>

namespace sherd::verify
{

/// Checks an energy split of the plane at random states with J > 1, J < 1 and J near 1: stresses against energies,
/// tangents against stresses, energies not negative, the same in any parametric coordinates, and zero at rest
/// (theory B). For splits of the shell see shell_split.h.
///
/// Derivatives are compared away from kinks: states where a tangent jumps nearby are replaced.
/// `CHECK(verify::split(my_split).passed())` is a test of a new split.
/// @param n_states  number of states, a third each stretched, compressed and in between.
/// @param seed      of the random states.
template <EnergySplit<2> Split>
Report split(const Split &split, const int n_states = 21, const std::uint32_t seed = 1)
{
  constexpr double step        = 2e-3;
  constexpr int    n_steps     = 11;
  const double     scale       = split.bulk() + split.shear();
  const auto       check_along = [](const auto &f, const auto &derivative) {
    return check_derivative(f, derivative, step, n_steps);
  };
  Report        report;
  RandomNumbers random(seed);
  int           n = 0;
  for (int n_tried = 0; n < n_states && n_tried < 50 * n_states; ++n_tried)
    {
      const MetricState state = random_state(random, n % 3 == 0 ? 1.25 : n % 3 == 1 ? .8 : 1.);
      const Voigt       path(random(-1., 1.), random(-1., 1.), random(-1., 1.));
      const auto        turn = random_parametrisation(random);
      const auto        at   = [&](const double h) {
        return split.respond(MetricState{state.reference, state.current + h * path}.point());
      };
      if (!internal::is_smooth(at, step))
        continue;
      const std::string where = "state " + print(n) + " (J = " + print(state.point().J) + ')';
      ++n;

      const auto  response = at(0.);
      const Voigt half     = .5 * voigt_weight.cwiseProduct(path);
      report.add("driving stress is the derivative of the active energy",
                 check_along([&](const double h) { return at(h).energy_active; }, response.driving.membrane.dot(half)),
                 where);
      report.add("stresses sum to the derivative of the energy",
                 check_along([&](const double h) { return at(h).energy_active + at(h).energy_passive; },
                             (response.stress_active + response.stress_passive).membrane.dot(half)),
                 where);
      // The constant added is the scale of rounding: one part may be a small remainder of the whole.
      const Voigt whole = (response.stress_active + response.stress_passive).membrane;
      report.add("active tangent is the derivative of the active stress",
                 check_along([&](const double h) { return Voigt(whole + at(h).stress_active.membrane); },
                             Voigt(response.tangent_active.membrane * half)),
                 where);
      report.add("passive tangent is the derivative of the passive stress",
                 check_along([&](const double h) { return Voigt(whole + at(h).stress_passive.membrane); },
                             Voigt(response.tangent_passive.membrane * half)),
                 where);
      report.add("energies are not negative", std::max({0., -response.energy_active, -response.energy_passive}), 0.,
                 where);
      report.add("energies do not depend on the parametric coordinates",
                 internal::energy_difference(response, split.respond(reparametrised(state, turn).point())), 1e-11,
                 where);

      const auto rest = split.respond(MetricState{state.reference, state.reference}.point());
      report.add("energy and stress vanish at rest, relative to the moduli",
                 (std::abs(rest.energy_active) + std::abs(rest.energy_passive) +
                  (rest.stress_active + rest.stress_passive).membrane.cwiseAbs().sum()) /
                     scale,
                 1e-14, where);
    }
  report.add("states without a kink nearby are found", n_states - n, 0.);
  return report;
}

} // namespace sherd::verify
