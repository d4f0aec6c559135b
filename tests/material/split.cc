#include <catch2/catch.hpp>

#include <sherd/material/split/none.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/verify/random_state.h>

#include <cmath>

using namespace sherd;
using material::NeoHooke;

namespace
{
const NeoHooke                        law(1.7, .6);
const split::SurfaceStretch<NeoHooke> surface_stretch(law);
const split::None<NeoHooke>           none(law);

/// Equal stretches in both directions and a little shear, so that both parts of the energy are at work.
SurfacePoint<2> stretched(const double J)
{
  return verify::MetricState{Voigt(1., 1., 0.), Voigt(J, std::hypot(1., .1) * J, .1 * J)}.point();
}
} // namespace

TEMPLATE_TEST_CASE("split: active and passive parts sum to the undegraded law", "", split::None<NeoHooke>,
                   split::SurfaceStretch<NeoHooke>)
{
  const TestType        split(law);
  verify::RandomNumbers random(21);
  for (int n = 0; n < 20; ++n)
    {
      const auto point = verify::random_state(random, n % 2 ? 1.3 : .7).point();

      const auto parts = split.respond(point);

      const auto whole = law.dilatation(point) + law.deviator(point);
      CHECK(parts.energy_active + parts.energy_passive == Approx(whole.energy).epsilon(1e-15));
      CHECK((parts.stress_active + parts.stress_passive).membrane.isApprox(whole.stress.membrane, 1e-15));
      CHECK((parts.tangent_active + parts.tangent_passive).membrane.isApprox(whole.tangent.membrane, 1e-15));
      CHECK(parts.driving.membrane == parts.stress_active.membrane);
    }
  CHECK(split.bulk() == 1.7);
  CHECK(split.shear() == .6);
}

TEST_CASE("split by surface stretch: all is active where the surface is stretched")
{
  verify::RandomNumbers random(22);
  for (int n = 0; n < 20; ++n)
    {
      const auto point = verify::random_state(random, 1.3).point();

      const auto parts = surface_stretch.respond(point);

      CHECK(point.J > 1.);
      CHECK(parts.energy_passive == 0.);
      CHECK(parts.stress_passive.membrane.norm() == 0.);
      CHECK(parts.tangent_passive.membrane.norm() == 0.);
    }
}

TEST_CASE("split by surface stretch: dilatation is passive where the surface is compressed")
{
  verify::RandomNumbers random(23);
  for (int n = 0; n < 20; ++n)
    {
      const auto point = verify::random_state(random, .7).point();

      const auto parts = surface_stretch.respond(point);

      CHECK(point.J < 1.);
      CHECK(parts.energy_passive == law.dilatation(point).energy);
      CHECK(parts.energy_active == law.deviator(point).energy);
      CHECK(parts.stress_passive.membrane == law.dilatation(point).stress.membrane);
      CHECK(parts.stress_active.membrane == law.deviator(point).stress.membrane);
    }
}

TEST_CASE("split by surface stretch: pure compression drives no crack, pure tension does")
{
  const auto pressed = verify::MetricState{Voigt(1., 1., 0.), Voigt(.8, .8, 0.)}.point();
  const auto pulled  = verify::MetricState{Voigt(1., 1., 0.), Voigt(1.2, 1.2, 0.)}.point();

  CHECK(surface_stretch.respond(pressed).energy_active == 0.);
  CHECK(surface_stretch.respond(pressed).driving.membrane.norm() == 0.);
  CHECK(surface_stretch.respond(pulled).energy_active > 0.);
  CHECK(none.respond(pressed).energy_active > 0.);
}

TEST_CASE("split by surface stretch: energies and stresses are continuous at J = 1")
{
  // The jump from J = 1 - x to J = 1 + x of a continuous function with bounded slope shrinks with x.
  double last_jump = 10.;
  for (const double x : {1e-2, 1e-4, 1e-6, 1e-8})
    {
      const double at_one = 1. / stretched(1.).J;
      const auto   below  = surface_stretch.respond(stretched(at_one * (1. - x)));
      const auto   above  = surface_stretch.respond(stretched(at_one * (1. + x)));

      const double jump = std::abs(above.energy_active - below.energy_active) +
                          std::abs(above.energy_passive - below.energy_passive) +
                          (above.stress_active.membrane - below.stress_active.membrane).norm() +
                          (above.stress_passive.membrane - below.stress_passive.membrane).norm();
      CHECK(jump < 10. * x);
      CHECK(jump < .02 * last_jump);
      last_jump = jump;
    }
}

TEST_CASE("split by surface stretch: rounding of J = 1 does not toggle the tangent of an unloaded crack")
{
  const auto rest    = verify::MetricState{Voigt(1., 1., 0.), Voigt(1., 1., 0.)}.point();
  const auto rounded = verify::MetricState{Voigt(1., 1., 0.), Voigt(1. - 4e-16, 1., 0.)}.point();

  CHECK(rounded.J_minus_1 < 0.);
  CHECK(surface_stretch.respond(rounded).tangent_passive.membrane.norm() == 0.);
  CHECK(surface_stretch.respond(rest).tangent_passive.membrane.norm() == 0.);
}

TEST_CASE("split: stress and tangent of the damaged surface weigh the parts")
{
  const auto parts = surface_stretch.respond(stretched(.8));

  const auto stress  = degraded_stress(parts, .25);
  const auto tangent = degraded_tangent(parts, .25);

  CHECK(stress.membrane.isApprox(.25 * parts.stress_active.membrane + parts.stress_passive.membrane, 1e-15));
  CHECK(tangent.membrane.isApprox(.25 * parts.tangent_active.membrane + parts.tangent_passive.membrane, 1e-15));
}
