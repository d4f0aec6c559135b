// label: verification
#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/spectral_layer.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>
#include <sherd/verify/split.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace sherd;
using material::Canham, material::Koiter, material::Moduli, material::StVenantKirchhoff;
using split::SpectralLayer, split::SpectralMembrane, split::VolumetricDeviatoricLayer;

namespace
{
constexpr double T = .1;
const Moduli     moduli{1.7, .6};
const Koiter     koiter(moduli, T);
const Voigt      one(1., 1., 0.), flat = Voigt::Zero();

/// Surfaces with Poisson's ratio .48, 0, -.43 and .3 in plane strain.
const std::vector<Moduli> samples{moduli, {1., 1.}, {.4, 1.}, material::plane_strain_moduli(210e3, .3)};

/// A flat sheet with given strains and changes of curvature in Cartesian coordinates.
SurfacePoint<3> sheet(const Voigt &strain, const Voigt &curvature)
{
  return verify::ShellState{one, one + 2. * strain, flat, curvature}.point();
}
SurfacePoint<2> plate(const Voigt &strain)
{
  return verify::MetricState{one, one + 2. * strain}.point();
}

verify::ShellState sample(verify::RandomNumbers &random, const int n)
{
  return verify::random_shell_state(random, n % 3 == 0 ? 1.25 : n % 3 == 1 ? .8 : 1., T);
}

template <class AnySplit>
void check_plane(const AnySplit &split)
{
  const auto report = verify::split(split);
  INFO(report);
  CHECK(report.passed());
}
template <class AnySplit>
void check_shell(const AnySplit &split, const verify::StressKind stress = verify::StressKind::gradient)
{
  const auto report = verify::split(split, verify::ShellCheck{.thickness = T, .stress = stress});
  INFO(report);
  CHECK(report.passed());
}

/// Parts sum to the undegraded law, to the rounding of what they are made of.
template <int spacedim, class AnySplit, class Whole>
void check_sum(const AnySplit &split, const Whole &whole, const SurfacePoint<spacedim> &point)
{
  const auto   parts = split.respond(point), expected = whole.respond(point);
  const double scale = split.bulk() + split.shear();
  CHECK(parts.energy_active + parts.energy_passive == Approx(expected.energy_active).epsilon(1e-13));
  const auto stress  = parts.stress_active + parts.stress_passive;
  const auto tangent = parts.tangent_active + parts.tangent_passive;
  CHECK((stress.membrane - expected.stress_active.membrane).norm() < 1e-14 * scale);
  const auto close = [&](const auto block, const double size) {
    return (tangent.*block - expected.tangent_active.*block).norm() < 1e-13 * size * scale;
  };
  CHECK(close(&Tangent<spacedim>::membrane, 1.));
  if constexpr (spacedim == 3)
    {
      CHECK((stress.moment - expected.stress_active.moment).norm() < 1e-14 * T * scale);
      CHECK(close(&Tangent<3>::coupling, T));
      CHECK(close(&Tangent<3>::moment_coupling, T));
      CHECK(close(&Tangent<3>::bending, T * T));
    }
}
} // namespace

TEST_CASE("splits by strain: plane versions are consistent")
{
  for (const auto &m : samples)
    {
      check_plane(SpectralLayer(m));
      check_plane(SpectralMembrane(m));
      check_plane(VolumetricDeviatoricLayer(m));
    }
}

TEST_CASE("splits by strain: every derivative of a shell by layers")
{
  for (const auto &m : samples)
    {
      check_shell(SpectralLayer(m, T));
      check_shell(VolumetricDeviatoricLayer(m, T));
    }
  check_shell(SpectralLayer(moduli, T, 2));
  check_shell(SpectralLayer(moduli, T, 9));
}

TEST_CASE("splits by strain: every derivative of a spectral membrane with its three kinds of bending")
{
  for (const auto part : {BendingPart::active, BendingPart::passive})
    {
      check_shell(SpectralMembrane(moduli, koiter, part));
      check_shell(SpectralMembrane(moduli, Canham(.02), part));
    }
  for (const auto metric : {LayerMetric::full, LayerMetric::linear})
    {
      check_shell(SpectralMembrane(moduli, koiter, {.thickness = T, .metric = metric, .cut = Cut::kept}));
      check_shell(SpectralMembrane(moduli, koiter, {.thickness = T, .metric = metric}), verify::StressKind::frozen);
    }
  check_shell(SpectralMembrane(moduli));
}

