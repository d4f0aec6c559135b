// label: verification
#include <cmath>
#include <optional>

#include <catch2/catch.hpp>

#include <sherd/assembly/energy_balance.h>

#include "body.h"
#include "linear_benchmarks.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

const continuity::Penalty                by_default;
const std::optional<continuity::Penalty> strong;

/// Half of a unit square, 0 < y < 1/2. At @p skew 1 the lines u = const cross the side y = 1/2 up to 23 degrees off the
/// right angle.
template <int degree>
Surface<degree, 3> half_plate(int n, double skew)
{
  return interpolate<degree, 3>(shapes::uniform_knots<degree>(n), shapes::uniform_knots<degree>(n),
                                [&](double u, double v) {
                                  const double s = u / n, t = v / n;
                                  const double shift = 1.5 * skew * s * (1. - s) * (1. - 2. * s) * t * (t - .5);
                                  return Eigen::Vector4d(s + shift, .5 * t, 0., 1.);
                                });
}

/// Relative error of the deflection at the centre of a clamped unit square with D = 1 under a unit load; one half of it
/// with a plane of symmetry, both conditions weak or both strong.
template <int degree>
double clamped_error(int n, const std::optional<continuity::Penalty> &weak, double skew = 0.)
{
  constexpr double exact = 1.26531908e-3;
  Supports         supports;
  supports.fix(WholeSurface{}, Component::x);
  supports.fix(WholeSurface{}, Component::y);
  for (const auto edge : {"left", "right", "bottom"})
    weak ? supports.clamp_weakly(edge, *weak) : supports.clamp(edge);
  weak ? supports.symmetry_weakly("top", Component::y, *weak) : supports.symmetry("top", Component::y);
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., t); });
  KoiterBody<degree> body(12. * (1. - .3 * .3), .3, 1., half_plate<degree>(n, skew), supports, loads);
  return body.displacement(body.solver.solve_linear(body.state, 1.), .5 * n, n)[2] / exact - 1.;
}

/// Scordelis-Lo roof, a quarter with both of its symmetries weak.
template <int degree>
double weak_roof(int n)
{
  const auto whole = roof<degree>(n);
  Supports   supports;
  for (const auto component : {Component::y, Component::z})
    supports.fix("left", component);
  supports.symmetry_weakly("right", Component::x);
  supports.symmetry_weakly("bottom", Component::y);
  KoiterBody<degree> body(4.32e8, 0., .25, whole.surface, supports, whole.loads);
  return -body.displacement(body.solver.solve_linear(body.state, 1.), n, n)[2];
}

/// Fracture energy of a plate of @p width x 8 with a crack through it that has a kink at @p kink, by the width.
double kinked_crack(double width, double kink, const Supports &supports)
{
  Body<Glass> body(Units().model(), {width, 8.}, {static_cast<int>(2. * width), 16}, {}, supports);
  body.crack(PreCrack<2>({Segment<2>{{kink, 2.5}, {kink + 9., 7.}}, Segment<2>{{kink, 2.5}, {kink - 9., 7.}}}, 1.));
  body.solver.equilibrate_phase(body.state);
  const auto energies = body.energies();
  return (energies.fracture + energies.constraint) / width;
}

} // namespace

// The error of a penalty is in proportion to h / beta and has the sign of a softer plate.
TEST_CASE("Weak edges: a clamped plate with a plane of symmetry")
{
  for (const int n : {8, 16})
    {
      const double quadratic = clamped_error<2>(n, strong), weakly = clamped_error<2>(n, by_default);
      const double cubic = clamped_error<3>(n, strong), cubic_weakly = clamped_error<3>(n, by_default);
      CAPTURE(n, quadratic, weakly, cubic, cubic_weakly);
      CHECK(std::abs(weakly - quadratic) < 8e-3 / n);
      CHECK(std::abs(cubic_weakly - cubic) < 8e-4 / n);
      CHECK(std::abs(weakly) < 1.1 * std::abs(quadratic) + 1e-3);
    }
  const double at_100 = clamped_error<3>(8, continuity::Penalty{1e2, 0.}),
               at_1e3 = clamped_error<3>(8, continuity::Penalty{1e3, 0.}), limit = clamped_error<3>(8, strong);
  CHECK((at_100 - limit) / (at_1e3 - limit) == Approx(10.).epsilon(.05));
  CHECK(at_1e3 > limit);
}

// Where parameter lines cross the plane askew, splines that are level across it have little freedom left along it, so
// that smaller factors are better on coarse meshes. theory G.5
TEST_CASE("Weak edges: parameter lines may cross a plane of symmetry at any angle")
{
  const continuity::Penalty soft{1e3, 0.};
  CHECK_THROWS_AS(clamped_error<3>(8, strong, 1.), InvalidParameter);
  const double coarse = clamped_error<3>(8, soft, 1.), fine = clamped_error<3>(16, soft, 1.),
               stiff = clamped_error<3>(16, by_default, 1.);
  CAPTURE(coarse, fine, stiff);
  CHECK(std::abs(coarse) < .03);
  CHECK(std::abs(fine) < 1e-3);
  CHECK(std::abs(stiff) < .008);
}

