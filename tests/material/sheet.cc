#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/spectral_layer.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>
#include <sherd/material/stiffness_field.h>
#include <sherd/verify/random_state.h>

#include <cmath>
#include <limits>

using namespace sherd;
using namespace sherd::material;

namespace
{
constexpr double E = 70e9, nu = .22, T = 2e-3;

/// Bending moment and membrane stress along x of a flat sheet, as stiffnesses: d M / d k_11 and d tau / d eps_11.
template <class Split>
std::pair<double, double> stiffnesses(const Split &split)
{
  const Voigt one(1., 1., 0.), flat = Voigt::Zero();
  const auto  response = split.respond(verify::ShellState{one, one, flat, flat}.point());
  const auto  tangent  = response.tangent_active + response.tangent_passive;
  return {tangent.bending(0, 0), tangent.membrane(0, 0)};
}
} // namespace

TEST_CASE("sheet: from the solid, from the surface and from the moduli themselves")
{
  const Sheet solid = sheet_of_solid(E, nu, T);
  CHECK(solid.moduli.bulk == Approx(E * T / (2. * (1. - nu))).epsilon(1e-15));
  CHECK(solid.moduli.shear == Approx(E * T / (2. * (1. + nu))).epsilon(1e-15));
  CHECK(solid.bending == Approx(E * T * T * T / (12. * (1. - nu * nu))).epsilon(1e-14));
  CHECK(solid.bending == Approx(flexural_rigidity(E, nu, T)).epsilon(1e-14));
  CHECK(solid.thickness == T);

  const Sheet surface = sheet_by_surface(E * T, nu, T);
  CHECK(surface.moduli.bulk == Approx(solid.moduli.bulk).epsilon(1e-15));
  CHECK(surface.bending == Approx(solid.bending).epsilon(1e-15));

  const Sheet given = sheet_by_moduli(3., 2., .5, .1);
  CHECK(given.moduli.bulk == 3.);
  CHECK(given.moduli.shear == 2.);
  CHECK(given.bending == .5);
  CHECK(given.thickness == .1);
}

TEST_CASE("sheet: every split can be made of one, with the stiffness of plate theory")
{
  const Sheet sheet = sheet_of_solid(E, nu, T);
  const auto  check = [&](const auto &split) {
    const auto [bending, membrane] = stiffnesses(split);
    CHECK(bending == Approx(sheet.bending).epsilon(1e-12));
    CHECK(membrane == Approx(E * T / (1. - nu * nu)).epsilon(1e-12));
    CHECK(split.bulk() == sheet.moduli.bulk);
    CHECK(split.shear() == sheet.moduli.shear);
  };
  check(split::None<NeoHooke, Canham>(sheet));
  check(split::None<StVenantKirchhoff, Koiter>(sheet));
  check(split::SurfaceStretch<NeoHooke, Canham>(sheet));
  check(split::SpectralMembrane<Koiter>(sheet));
  check(split::SpectralLayer(sheet));
  check(split::VolumetricDeviatoricLayer(sheet));
}

TEST_CASE("sheet: a bending modulus of its own is kept by bending laws and refused by layers")
{
  const Sheet soft = sheet_by_moduli(3., 2., .5e-3, .1); // a solid sheet has 4.2e-3
  CHECK(Canham(soft).stiffness() == .5e-3);
  CHECK(Koiter(soft).stiffness() == Approx(.5e-3).epsilon(1e-15));
  CHECK(stiffnesses(split::SpectralMembrane<Koiter>(soft)).first == Approx(.5e-3).epsilon(1e-13));
  CHECK_THROWS_WITH(split::SpectralLayer(soft), Catch::Contains("c = 5e-04 given") && Catch::Contains("bending law"));
  CHECK_THROWS_AS(split::VolumetricDeviatoricLayer(soft), InvalidParameter);
}

TEST_CASE("sheet: constants outside their range are refused")
{
  for (const double bad : {0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    {
      CHECK_THROWS_AS(sheet_by_moduli(bad, 1., 1., 1.), InvalidParameter);
      CHECK_THROWS_AS(sheet_by_moduli(1., bad, 1., 1.), InvalidParameter);
      CHECK_THROWS_AS(sheet_by_moduli(1., 1., bad, 1.), InvalidParameter);
      CHECK_THROWS_AS(sheet_by_moduli(1., 1., 1., bad), InvalidParameter);
      CHECK_THROWS_AS(sheet_of_solid(E, nu, bad), InvalidParameter);
      CHECK_THROWS_AS(sheet_by_surface(bad, nu, T), InvalidParameter);
      CHECK_THROWS_AS(Koiter(Sheet{{1., 1.}, bad, 1.}), InvalidParameter);
    }
  CHECK_THROWS_AS(sheet_of_solid(E, .5, T), InvalidParameter);
}

TEST_CASE("stiffness field: a factor by position scales energy, stress and tangent alike")
{
  const StiffnessField<2> graded([](const Point<2> &X) { return 1. + X[0]; }), plain,
      formula([](double x, double y) { return x * y; });
  CHECK(graded({.5, 0.}) == 1.5);
  CHECK(plain({.5, 0.}) == 1.);
  CHECK(formula({.5, 3.}) == 1.5);
  CHECK_THROWS_WITH(formula({.5, -2.}), Catch::Contains("stiffness factor -1 at X = (0.5, -2)"));
  CHECK_THROWS_AS(StiffnessField<2>(0.), InvalidParameter);

  verify::RandomNumbers random(81);
  const auto            point  = verify::random_shell_state(random, 1., .1).point();
  const auto            soft   = split::SpectralLayer(Moduli{1.7, .6}, .1).respond(point);
  const auto            stiff  = split::SpectralLayer(Moduli{5.1, 1.8}, .1).respond(point);
  const auto            scaled = 3. * soft;
  CHECK(scaled.energy_active == Approx(stiff.energy_active).epsilon(1e-14));
  CHECK(scaled.energy_passive == Approx(stiff.energy_passive).epsilon(1e-14));
  CHECK(scaled.stress_active.membrane.isApprox(stiff.stress_active.membrane, 1e-14));
  CHECK(scaled.stress_passive.moment.isApprox(stiff.stress_passive.moment, 1e-14));
  CHECK(scaled.tangent_active.coupling.isApprox(stiff.tangent_active.coupling, 1e-14));
  CHECK(scaled.tangent_passive.bending.isApprox(stiff.tangent_passive.bending, 1e-14));
  CHECK(scaled.driving.moment.isApprox(stiff.driving.moment, 1e-14));
}
