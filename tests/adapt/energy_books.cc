// label: verification
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// A free plate of 8 x 4 that swings in its plane, without cracks: l0 = Gc = rho = 1, E = 10^4.
struct SwingingPlate
{
  using Model = models::Plate;

  Environment       env{MPI_COMM_WORLD};
  Model             model{split::SurfaceStretch<material::NeoHooke>(material::NeoHooke(material::surface_moduli(1e4, .2))),
              degradation::Cubic(),
              {},
              1e6,
              1.,
              1.};
  Surface<2, 2>     plate = shapes::plate<2, 2>({8., 4.}, {8, 4});
  ShellSpace<2, 2>  space{env, plate};
  Supports          supports;
  Loads<2>          loads;
  State<2, 2>       state{space};
  Adaptivity<Model> adaptivity{plate, {.target = 1.}};
  StepController    controller;

  MonolithicSolver<Model, GeneralizedAlpha> solver;

  SwingingPlate(double rho_inf, double speed, const StepControlSettings &steps)
      : controller(steps), solver(model, space, supports, loads, GeneralizedAlpha(rho_inf), tight())
  {
    solver.rebuild(state);
    for (int a = 0; a < state.distribution->n_local(); ++a)
      {
        const auto X                  = plate.control_points().row(state.distribution->global(a)).eval();
        state.velocity.local()[2 * a] = speed * std::cos(std::numbers::pi * X[0] / 8.);
      }
    solver.set_initial_acceleration(state);
  }

  static NewtonSettings tight()
  {
    NewtonSettings settings;
    settings.displacement_tolerance = 1e-11;
    settings.linear.tolerance       = 1e-11;
    return settings;
  }

  StepSummary advance(double end) { return adaptivity.advance(solver, plate, space, state, controller, end); }
};

/// Frequency of the slowest mode: a bar of length 8.
const double omega = std::numbers::pi / 8. * std::sqrt(1e4);

} // namespace

TEST_CASE("Elastic vibration loses exactly what the dissipation says")
{
  const double  rho_inf = GENERATE(.5, 1.);
  SwingingPlate body(rho_inf, .01, {.initial = .3 / omega, .rule = StepRule::fixed});
  const double  start = body.solver.energies(body.state).kinetic;
  EnergyBalance books(body.solver.energies(body.state));
  for (const double end = 6. / omega; body.state.time < end;)
    books.add(body.advance(end));

  CAPTURE(rho_inf, books.balance(), books.dissipation() / start, books.inertial_dissipation() / start, books.closure());
  // Free, unloaded and never cracked: all that is missing has gone into the integrator.
  CHECK(books.external_work() == 0.);
  CHECK(books.refinement() == 0.);
  CHECK(std::abs(books.closure()) < 1e-9);
  if (rho_inf == .5)
    CHECK(books.dissipation() > .01 * start);
  else // amplitude 1e-4 of the wave speed: linear to about its square
    CHECK(std::abs(books.dissipation()) < 1e-6 * start);
}

TEST_CASE("Steps by error hold their tolerance, and given times are hit")
{
  SwingingPlate body(.8, .5, {.initial = .5 / omega, .rule = StepRule::error, .tolerance = 2e-7, .times = {.012, .03}});
  int           rejected = 0, n = 0;
  bool          hit[2] = {false, false};
  EnergyBalance books(body.solver.energies(body.state));
  std::vector<double> errors;
  for (const double end = 10. / omega; body.state.time < end; ++n)
    {
      const auto s = body.advance(end);
      books.add(s);
      rejected += s.rejected;
      errors.push_back(s.error);
      CHECK(s.error <= 2e-7);
      CHECK(s.attempts == 1 + s.rejected);
      hit[0] |= body.state.time == .012;
      hit[1] |= body.state.time == .03;
    }
  CAPTURE(n, rejected, *std::max_element(errors.begin(), errors.end()));
  CHECK(rejected > 0); // the first step is too large
  CHECK(*std::max_element(errors.begin(), errors.end()) > 5e-8);
  CHECK(hit[0]);
  CHECK(hit[1]);
  CHECK(std::abs(books.closure()) < 1e-9);
}