TEST_CASE("splits by strain: parts sum to St. Venant-Kirchhoff in the plane and to Koiter's shell")
{
  verify::RandomNumbers random(71);
  for (const auto &m : samples)
    {
      const split::None                            plane{StVenantKirchhoff(m)};
      const split::None<StVenantKirchhoff, Koiter> whole(StVenantKirchhoff(m), Koiter(m, T));
      for (int n = 0; n < 30; ++n)
        {
          const auto point = sample(random, n).point();
          check_sum<2>(SpectralLayer(m), plane, point);
          check_sum<2>(VolumetricDeviatoricLayer(m), plane, point);
          for (const int n_points : {2, 5, 8})
            check_sum(SpectralLayer(m, T, n_points), whole, point);
          check_sum(VolumetricDeviatoricLayer(m, T), whole, point);
          for (const auto part : {BendingPart::active, BendingPart::passive})
            check_sum(SpectralMembrane(m, Koiter(m, T), part), whole, point);
        }
    }
}

TEST_CASE("splits by strain: what compression, tension and shear drive")
{
  constexpr double e        = .01;
  const auto       spectral = SpectralLayer(moduli);
  const auto       voldev   = VolumetricDeviatoricLayer(moduli);
  const double     G = moduli.shear, K = moduli.bulk;

  // Equal compression on all sides drives nothing, equal tension has nothing passive.
  for (const auto &pressed : {spectral.respond(plate({-e, -e, 0.})), voldev.respond(plate({-e, -e, 0.}))})
    {
      CHECK(pressed.energy_active == 0.);
      CHECK(pressed.driving.membrane.norm() == 0.);
      CHECK(pressed.energy_passive == Approx(2. * K * e * e).epsilon(1e-13));
    }
  CHECK(spectral.respond(plate({e, e, 0.})).energy_passive == 0.);
  CHECK(voldev.respond(plate({e, e, 0.})).energy_passive == 0.);

  // Blocked at the sides, compression along one axis drives the deviator only, G e^2 / 2, or nothing.
  CHECK(spectral.respond(plate({-e, 0., 0.})).energy_active == 0.);
  CHECK(voldev.respond(plate({-e, 0., 0.})).energy_active == Approx(.5 * G * e * e).epsilon(1e-13));
  // Free at the sides they swell: only the swelling drives, mu (nu e)^2.
  const double nu = (K - G) / (K + G);
  CHECK(spectral.respond(plate({-e, nu * e, 0.})).energy_active == Approx(G * nu * nu * e * e).epsilon(1e-12));

  // Shear: half of the energy, or all of it.
  const auto sheared = spectral.respond(plate({0., 0., e}));
  CHECK(sheared.energy_active == Approx(G * e * e).epsilon(1e-13));
  CHECK(sheared.energy_passive == Approx(G * e * e).epsilon(1e-13));
  CHECK(sheared.stress_active.membrane.isApprox(G * e * Voigt(1., 1., 1.), 1e-13));
  CHECK(voldev.respond(plate({0., 0., e})).energy_active == Approx(2. * G * e * e).epsilon(1e-13));
  CHECK(voldev.respond(plate({0., 0., e})).energy_passive == 0.);
}

TEST_CASE("splits by strain: equal principal strains, and such that are nearly equal, are nothing special")
{
  for (const double mean : {.1, -.1, 0., 1e-13, -1e-13})
    for (const double apart : {0., 1e-300, 1e-17, 1e-15, 1e-12, 1e-9})
      for (const double angle : {0., .3, 1.2})
        {
          const Voigt E(mean + apart * std::cos(angle), mean - apart * std::cos(angle), apart * std::sin(angle));
          const auto  parts = spectral_parts(moduli, E);
          CAPTURE(mean, apart, angle);

          const Voigt4 tangent = parts.active.tangent + parts.passive.tangent;
          CHECK(tangent.allFinite());
          CHECK(parts.active.stress.allFinite());
          CHECK((tangent -
                 plate(flat).metric.determinant * StVenantKirchhoff(moduli).respond(plate(flat)).tangent.membrane)
                    .norm() < 1e-14);
          // Around a mean strain both parts of the tangent are those of the mean.
          if (std::abs(mean) > 1e-3)
            {
              CHECK((mean > 0. ? parts.passive : parts.active).tangent.norm() == 0.);
              CHECK((mean > 0. ? parts.passive : parts.active).energy == 0.);
            }
        }
}

