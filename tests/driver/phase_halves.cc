// label: unit
#include <catch2/catch.hpp>

#include <atomic>
#include <memory>

#include <sherd/driver/case_model.h>
#include <sherd/driver/case_plate.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/none.h>
#include <sherd/time/generalized_alpha.h>

using namespace sherd;

namespace
{

/// No split, and counts how often it is asked.
struct Counting
{
  split::None<material::NeoHooke>    law{material::NeoHooke(material::surface_moduli(1e4, .2))};
  std::shared_ptr<std::atomic<long>> calls = std::make_shared<std::atomic<long>>(0);

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    ++*calls;
    return law.respond(point);
  }
  double bulk() const { return law.bulk(); }
  double shear() const { return law.shear(); }
};

/// A plate whose upper edge is pulled.
template <class Solver, class Integrator>
struct Pulled
{
  using Model = CaseModel<2, 2>;

  Environment      env{MPI_COMM_SELF};
  Counting         counting;
  Model            model{split::Any<2>(counting), degradation::Any(), crack_density::Any(), 1., 1., 1.};
  Surface<2, 2>    surface = shapes::plate<2, 2>({6., 4.}, {6, 4});
  ShellSpace<2, 2> space{env, surface};
  Supports         supports;
  Loads<2>         loads;
  State<2, 2>      state{space};
  Solver           solver;

  explicit Pulled(const Integrator &integrator) : solver(model, space, supports, loads, integrator, NewtonSettings())
  {
    supports.fix("bottom");
    loads.traction("top", [](const Point<2> &, double) -> Point<2> { return {0., 5.}; });
    solver.rebuild(state);
    solver.set_initial_acceleration(state);
  }

  /// How often a step asks the material at each quadrature point.
  long passes(double dt)
  {
    const long before = *counting.calls;
    const auto result = solver.attempt(state, dt);
    INFO(result.failure);
    REQUIRE(result.state);
    const long calls = *counting.calls - before, n_points = surface.n_elements() * state.n_q;
    state = *result.state;
    CHECK(calls % n_points == 0);
    return calls / n_points;
  }

  long evaluations()
  {
    auto timers = solver.timers().statistics(MPI_COMM_SELF);
    return timers["assembly"].calls + timers["residual"].calls;
  }
};

} // namespace

TEST_CASE("An explicit step asks the material twice: what drives the phase, and the forces")
{
  Pulled<ExplicitSolver<CaseModel<2, 2>>, CentralDifference> body{CentralDifference()};
  const double                                               dt = .5 * body.solver.largest_step();
  body.passes(dt); // with the forces at the start
  CHECK(body.passes(dt) == 2);
  CHECK(body.passes(dt) == 2);
}

TEST_CASE("Iterations for the phase do not ask the material")
{
  Pulled<StaggeredSolver<CaseModel<2, 2>, AnyIntegrator>, AnyIntegrator> body{GeneralizedAlpha(.5)};
  for (int step = 0; step < 3; ++step)
    {
      const long before = body.evaluations(), passes = body.passes(1e-3);
      CHECK(passes < body.evaluations() - before);
    }
}
