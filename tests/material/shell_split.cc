#include <catch2/catch.hpp>

#include <sherd/fracture/branch.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/verify/split.h>

#include <array>
#include <cmath>
#include <limits>

using namespace sherd;
using material::Canham, material::Koiter, material::NeoHooke, material::StVenantKirchhoff;

namespace
{
constexpr double T = .1;
// Membrane and bending energies of the random states are of one order.
const NeoHooke membrane(1.7, .6);
const Canham   bending(.02);
const Koiter   koiter(material::Moduli{2., 1.5}, T);
const Voigt    one(1., 1., 0.);

using Split = split::SurfaceStretch<NeoHooke, Canham>;

Split shell(const LayerSettings &layers = {.thickness = T})
{
  return {membrane, bending, layers};
}

verify::ShellState sample(verify::RandomNumbers &random, const int n)
{
  return verify::random_shell_state(random,
                                    n % 4 == 0   ? 1.25
                                    : n % 4 == 1 ? .8
                                                 : 1.,
                                    T, n % 4 == 3 ? verify::Bending::saddle : verify::Bending::general);
}

template <class AnySplit>
void check_derivatives(const AnySplit &split, const verify::StressKind stress)
{
  const auto report = verify::split(split, verify::ShellCheck{.thickness = T, .stress = stress});
  INFO(report);
  CHECK(report.passed());
}

int n_cuts(const SurfacePoint<3> &point, const LayerMetric metric = LayerMetric::full)
{
  return thickness_weight(layer_stretch(point, T, metric)).n_cuts;
}
} // namespace

TEST_CASE("shell split: without a split the response is the derivative of the energy")
{
  check_derivatives(split::None(membrane, bending), verify::StressKind::gradient);
  check_derivatives(split::None(StVenantKirchhoff({1.7, .6}), koiter), verify::StressKind::gradient);
  check_derivatives(split::None(membrane), verify::StressKind::gradient);
}

TEST_CASE("shell split by surface stretch: a kept cut gives derivatives of the energy")
{
  for (const auto metric : {LayerMetric::full, LayerMetric::linear})
    {
      const LayerSettings layers{.thickness = T, .metric = metric, .cut = Cut::kept};
      check_derivatives(split::SurfaceStretch(membrane, bending, layers), verify::StressKind::gradient);
      check_derivatives(split::SurfaceStretch(membrane, koiter, layers), verify::StressKind::gradient);
    }
}

TEST_CASE("shell split by surface stretch: a frozen cut has a consistent tangent and driving stress")
{
  for (const auto metric : {LayerMetric::full, LayerMetric::linear})
    {
      const LayerSettings layers{.thickness = T, .metric = metric};
      check_derivatives(split::SurfaceStretch(membrane, bending, layers), verify::StressKind::frozen);
      check_derivatives(split::SurfaceStretch(membrane, koiter, layers), verify::StressKind::frozen);
    }
  check_derivatives(split::SurfaceStretch(membrane), verify::StressKind::gradient);
  for (const auto part : {BendingPart::active, BendingPart::passive})
    check_derivatives(split::SurfaceStretch(membrane, bending, part), verify::StressKind::gradient);
}

TEST_CASE(
    "shell split by surface stretch: with a frozen cut the stress is not that of the active energy where cuts move")
{
  verify::RandomNumbers random(61);
  int                   n_different = 0;
  for (int n = 0; n < 40; ++n)
    {
      const auto point    = sample(random, n).point();
      const auto response = shell().respond(point);
      const bool same     = response.driving.membrane == response.stress_active.membrane;
      CHECK(same == (n_cuts(point) == 0));
      n_different += !same;
    }
  CHECK(n_different > 10);
}