TEST_CASE("splits by strain: stress is continuous where a principal strain or the trace changes sign")
{
  verify::RandomNumbers random(72);
  for (int n = 0; n < 20; ++n)
    {
      // A strain with one principal value zero, in a random frame; then without trace.
      const double angle = random(0., 3.), c = std::cos(angle), s = std::sin(angle), e = random(-.1, .1);
      for (const auto &[E, step] : {std::pair{Voigt(e * c * c, e * s * s, e * c * s), Voigt(s * s, c * c, -c * s)},
                                    std::pair{Voigt(e * c, -e * c, e * s), Voigt(1., 1., 0.)}})
        for (const double h : {1e-3, 1e-6, 1e-9})
          {
            const auto below = spectral_parts(moduli, E - h * step), above = spectral_parts(moduli, E + h * step);
            CHECK((above.active.stress - below.active.stress).norm() < 12. * h);
            CHECK((above.passive.stress - below.passive.stress).norm() < 12. * h);
          }
    }
}

TEST_CASE("splits by strain: an unloaded crack is not stiff by rounding")
{
  const std::vector<double> noise{0., 3e-16, -3e-16};
  for (const double x : noise)
    for (const double y : noise)
      for (const double k : noise)
        {
          const auto point = sheet({x, y, .5 * x}, {k, -k, y});
          for (const auto &response :
               {SpectralLayer(moduli, T).respond(point), VolumetricDeviatoricLayer(moduli, T).respond(point)})
            {
              CHECK(response.tangent_passive.membrane.norm() == 0.);
              CHECK(response.tangent_passive.bending.norm() == 0.);
            }
        }
}

TEST_CASE("volumetric-deviatoric layers: the closed integral is that of many layers")
{
  verify::RandomNumbers              random(73);
  const VolumetricDeviatoricLayer<3> closed(moduli, T);
  for (int n = 0; n < 12; ++n)
    {
      const auto        point = sample(random, n).point();
      const LayerStrain strain(point, T);
      constexpr int     n_layers = 4000;
      LayerMoments      active, passive;
      for (int i = 0; i < n_layers; ++i)
        {
          const double s     = -1. + (2. * i + 1.) / n_layers;
          const auto   parts = split::internal::volumetric_deviatoric_parts(moduli, strain.at(s));
          active.add(parts.active, s, 1. / n_layers);
          passive.add(parts.passive, s, 1. / n_layers);
        }
      const auto expected = shell_response(point.reference.frame, active, passive, T), found = closed.respond(point);

      // The midpoint rule is of second order in energy and stress, and of first where the tangent jumps.
      CHECK(found.energy_active == Approx(expected.energy_active).margin(1e-7));
      CHECK(found.energy_passive == Approx(expected.energy_passive).margin(1e-7));
      CHECK((found.stress_active.membrane - expected.stress_active.membrane).norm() < 1e-6);
      CHECK((found.stress_active.moment - expected.stress_active.moment).norm() < 1e-6 * T);
      CHECK((found.stress_passive.moment - expected.stress_passive.moment).norm() < 1e-6 * T);
      CHECK((found.tangent_active.membrane - expected.tangent_active.membrane).norm() < 5e-3);
      CHECK((found.tangent_active.coupling - expected.tangent_active.coupling).norm() < 5e-3 * T);
      CHECK((found.tangent_active.bending - expected.tangent_active.bending).norm() < 5e-3 * T * T);
    }
}

TEST_CASE("spectral layers: five points are good for a per cent of the active energy")
{
  // Bending with more and more tension, until the neutral layer leaves the thickness.
  const auto worst = [](const int n_points) {
    const SpectralLayer<3> rule(moduli, T, n_points), fine(moduli, T, 400);
    double                 error = 0.;
    for (int i = 0; i <= 40; ++i)
      {
        const auto point = sheet({.00025 * i, 0., 0.}, {.02 / T, 0., 0.});
        error = std::max(error, std::abs(rule.respond(point).energy_active / fine.respond(point).energy_active - 1.));
      }
    return error;
  };
  INFO(worst(3) << ' ' << worst(5) << ' ' << worst(7));
  CHECK(worst(3) < .05);
  CHECK(worst(5) < .01);
  CHECK(worst(7) < .005);
}

