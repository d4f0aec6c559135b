// label: verification
#include <catch2/catch.hpp>

#include <cmath>
#include <string>

#include <sherd/geometry/shapes/sphere.h>
#include <sherd/solve/instances.h>
#include <sherd/time/backward_euler.h>
#include <sherd/time/bathe.h>
#include <sherd/time/hht.h>
#include <sherd/time/wbz.h>

#include <solve/breathing_sphere.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

constexpr double modulus = 10., nu = .3, c = 1e-5, pressure = .1, period = 1.175476;
constexpr double K = .5 * modulus / (1. - nu), G = .5 * modulus / (1. + nu);
constexpr double end = .4 * period;

/// Sizes of steps that repeat, up to the end.
const std::vector<double> constant = {1.}, alternate = {1., 1.5, .5}, sawtooth = {1., 1.5, 2.25, 3.375, 5.0625, 1.0125};

struct Sphere
{
  models::Shell    model{split::SurfaceStretch(material::NeoHooke(K, G), material::Canham(c), {.thickness = 1e-4}),
                      degradation::Cubic(1e-4),
                      {},
                      1.,
                      .2,
                      1.};
  Environment      env{MPI_COMM_WORLD};
  int              n; ///< elements of a patch each way
  Surface<2, 3>    surface = shapes::sphere<2>(1., n);
  ShellSpace<2, 3> space{env, surface};
  Supports         none;
  Loads<3>         loads;

  explicit Sphere(int n_) : n(n_)
  {
    loads.pressure([](const Point<3> &, double) { return pressure; }, PressureRelease::none);
  }

  /// Mean stretch at the end after @p n_cycles of the pattern.
  template <class Solver, class Integrator>
  double stretch(const Integrator &integrator, const std::vector<double> &pattern, int n_cycles)
  {
    NewtonSettings settings;
    settings.displacement_tolerance = 1e-9;
    State<2, 3> state(space);
    Solver      solver(model, space, none, loads, integrator, settings);
    solver.rebuild(state);
    solver.set_initial_acceleration(state);
    double sum = 0.;
    for (const double s : pattern)
      sum += s;
    for (int cycle = 0; cycle < n_cycles; ++cycle)
      for (const double s : pattern)
        {
          auto result = solver.attempt(state, end * s / (sum * n_cycles));
          INFO(result.failure);
          REQUIRE(result.state);
          state = std::move(*result.state);
        }
    const auto [low, high] = stretches(surface, state, n);
    return .5 * (low + high);
  }
};

} // namespace

// Theory J.5, J.8.
TEST_CASE("A sphere under a step of pressure follows its equation of motion at second order in time")
{
  using Implicit = MonolithicSolver<models::Shell, AnyIntegrator>;
  struct Run
  {
    std::string         name;
    AnyIntegrator       integrator;
    std::vector<double> pattern;
    int                 n_cycles;
  };
  const auto run =
      GENERATE(Run{"generalized-alpha", GeneralizedAlpha(.5), constant, 8},
               Run{"generalized-alpha, changing steps", GeneralizedAlpha(.5), alternate, 4},
               Run{"generalized-alpha, growing steps", GeneralizedAlpha(.5), sawtooth, 3},
               Run{"HHT, changing steps", HHT(-.1), alternate, 4}, Run{"WBZ, growing steps", WBZ(.5), sawtooth, 3},
               Run{"Bathe, changing steps", Bathe(), alternate, 3});
  Sphere     sphere(2);
  const auto value = [&](int factor) {
    return sphere.stretch<Implicit>(run.integrator, run.pattern, factor * run.n_cycles);
  };
  const double a = value(1), b = value(2), d = value(4);
  const double exact = Breathing(K, c, pressure).stretch(end), amplitude = .00703277;
  CAPTURE(run.name, (a - exact) / amplitude, (b - exact) / amplitude, (d - exact) / amplitude);
  CHECK(std::log2((a - b) / (b - d)) == Approx(2.).margin(.05));
  CHECK(std::abs(d - exact) < 6e-3 * amplitude); // 4e-3 of it by so few elements
}

TEST_CASE("Backward Euler lags behind at first order, central differences follow")
{
  Sphere       sphere(2);
  const double exact = Breathing(K, c, pressure).stretch(end), amplitude = .00703277;
  const auto   value = [&](int n_steps) {
    return sphere.stretch<MonolithicSolver<models::Shell, AnyIntegrator>>(AnyIntegrator(BackwardEuler()), constant,
                                                                          n_steps);
  };
  const double a = value(10), b = value(20), d = value(40);
  CHECK(std::log2((a - b) / (b - d)) == Approx(1.).margin(.25));
  CHECK(std::abs(d - exact) > 1e-2 * amplitude);

  // A lumped mass adds an error of its own that falls with h: 6 % and 3 % of the amplitude.
  const auto by_forces = [&](int n) {
    return std::abs(Sphere(n).stretch<ExplicitSolver<models::Shell>>(CentralDifference(), constant, 60) - exact) /
           amplitude;
  };
  const double coarse = by_forces(2), fine = by_forces(4);
  CAPTURE(coarse, fine);
  CHECK(coarse < .07);
  CHECK(fine < .5 * coarse);
}
