#pragma once

#include <sherd/material/split/split.h>
#include <sherd/material/split/thickness_weight.h>
#include <sherd/verify/random_state.h>
#include <sherd/verify/report.h>
#include <sherd/verify/smooth_path.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sherd::verify
{

/// What the stress of a damaged surface is to its energy g Psi+ + Psi-.
enum class StressKind
{
  gradient, ///< its derivative at fixed g
  frozen    ///< so only where no layer of the thickness changes sign (theory B.4 (2), frozen cut)
};

/// How to check an energy split of the shell.
struct ShellCheck
{
  double        thickness; ///< T of the split; random curvatures go up to 0.5 / T
  StressKind    stress   = StressKind::gradient;
  int           n_states = 40; ///< random states, a quarter each: stretched, compressed, J near 1, saddle with J near 1
  std::uint32_t seed     = 1;
};

namespace internal
{
/// A straight path through a state of the shell.
struct ShellPath
{
  ShellState state;
  Voigt      a, b; ///< direction in a_ab and b_ab

  ShellState at(const double h) const
  {
    return {state.reference, state.current + h * a, state.reference_curvature, state.current_curvature + h * b};
  }

  /// Largest number of cuts of the thickness at the state, over both layer metrics.
  int n_cuts(const double thickness) const
  {
    const auto cuts = [&](const LayerMetric metric) {
      return thickness_weight(layer_stretch(state.point(), thickness, metric)).n_cuts;
    };
    return std::max(cuts(LayerMetric::full), cuts(LayerMetric::linear));
  }

  /// Whether the sign of the layer stretch less 1 keeps its pattern over the thickness for |h| <= step, with both
  /// layer metrics. Elsewhere a split by layers may have a kink.
  bool is_smooth(const double thickness, const double step) const
  {
    for (const auto metric : {LayerMetric::full, LayerMetric::linear})
      {
        const auto pattern = [&](const double h) {
          const auto stretch = layer_stretch(at(h).point(), thickness, metric);
          int        bits    = thickness_weight(stretch).n_cuts;
          for (const double s : {-1., 0., 1.})
            bits = 2 * bits + (stretch.value(s) >= 0.);
          return bits;
        };
        for (const double h : {-1., -.75, -.5, -.25, .25, .5, .75, 1.})
          if (pattern(h * step) != pattern(0.))
            return false;
      }
    return true;
  }
};

/// Differences of both energies relative to their sum.
template <int spacedim>
double energy_difference(const SplitResponse<spacedim> &a, const SplitResponse<spacedim> &b)
{
  return (std::abs(a.energy_active - b.energy_active) + std::abs(a.energy_passive - b.energy_passive)) /
         (a.energy_active + a.energy_passive);
}

/// d tau or d M_0 along a path that moves either a_ab or b_ab, by tangents (theory B).
inline Voigt half_contraction(const Voigt4 &tangent, const Voigt &path)
{
  return .5 * (tangent * voigt_weight.cwiseProduct(path));
}
} // namespace internal

/// Checks an energy split of the shell at random states: the driving stress and, as far as asked, the stresses against
/// the energies, the four tangents of both parts against the stresses, energies not negative, unchanged when the normal
/// is reversed and in other parametric coordinates, and zero with the stress at rest (theory B).
///
/// Derivatives are compared away from kinks: states where a layer changes sign or a tangent jumps nearby are replaced.
/// `CHECK(verify::split(my_split, verify::ShellCheck{.thickness = T}).passed())` is a test of a new split.
template <EnergySplit<3> Split>
Report split(const Split &split, const ShellCheck &check)
{
  constexpr double step = 5e-4, g = .3;
  constexpr int    n_steps     = 10; // below, rounding in the position of a cut outweighs the error of the quotient
  const double     T           = check.thickness;
  const double     scale       = split.bulk() + split.shear();
  const auto       check_along = [](const auto &f, const auto &derivative) {
    return check_derivative(f, derivative, step, n_steps);
  };
  Report        report;
  RandomNumbers random(check.seed);
  const auto    direction = [&] { return Voigt(random(-1., 1.), random(-1., 1.), random(-1., 1.)); };

  int n = 0;
  for (int n_tried = 0; n < check.n_states && n_tried < 100 * check.n_states; ++n_tried)
    {
      const double        J_mean  = n % 4 == 0 ? 1.25 : n % 4 == 1 ? .8 : 1.;
      const Bending       bending = n % 4 == 3 ? Bending::saddle : Bending::general;
      internal::ShellPath path{random_shell_state(random, J_mean, T, bending), direction(), direction() / T};
      const auto          turn = random_parametrisation(random);
      if (!path.is_smooth(T, 8. * step))
        continue;

      const auto along = [&](const Voigt &a, const Voigt &b) {
        return [&split, moved = internal::ShellPath{path.state, a, b}](const double h) {
          return split.respond(moved.at(h).point());
        };
      };
      const auto at = along(path.a, path.b), a = along(path.a, Voigt::Zero()), b = along(Voigt::Zero(), path.b);
      if (!internal::is_smooth(at, step) || !internal::is_smooth(a, step) || !internal::is_smooth(b, step))
        continue;
      const auto        response = at(0.);
      const std::string where    = "state " + print(n) + " (J = " + print(path.state.point().J) + ')';
      ++n;

      const auto work = [&](const Stress<3> &stress) {
        return .5 * contract(stress.membrane, path.a) + contract(stress.moment, path.b);
      };
      report.add("driving stress is the derivative of the active energy",
                 check_along([&](const double h) { return at(h).energy_active; }, work(response.driving)), where);
      report.add("stresses sum to the derivative of the energy",
                 check_along([&](const double h) { return at(h).energy_active + at(h).energy_passive; },
                             work(response.stress_active + response.stress_passive)),
                 where);
      if (check.stress == StressKind::gradient || path.n_cuts(T) == 0)
        report.add("degraded stress is the derivative of the degraded energy",
                   check_along([&](const double h) { return g * at(h).energy_active + at(h).energy_passive; },
                               work(degraded_stress(response, g))),
                   where);

      const auto check_tangent = [&](const std::string &part, const auto stress, const Tangent<3> &tangent) {
        // The constant added is the scale of rounding: one part may be a small remainder of the whole.
        const auto add = [&](const std::string &name, const auto &moved, const auto component, const Voigt &expected) {
          const Voigt whole = (response.stress_active + response.stress_passive).*component;
          report.add(part + " tangent " + name + " is the derivative of the " + part + " stress",
                     check_along([&](const double h) { return Voigt(whole + stress(moved(h)).*component); }, expected),
                     where);
        };
        add("c", a, &Stress<3>::membrane, internal::half_contraction(tangent.membrane, path.a));
        add("d", b, &Stress<3>::membrane, 2. * internal::half_contraction(tangent.coupling, path.b));
        add("e", a, &Stress<3>::moment, internal::half_contraction(tangent.moment_coupling, path.a));
        add("f", b, &Stress<3>::moment, 2. * internal::half_contraction(tangent.bending, path.b));
      };
      check_tangent(
          "active", [](const SplitResponse<3> &r) { return r.stress_active; }, response.tangent_active);
      check_tangent(
          "passive", [](const SplitResponse<3> &r) { return r.stress_passive; }, response.tangent_passive);

      report.add("energies are not negative", std::max({0., -response.energy_active, -response.energy_passive}), 0.,
                 where);
      const ShellState &state    = path.state;
      const auto        reversed = split.respond(
                 ShellState{state.reference, state.current, -state.reference_curvature, -state.current_curvature}.point());
      report.add("energies do not change with the side of the normal", internal::energy_difference(response, reversed),
                 1e-13, where);
      report.add("energies do not depend on the parametric coordinates",
                 internal::energy_difference(response, split.respond(reparametrised(state, turn).point())), 1e-11,
                 where);

      const auto rest = split.respond(
          ShellState{state.reference, state.reference, state.reference_curvature, state.reference_curvature}.point());
      const Stress<3> stress = rest.stress_active + rest.stress_passive;
      report.add("energy and stress vanish at rest, relative to the moduli",
                 (std::abs(rest.energy_active) + std::abs(rest.energy_passive) + stress.membrane.cwiseAbs().sum() +
                  stress.moment.cwiseAbs().sum() / T) /
                     scale,
                 1e-14, where);
    }
  report.add("states without a kink nearby are found", check.n_states - n, 0.);
  return report;
}

} // namespace sherd::verify