TEST_CASE("bending thresholds: pure bending of a flat sheet")
{
  const Moduli straight{1., 1.}; // nu = 0: bending about one axis has strains along one
  const Koiter bending(straight, T);
  for (const double kappa : {.3, -.3})
    {
      const auto   point  = sheet(flat, {kappa, 0., 0.});
      const double energy = bending.bend(point).energy;
      const Voigt  moment = bending.bend(point).moment;

      // The layers on one side are in tension: half of the energy drives.
      const auto layers = SpectralLayer(straight, T).respond(point);
      CHECK(layers.energy_active == Approx(.5 * energy).epsilon(1e-14));
      CHECK(layers.energy_passive == Approx(.5 * energy).epsilon(1e-14));
      CHECK(layers.stress_active.moment.isApprox(.5 * moment, 1e-13));
      // They pull at the mid surface, and the others press: T E kappa / 8, exact for the trace.
      const auto voldev = VolumetricDeviatoricLayer(straight, T).respond(point);
      CHECK(voldev.energy_active == Approx(.75 * energy).epsilon(1e-14)); // deviator, and half of the trace
      CHECK(voldev.stress_active.membrane[0] == Approx(straight.bulk * T * std::abs(kappa) / 8.).epsilon(1e-13));
      CHECK(voldev.stress_passive.membrane[0] == Approx(-straight.bulk * T * std::abs(kappa) / 8.).epsilon(1e-13));

      const auto share = [&](const auto &split) { return split.respond(point).energy_active / energy; };
      CHECK(share(SpectralMembrane(straight, bending, BendingPart::active)) == Approx(1.).epsilon(1e-14));
      CHECK(share(SpectralMembrane(straight, bending, BendingPart::passive)) == 0.);
      CHECK(share(SpectralMembrane(straight, bending, LayerSettings{.thickness = T})) == Approx(.5).epsilon(1e-14));
    }
}

TEST_CASE("bending thresholds: a broken sheet keeps its bending stiffness where layers are not coupled to the membrane")
{
  // Bent by kappa without membrane force, a sheet of stiffness g E in tension and E in compression shifts its neutral
  // layer to the side in compression; its rigidity is 4 g / (1 + sqrt g)^2 of the whole. The response is that of a
  // strip with nu = 0.
  const Moduli     straight{1., 1.};
  constexpr double kappa = .01 / T;
  const auto       keeps = [&](const auto &split, const double g) {
    double strain = 0.;
    for (int iteration = 0; iteration < 60; ++iteration)
      {
        const auto response = split.respond(sheet({strain, 0., 0.}, {kappa, 0., 0.}));
        strain -= degraded_stress(response, g).membrane[0] / degraded_tangent(response, g).membrane(0, 0);
      }
    const auto stress = degraded_stress(split.respond(sheet({strain, 0., 0.}, {kappa, 0., 0.})), g);
    CHECK(std::abs(stress.membrane[0]) < 1e-14);
    return stress.moment[0] / Koiter(straight, T).bend(sheet(flat, {kappa, 0., 0.})).moment[0];
  };
  for (const double g : {1., .25, .01, 1e-4})
    {
      const double exact = 4. * g / ((1. + std::sqrt(g)) * (1. + std::sqrt(g)));
      CAPTURE(g);
      CHECK(keeps(SpectralLayer(straight, T, 200), g) == Approx(exact).epsilon(1e-3));
      CHECK(keeps(SpectralLayer(straight, T), g) == Approx(exact).epsilon(.15));
    }
  // The surface stretch has no such coupling: half of the moment remains, however far the sheet is broken.
  const split::SurfaceStretch stretch(material::NeoHooke(straight), Koiter(straight, T), {.thickness = T});
  CHECK(keeps(stretch, 1e-4) == Approx(.5).epsilon(1e-3));
}

TEST_CASE("bending thresholds: tension that outweighs bending is all active, compression that does drives nothing")
{
  constexpr double kappa = .2, edge = .5 * T * kappa;
  for (const double sign : {1., -1.})
    {
      const auto point = sheet({sign * 1.01 * edge, sign * 1.01 * edge, 0.}, {kappa, .5 * kappa, 0.});
      for (const auto &r :
           {SpectralLayer(moduli, T).respond(point), VolumetricDeviatoricLayer(moduli, T).respond(point)})
        if (sign > 0.)
          CHECK(r.energy_passive == 0.);
        else
          CHECK(r.energy_active < .05 * r.energy_passive); // of the second one, distortion
      if (sign < 0.)
        CHECK(SpectralLayer(moduli, T).respond(point).energy_active == 0.);
    }
}

TEST_CASE("splits by strain: thickness, moduli and number of points are checked")
{
  for (const double bad : {0., -1., std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
      CHECK_THROWS_AS(SpectralLayer(Moduli{bad, 1.}), InvalidParameter);
      CHECK_THROWS_AS(SpectralLayer(moduli, bad), InvalidParameter);
      CHECK_THROWS_AS(VolumetricDeviatoricLayer(Moduli{1., bad}), InvalidParameter);
      CHECK_THROWS_AS(VolumetricDeviatoricLayer(moduli, bad), InvalidParameter);
      CHECK_THROWS_AS(SpectralMembrane(Moduli{1., bad}), InvalidParameter);
      CHECK_THROWS_AS(SpectralMembrane(moduli, koiter, {.thickness = bad}), InvalidParameter);
    }
  for (const int n_points : {-1, 0, 1})
    CHECK_THROWS_AS(SpectralLayer(moduli, T, n_points), InvalidParameter);
}
