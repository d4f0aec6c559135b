#pragma once

#include <sherd/material/membrane.h>
#include <sherd/material/plane_stress.h>
#include <sherd/verify/random_state.h>
#include <sherd/verify/report.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sherd::verify
{

namespace internal
{
/// Stress against energy and tangent against stress, along a random path.
/// @param respond  response at a point.
template <class Respond>
void check_response(Report &report, const std::string &name, const Respond &respond, const MetricState &state,
                    const Voigt &path, const std::string &where)
{
  constexpr double step    = 2e-3;
  constexpr int    n_steps = 11;
  const auto       at      = [&](const double h) {
    return respond(MetricState{state.reference, state.current + h * path}.point());
  };
  const Response<2> response = at(0.);
  const Voigt       half     = .5 * voigt_weight.cwiseProduct(path);
  report.add(
      name + "stress is the derivative of the energy",
      check_derivative([&](const double h) { return at(h).energy; }, response.stress.membrane.dot(half), step, n_steps),
      where);
  report.add(name + "tangent is the derivative of the stress",
             check_derivative([&](const double h) { return at(h).stress.membrane; },
                              Voigt(response.tangent.membrane * half), step, n_steps),
             where);
  report.add(name + "tangent is symmetric",
             (response.tangent.membrane - response.tangent.membrane.transpose()).norm() /
                 response.tangent.membrane.norm(),
             1e-13, where);
}
} // namespace internal

/// Checks a membrane law at random states with J > 1, J < 1 and J near 1: stress against energy, tangent against stress
/// and symmetric, energy not negative, the same in any parametric coordinates, zero at rest with the stress, and bulk()
/// and shear() against the tangent there. Of a law in two parts each is checked, their sum, and that dilatation and its
/// stress vanish where J = 1 (theory B.1).
///
/// `CHECK(verify::membrane(my_law).passed())` is a test of a new law.
/// @param n_states  number of states.
/// @param seed      of the random states.
template <MembraneLaw Law>
Report membrane(const Law &law, const int n_states = 21, const std::uint32_t seed = 1)
{
  Report        report;
  RandomNumbers random(seed);
  const double  scale = law.bulk() + law.shear();
  for (int n = 0; n < n_states; ++n)
    {
      const MetricState state = random_state(random, n % 3 == 0 ? 1.25 : n % 3 == 1 ? .8 : 1.);
      const auto        point = state.point();
      const Voigt       path(random(-1., 1.), random(-1., 1.), random(-1., 1.));
      const std::string where    = "state " + print(n) + " (J = " + print(point.J) + ')';
      const auto        response = law.respond(point);
      internal::check_response(
          report, "", [&](const auto &p) { return law.respond(p); }, state, path, where);
      report.add("energy is not negative", std::max(0., -response.energy), 0., where);
      const auto turned = law.respond(reparametrised(state, random_parametrisation(random)).point());
      report.add("energy does not depend on the parametric coordinates",
                 std::abs(turned.energy - response.energy) / response.energy, 1e-11, where);

      const auto   rest     = law.respond(MetricState{state.reference, state.reference}.point());
      const Voigt4 expected = material::plane_stress_tensor({law.bulk(), law.shear()}, point.reference.metric);
      report.add("energy and stress vanish at rest, relative to the moduli",
                 (std::abs(rest.energy) + rest.stress.membrane.cwiseAbs().sum()) / scale, 1e-14, where);
      report.add("bulk() and shear() are the moduli at rest",
                 (rest.tangent.membrane - expected).norm() / expected.norm(), 1e-12, where);

      if constexpr (SeparableMembraneLaw<Law>)
        {
          internal::check_response(
              report, "dilatation: ", [&](const auto &p) { return law.dilatation(p); }, state, path, where);
          internal::check_response(
              report, "deviator: ", [&](const auto &p) { return law.deviator(p); }, state, path, where);
          const auto sum = law.dilatation(point) + law.deviator(point);
          report.add("dilatation and deviator sum to the law",
                     std::abs(sum.energy - response.energy) / response.energy +
                         (sum.stress.membrane - response.stress.membrane).norm() / scale +
                         (sum.tangent.membrane - response.tangent.membrane).norm() / scale,
                     1e-13, where);
          const auto kept = law.dilatation(MetricState{state.reference, state.current / point.J}.point());
          report.add("dilatation and its stress vanish where J = 1, relative to the bulk modulus",
                     (std::abs(kept.energy) + kept.stress.membrane.cwiseAbs().sum()) / law.bulk(), 1e-13, where);
        }
    }
  return report;
}

} // namespace sherd::verify
