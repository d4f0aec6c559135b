// label: verification
// ranks: 1 2
#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/fracture/homogeneous.h>
#include <sherd/time/quasi_static.h>

#include "body.h"

using namespace sherd;
using namespace sherd::test;

// A square plate is stretched equally in both directions by its edges, through the onset of damage and past the largest
// force. It is too small to localise and stays homogeneous, so that each step has a closed solution (theory C.3):
// Psi+ = K/4 (lambda^4 - 1 - 4 ln lambda), phi from its own equation, and half of g dPsi+/dlambda pulls on each
// direction. Nothing depends on the steps, and no inertia is left in the state.
TEST_CASE("Quasi-static steps follow the homogeneous solution past the peak")
{
  const Units  units;
  const double width = .3, bulk = units.moduli().bulk;
  const double onset   = biaxial_stretch(units.toughness / 12., bulk); // damage starts
  const auto   stretch = [&](double t) { return 1. + 2.5 * t * (onset - 1.); };

  Supports supports;
  supports.fix("left", Component::x);
  supports.fix("bottom", Component::y);
  supports.prescribe("right", Component::x, [&](double t) { return (stretch(t) - 1.) * width; });
  supports.prescribe("top", Component::y, [&](double t) { return (stretch(t) - 1.) * width; });
  auto settings             = tight(Preconditioner::mumps);
  settings.linear.tolerance = 1e-8;
  Body<Glass, QuasiStatic> body(units.model(), {width, width}, {3, 3}, settings, supports, {}, QuasiStatic());

  double largest = 0., last = 0.;
  int    switched = 0;
  for (const double dt : {.25, .15, .1, .05, .05, .1, .1, .1, .1})
    {
      auto result = body.solver.attempt(body.state, dt);
      INFO(result.failure);
      REQUIRE(result.state);
      body.state = *result.state;
      switched += result.switched;

      const double lambda = stretch(body.state.time);
      const double energy = bulk / 4. * (std::pow(lambda, 4) - 1. - 4. * std::log(lambda));
      const double phi    = homogeneous_phase(body.model.degradation, energy, units.toughness, 1.);
      CHECK(body.smallest_phase() == Approx(phi).epsilon(1e-8)); // Newton's tolerance times the softening modulus
      CHECK(body.largest_phase() == Approx(phi).epsilon(1e-8));

      const double force = width * body.model.degradation.value(phi) * .5 * bulk * (std::pow(lambda, 3) - 1. / lambda);
      CHECK(body.solver.reaction("right")[0] == Approx(force).epsilon(1e-7));
      CHECK(body.energies().kinetic == 0.);
      CHECK(norm(body.state.acceleration) == 0.);
      last    = force;
      largest = std::max(largest, force);
    }
  CHECK(last < .5 * largest); // well past the peak
  CHECK(switched > 0);        // the intact branch was left where it became unstable
}
