#pragma once

#include <sherd/material/bending.h>
#include <sherd/verify/random_state.h>
#include <sherd/verify/report.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sherd::verify
{

/// Checks a bending law at random states of curved surfaces: moment against energy, stiffness against moment and
/// symmetric, energy not negative, the same in any parametric coordinates, on either side of the normal and for any
/// stretch of the surface, zero with the moment where the curvature does not change, and stiffness() against the
/// moment by bending about one axis there, f_1111 in Cartesian coordinates (theory B.2).
///
/// `CHECK(verify::bending(my_law).passed())` is a test of a new law.
/// @param length    radii of curvature are of order 4 length and more.
/// @param n_states  number of states.
/// @param seed      of the random states.
template <BendingLaw Law>
Report bending(const Law &law, const double length = 1., const int n_states = 20, const std::uint32_t seed = 1)
{
  constexpr double step    = 2e-3;
  constexpr int    n_steps = 11;
  Report           report;
  RandomNumbers    random(seed);
  for (int n = 0; n < n_states; ++n)
    {
      const ShellState  state = random_shell_state(random, n % 2 == 0 ? 1.1 : .9, length);
      const Voigt       path  = Voigt(random(-1., 1.), random(-1., 1.), random(-1., 1.)) / length;
      const std::string where = "state " + print(n);
      const auto        at    = [&](const double h) {
        return law.bend(
                      ShellState{state.reference, state.current, state.reference_curvature, state.current_curvature + h * path}
                          .point());
      };
      const auto   response = at(0.);
      const Voigt  weighted = voigt_weight.cwiseProduct(path);
      const double size     = std::max(response.energy, std::numeric_limits<double>::min());
      const auto   compare  = [&](const BendingResponse &other) {
        return std::abs(other.energy - response.energy) / size;
      };

      report.add(
          "moment is the derivative of the energy",
          check_derivative([&](const double h) { return at(h).energy; }, response.moment.dot(weighted), step, n_steps),
          where);
      report.add("stiffness is the derivative of the moment",
                 check_derivative([&](const double h) { return at(h).moment; }, Voigt(response.stiffness * weighted),
                                  step, n_steps),
                 where);
      report.add("stiffness is symmetric", (response.stiffness - response.stiffness.transpose()).norm(),
                 1e-13 * response.stiffness.norm(), where);
      report.add("energy is not negative", std::max(0., -response.energy), 0., where);
      report.add("energy does not depend on the parametric coordinates",
                 compare(law.bend(reparametrised(state, random_parametrisation(random)).point())), 1e-11, where);
      report.add("energy does not change with the side of the normal",
                 compare(law.bend(
                     ShellState{state.reference, state.current, -state.reference_curvature, -state.current_curvature}
                         .point())),
                 1e-13, where);
      report.add("energy does not depend on the stretch of the surface",
                 compare(law.bend(ShellState{state.reference, 1.3 * state.reference, state.reference_curvature,
                                             state.current_curvature}
                                      .point())),
                 1e-13, where);

      const auto rest = law.bend(
          ShellState{state.reference, state.current, state.reference_curvature, state.reference_curvature}.point());
      report.add("energy and moment vanish without change of curvature",
                 std::abs(rest.energy) + rest.moment.cwiseAbs().sum(), 0., where);
    }
  const Voigt  one(1., 1., 0.), flat = Voigt::Zero();
  const double resistance = law.bend(ShellState{one, one, flat, flat}.point()).stiffness(0, 0);
  report.add("stiffness() is that of bending about one axis", std::abs(law.stiffness() - resistance),
             1e-12 * resistance);
  return report;
}

} // namespace sherd::verify