TEST_CASE(
    "shell split by surface stretch: what a broken sheet gives back when it is bent stretched and unbent compressed")
{
  // A flat sheet is bent to a dome of curvature k while it is stretched by e, compressed by e, unbent, and stretched
  // again.
  constexpr double e = .02, k = .1;
  const auto       work = [&](const Split &split) {
    constexpr int n_steps = 4000; // on each of four sides; the midpoint rule misses the loop's work by 1e-11
    const std::array<std::array<double, 2>, 5> corners{{{1 + e, 0}, {1 + e, k}, {1 - e, k}, {1 - e, 0}, {1 + e, 0}}};
    double                                     done = 0.;
    for (int side = 0; side < 4; ++side)
      for (int n = 0; n < n_steps; ++n)
        {
          const auto state = [&](const double step) {
            const double t = step / n_steps, stretch = (1. - t) * corners[side][0] + t * corners[side + 1][0];
            return std::array<Voigt, 2>{stretch * stretch * one,
                                        ((1. - t) * corners[side][1] + t * corners[side + 1][1]) * one};
          };
          const auto [a0, b0] = state(n);
          const auto [a1, b1] = state(n + 1);
          const auto [a, b]   = state(n + .5);
          const auto stress = degraded_stress(split.respond(verify::ShellState{one, a, Voigt::Zero(), b}.point()), 0.);
          done += .5 * contract(stress.membrane, a1 - a0) + contract(stress.moment, b1 - b0);
        }
    return done;
  };
  const double bent = bending.stiffness() * k * k; // Psi_b of the dome

  CHECK(work(shell()) == Approx(-bent).epsilon(1e-6)); // energy from nothing, with every turn of the loop
  for (const auto part : {BendingPart::active, BendingPart::passive})
    CHECK(std::abs(work({membrane, bending, part})) < 1e-6 * bent);
}

TEST_CASE("shell split by surface stretch: parts sum to the undegraded laws, whatever the settings")
{
  const split::None<NeoHooke, Canham> whole(membrane, bending);
  for (const auto metric : {LayerMetric::full, LayerMetric::linear})
    for (const auto cut : {Cut::frozen, Cut::kept})
      for (const auto tangent : {CutTangent::full, CutTangent::dropped})
        for (const int n_points : {0, 5})
          {
            const auto            split = shell({T, metric, cut, tangent, n_points});
            verify::RandomNumbers random(62);
            for (int n = 0; n < 40; ++n)
              {
                const auto point = sample(random, n).point();

                const auto parts = split.respond(point), expected = whole.respond(point);

                CHECK(parts.energy_active + parts.energy_passive == Approx(expected.energy_active).epsilon(1e-14));
                const auto stress = parts.stress_active + parts.stress_passive;
                // Terms of the cut cancel between the parts; near a double root they are large.
                const double scale = 1. + parts.stress_active.membrane.norm();
                CHECK((stress.membrane - expected.stress_active.membrane).norm() < 1e-14 * scale);
                CHECK((stress.moment - expected.stress_active.moment).norm() <
                      1e-14 * (1. + parts.stress_active.moment.norm()));
                const auto sum   = parts.tangent_active + parts.tangent_passive;
                const auto close = [&](const auto block) {
                  return (sum.*block - expected.tangent_active.*block).norm() <
                         1e-14 * (1. + (parts.tangent_active.*block).norm());
                };
                CHECK(close(&Tangent<3>::membrane));
                CHECK(close(&Tangent<3>::coupling));
                CHECK(close(&Tangent<3>::moment_coupling));
                CHECK(close(&Tangent<3>::bending));
              }
          }
}

TEST_CASE("shell split by surface stretch: symmetry of the tangent")
{
  verify::RandomNumbers random(63);
  for (int n = 0; n < 80; ++n)
    {
      const auto point     = sample(random, n).point();
      const auto symmetric = [&](const LayerSettings &layers) {
        const auto t = degraded_tangent(shell(layers).respond(point), .3);
        return t.membrane.isApprox(t.membrane.transpose(), 1e-12) && t.bending.isApprox(t.bending.transpose(), 1e-12) &&
               t.moment_coupling == t.coupling.transpose();
      };
      CHECK(symmetric({.thickness = T, .cut = Cut::kept}));
      CHECK(symmetric({.thickness = T, .tangent = CutTangent::dropped}));
      CHECK(symmetric({.thickness = T}) == (n_cuts(point) == 0));
    }
}

TEST_CASE("shell split by surface stretch: the tangent of the Gauss rule converges to the dropped one")
{
  const auto            coarse = shell({.thickness = T, .n_points = 512});
  const auto            exact  = shell({.thickness = T, .tangent = CutTangent::dropped});
  verify::RandomNumbers random(64);
  for (int n = 0; n < 40; ++n)
    {
      const auto   point   = sample(random, n).point();
      const auto   one_way = coarse.respond(point), other = exact.respond(point);
      const double energy = bending.bend(point).energy;
      CHECK(std::abs(one_way.energy_active - other.energy_active) < .02 * energy); // 3 pi / 512
      CHECK((one_way.tangent_active.bending - other.tangent_active.bending).norm() <
            .02 * bending.bend(point).stiffness.norm());
    }
}

