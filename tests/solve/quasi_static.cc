// label: verification
// ranks: 1 2
#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/fracture/homogeneous.h>
#include <sherd/geometry/split.h>
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

namespace
{

/// A bar of length 2 and height 1 that is kept from moving across, so that sigma = (K + G) factor(x) du/dx, pulled by a
/// strain so small that it is linear. Two patches: the strain may jump in the middle.
struct Bar
{
  static constexpr double elongation = 1e-6;

  Environment                          env{MPI_COMM_WORLD};
  Glass                                model;
  Surface<2, 2>                        surface = split_patches(shapes::plate<2, 2>({2., 1.}, {4, 2}), {2, 1});
  ShellSpace<2, 2>                     space{env, surface, continuity::None{}};
  Supports                             supports;
  Loads<2>                             loads;
  State<2, 2>                          state{space};
  MonolithicSolver<Glass, QuasiStatic> solver;

  explicit Bar(StiffnessField<2> stiffness)
      : model(Units().model()), solver(model, space, supports, loads, QuasiStatic(), tight(Preconditioner::mumps))
  {
    model.stiffness = std::move(stiffness);
    supports.fix(WholeSurface{}, Component::y);
    supports.fix("left", Component::x);
    supports.prescribe("right", Component::x, [](double t) { return t * elongation; });
    solver.rebuild(state);
    auto result = solver.attempt(state, 1.);
    INFO(result.failure);
    REQUIRE(result.state);
    state = *result.state;
  }
  Bar(const Bar &) = delete;

  double modulus() const { return model.split.bulk() + model.split.shear(); }

  /// Reaction over that of a bar with factor 1.
  double stiffness() const { return solver.reaction("right")[0] / (modulus() * elongation / 2.); }

  /// Largest difference of the displacement of control points that lie at x = 1 from @p expected, over the elongation.
  double error_in_the_middle(double expected) const
  {
    double error = 0.;
    for (int a = 0; a < state.distribution->n_owned(); ++a)
      if (const double X = surface.control_points()(state.distribution->global(a), 0); std::abs(X - 1.) < 1e-12)
        error = std::max(error, std::abs((state.position.local()[2 * a] - X) / elongation - expected));
    return error;
  }
};

} // namespace

TEST_CASE("Stiffnesses in series, graded and side by side: exact solutions")
{
  constexpr double tolerance = 2e-6; // of the strain, by which the solution is not linear

  Bar series(StiffnessField<2>([](double x, double) { return x < 1. ? 1. : 4.; }));
  CHECK(series.stiffness() == Approx(1.6).epsilon(tolerance)); // 2 / (1 + 1/4)
  CHECK(series.error_in_the_middle(.8) < tolerance);
  CHECK(series.solver.energies(series.state).elastic() ==
        Approx(.5 * 1.6 * series.modulus() * Bar::elongation * Bar::elongation / 2.).epsilon(tolerance));

  // factor = 1 / (1 + x): du/dx = c (1 + x), which quadratic splines represent; the integral of 1 + x is 4.
  const Bar graded(StiffnessField<2>([](double x, double) { return 1. / (1. + x); }));
  CHECK(graded.stiffness() == Approx(2. / 4.).epsilon(tolerance));
  CHECK(graded.error_in_the_middle(1.5 / 4.) < tolerance);

  // A stiff half-plane: the strain is the same above and below, the forces add.
  const Bar halves(StiffnessField<2>([](double, double y) { return y < .5 ? 1. : 9.; }));
  CHECK(halves.stiffness() == Approx(5.).epsilon(tolerance));
  CHECK(halves.error_in_the_middle(.5) < tolerance);
  CHECK(halves.solver.rayleigh_speed() == Approx(3. * series.solver.rayleigh_speed() / 2.).epsilon(1e-14));
}