TEST_CASE("Weak edges: quarter of the Scordelis-Lo roof")
{
  // Strong, the same elements on a quarter: 0.300586 and 0.300592 for degree 3, 0.3003 for degree 2 (theory J.2).
  const double coarse = weak_roof<3>(8), fine = weak_roof<3>(16), quadratic = weak_roof<2>(16);
  CAPTURE(coarse, fine, quadratic);
  CHECK(coarse == Approx(.300586).epsilon(2e-5));
  CHECK(fine == Approx(.300592).epsilon(2e-5));
  CHECK(quadratic == Approx(.3003).epsilon(3e-4));
}

// A penalty is a spring of stiffness eps = beta D / h: the strip turns by less than its edge is asked to.
TEST_CASE("Weak edges: a strip whose end is turned becomes an arc of a circle")
{
  constexpr double length = 12., thickness = .1, modulus = 1.2e6, beta = 1e2;
  constexpr int    n = 12;
  Supports         supports;
  supports.clamp("left");
  supports.rotate("right", [](double t) { return M_PI * t; }, {beta, 0.});
  KoiterBody<3> body(modulus, 0., thickness, shapes::plate<3, 3>({length, 1.}, {n, 1}), supports, {});
  const double  D = modulus * thickness * thickness * thickness / 12., eps = beta * D * n / length;
  auto          state        = body.state;
  int           n_iterations = 0;
  for (const double target : {.5, 1.})
    {
      state = follow_loads(body.solver, state, target, LoadStepSettings{.first = .05, .largest = .1},
                           [&](const auto &, int iterations) { n_iterations += iterations; });
      // Koiter's energy E T (s^2 - 1)^2 / 8 + D (s theta')^2 / 2 of an arc with the turn theta' by reference length is
      // stationary in the stretch s at s^2 = 1 - T^2 theta'^2 / 6 and carries the moment D s^2 theta'.
      double angle = M_PI * target, stretch = 1.;
      for (int i = 0; i < 30; ++i)
        {
          stretch = std::sqrt(1. - std::pow(thickness * angle / length, 2) / 6.);
          angle   = M_PI * target - std::asin(D * stretch * stretch * angle / length / eps);
        }
      const double radius = stretch * length / angle;
      const auto   u      = body.displacement(state, n, .5);
      CAPTURE(target, u[0] + length, radius * std::sin(angle), -u[2], radius * (1. - std::cos(angle)), n_iterations);
      CHECK(u[0] + length == Approx(radius * std::sin(angle)).margin(2e-3));
      CHECK(-u[2] == Approx(radius * (1. - std::cos(angle))).margin(2e-3)); // towards -n
      CHECK(std::abs(u[1]) <= 1e-6);
    }
}

TEST_CASE("Weak edges: an edge that turns does the work that the strip takes up")
{
  const material::Moduli moduli{100., 60.};
  const models::Shell model(split::SurfaceStretch(material::NeoHooke(moduli), material::Canham(.5), {.thickness = .1}),
                            degradation::Cubic(1e-4), {}, 1e10, 1., 1.);
  const Environment   env(MPI_COMM_WORLD);
  const auto          strip = shapes::plate<2, 3>({4., 1.}, {8, 2});
  const ShellSpace<2, 3> space(env, strip);
  Supports               supports;
  supports.clamp_weakly("left");
  constexpr double end = 2.;
  supports.rotate("right", [](double t) { return .4 * (1. - std::cos(M_PI * t / end)); });
  const Loads<3>                                    none;
  State<2, 3>                                       state(space);
  MonolithicSolver<models::Shell, GeneralizedAlpha> solver(model, space, supports, none, GeneralizedAlpha(1.), {});
  solver.rebuild(state);
  EnergyBalance books(solver.energies(state));
  for (int step = 0; step < 80; ++step)
    {
      auto result = solver.attempt(state, end / 80.);
      INFO(result.failure);
      REQUIRE(result.state);
      state = std::move(*result.state);
      StepSummary summary;
      summary.energies      = solver.energies(state);
      summary.work          = result.work;
      summary.withheld_work = result.withheld_work;
      books.add(summary);
    }
  const auto energies = solver.energies(state);
  CAPTURE(books.external_work(), energies.elastic(), energies.kinetic, energies.constraint, books.balance());
  CHECK(books.external_work() > .01);
  CHECK(energies.constraint < .05 * books.external_work());
  CHECK(std::abs(books.balance()) < .01);
}

// The natural condition of the fourth-order density is not symmetry: it lets the phase leave the plane with a slope.
TEST_CASE("Weak edges: a crack that hits a plane of symmetry costs what that of the whole body does")
{
  Supports weakly, strongly;
  weakly.symmetry_weakly("left", Component::x);
  strongly.phase_symmetry("left");
  const double whole = kinked_crack(12., 6., {}), half = kinked_crack(6., 0., strongly),
               weak = kinked_crack(6., 0., weakly), natural = kinked_crack(6., 0., {});
  CAPTURE(whole, half, weak, natural);
  CHECK(half == Approx(whole).epsilon(1e-5));
  CHECK(weak == Approx(whole).epsilon(1e-3));
  CHECK(natural < .995 * whole);
}