TEST_CASE("shell split by surface stretch: pure bending of a flat sheet drives with half its energy")
{
  for (const double kappa : {3., -3.})
    for (const auto metric : {LayerMetric::full, LayerMetric::linear})
      for (const auto cut : {Cut::frozen, Cut::kept})
        {
          const auto point = verify::ShellState{one, one, Voigt::Zero(), Voigt(kappa, 0., 0.)}.point();

          const auto response = shell({T, metric, cut}).respond(point);

          const double energy = bending.bend(point).energy;
          CHECK(response.energy_active == .5 * energy);
          CHECK(response.energy_passive == .5 * energy);
          CHECK(degraded_stress(response, 0.).moment == .5 * bending.bend(point).moment); // what an open crack keeps
          CHECK(response.driving.membrane.norm() == 0.); // the cut lies in the mid surface
        }
}

TEST_CASE("shell split by surface stretch: an unloaded crack has no bending stiffness, rounding included")
{
  verify::RandomNumbers random(65);
  for (int n = 0; n < 200; ++n)
    {
      auto state              = sample(random, n);
      state.current           = state.reference * (1. - 4e-16);
      state.current_curvature = state.reference_curvature * (1. + (n % 3 - 1) * 4e-16);

      const auto response = shell().respond(state.point());

      CHECK(degraded_tangent(response, 0.).bending.norm() == 0.);
      CHECK(degraded_tangent(response, 0.).membrane.norm() == 0.);
    }
}

TEST_CASE("shell split by surface stretch: a sphere is active when inflated and passive when deflated")
{
  const auto respond = [](const double lambda) {
    return shell().respond(verify::ShellState{one, lambda * lambda * one, -one, -lambda * one}.point());
  };

  CHECK(respond(1.1).energy_passive == 0.);
  CHECK(respond(1.1).energy_active ==
        Approx(1.7 / 4. * (std::pow(1.1, 4) - 1. - 4. * std::log(1.1)) + .02 * .1 * .1).epsilon(1e-13));
  CHECK(respond(.9).energy_active < 1e-30); // distortion, the square of rounding
  CHECK(respond(.9).energy_passive ==
        Approx(1.7 / 4. * (std::pow(.9, 4) - 1. - 4. * std::log(.9)) + .02 * .1 * .1).epsilon(1e-13));
}

TEST_CASE("shell split by surface stretch: in homogeneous bending damage starts at sqrt(Gc / (3 l0 c))")
{
  const double             Gc = .7, l0 = .02, c = bending.stiffness();
  const degradation::Cubic g(1e-9);
  const double             onset  = branch::onset(g, Gc, l0);
  const auto               active = [&](const double kappa) {
    return shell().respond(verify::ShellState{one, one, Voigt::Zero(), Voigt(kappa, 0., 0.)}.point()).energy_active;
  };

  const double expected = std::sqrt(Gc / (3. * l0 * c));
  for (const double side : {1., -1.})
    {
      double low = 0., high = 2. * expected;
      for (int i = 0; i < 60; ++i)
        (active(side * .5 * (low + high)) < onset ? low : high) = .5 * (low + high);
      CHECK(high == Approx(expected).epsilon(1e-9)); // the slope s moves the onset by s / 1.5
    }
}

TEST_CASE("shell split: a membrane in space answers as in the plane")
{
  verify::RandomNumbers random(66);
  for (int n = 0; n < 20; ++n)
    {
      const auto state = sample(random, n);
      const auto check = [&](const auto &split) {
        const auto plane = split.respond(verify::MetricState{state.reference, state.current}.point());
        const auto space = split.respond(state.point());
        CHECK(space.energy_active == plane.energy_active);
        CHECK(space.energy_passive == plane.energy_passive);
        CHECK(space.stress_active.membrane == plane.stress_active.membrane);
        CHECK(space.driving.membrane == plane.driving.membrane);
        CHECK(space.tangent_passive.membrane == plane.tangent_passive.membrane);
        CHECK((space.stress_active + space.stress_passive).moment.norm() == 0.);
        CHECK((space.tangent_active + space.tangent_passive).bending.norm() == 0.);
      };
      check(split::SurfaceStretch(membrane));
      check(split::None(membrane));
    }
}

TEST_CASE("shell split by surface stretch: layers that are not valid are refused")
{
  for (const double bad : {0., -1., std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(shell({.thickness = bad}), InvalidParameter);
  for (const int bad : {-1, 1})
    CHECK_THROWS_AS(shell({.thickness = T, .n_points = bad}), InvalidParameter);
}
