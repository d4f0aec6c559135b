// label: verification
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Everything a state consists of, to the bit.
std::vector<double> bits(const State<2, 2> &state, int n_elements)
{
  std::vector<double> all;
  for (const Vector *v : {&state.position, &state.velocity, &state.acceleration, &state.phase, &state.previous_phase})
    all.insert(all.end(), v->local().begin(), v->local().end());
  for (int e = 0; e < n_elements; ++e)
    all.insert(all.end(), state.history[e], state.history[e] + state.n_q);
  for (const double value : {state.time, state.step_size, 1. * state.step})
    all.push_back(value);
  return all;
}

/// Largest x of a control value below 0.1 near the line of the crack.
double tip(const CrackingPlate &body)
{
  double x = 0.;
  for (int a = 0; a < body.state.distribution->n_local(); ++a)
    {
      const Point<2> X = body.plate.control_points().row(body.state.distribution->global(a)).transpose();
      if (body.state.phase.local()[a] < .1 && std::abs(X[1] - 12.) < .6)
        x = std::max(x, X[0]);
    }
  return x;
}

} // namespace

TEST_CASE("Refinement refuses settings without meaning")
{
  const auto   plate = shapes::plate<2, 2>({4., 4.}, {2, 2});
  const double nan   = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(Adaptivity<Glass>(plate, {}), InvalidParameter);
  CHECK_THROWS_AS(Adaptivity<Glass>(plate, {.target = -1.}), InvalidParameter);
  CHECK_THROWS_AS(Adaptivity<Glass>(plate, {.target = nan}), InvalidParameter);
  CHECK_THROWS_AS(Adaptivity<Glass>(plate, {.target = 1., .halo = -1.}), InvalidParameter);
  CHECK_THROWS_AS(Adaptivity<Glass>(plate, {.target = 1., .halo = nan}), InvalidParameter);
}

TEST_CASE("Preparation refines to the target around the pre-crack and nowhere else")
{
  CrackingPlate body(MPI_COMM_WORLD, {.target = .5});
  body.prepare();
  const auto distance = [](const Point<2> &X) { return CrackingPlate::notch().distance(X); };
  CHECK(body.largest_edge([&](const Point<2> &X) { return distance(X) < 5.; }) == Approx(.5));
  // phi = 0.975 lies 5.6 l0 from the crack; functions there reach three coarse elements of 2 l0 further at most.
  CHECK(body.largest_edge([&](const Point<2> &X) { return distance(X) > 5.6 + 6.; }) == Approx(2.));
  CHECK(body.solver.assembler().shortest_edge() == Approx(.5));

  // History afresh from the polyline, nothing transferred.
  int n_inside = 0;
  for (int e = 0; e < body.space.n_active_elements(); ++e)
    for (int q = 0; q < body.state.n_q; ++q)
      {
        const auto   X = body.solver.assembler().quadrature_position(e, q);
        const double H = CrackingPlate::notch().history(X, body.model.degradation, 1.);
        CHECK(body.state.history[e][q] == H);
        n_inside += H > 0.;
      }
  CHECK(n_inside > 50);
  CHECK(body.state.step == 0);
  CHECK(body.state.time == 0.);
  // Three l0 of crack, and the cap around its tip.
  CHECK(body.energies().fracture > 3.);
  CHECK(body.energies().fracture < 5.);
}

TEST_CASE("Without a pre-crack preparation changes nothing")
{
  CrackingPlate body(MPI_COMM_WORLD, {.target = .5});
  body.prepare(PreCrack<2>({}, 1.));
  CHECK(body.plate.n_elements() == 60);
  CHECK(body.energies().fracture == Approx(0.).margin(1e-20));
  CHECK(body.state.phase.local()[7] == 1.);
}

TEST_CASE("A pre-crack between the control points of a very coarse mesh is found")
{
  // Elements of 16 l0: no control point is close enough to feel a crack on the edge between two of them.
  auto                                      plate = shapes::plate<2, 2>({64., 64.}, {4, 4});
  const Glass                               model = CrackingPlate::glass();
  ShellSpace<2, 2>                          space(Environment(MPI_COMM_WORLD), plate);
  Supports                                  supports;
  Loads<2>                                  loads;
  State<2, 2>                               state(space);
  Adaptivity<Glass>                         adaptivity(plate, {.target = .5});
  MonolithicSolver<Glass, GeneralizedAlpha> solver(model, space, supports, loads, GeneralizedAlpha(.5), {});
  adaptivity.prepare(solver, plate, space, state, PreCrack<2>({Segment<2>{{31.5, 32.}, {32.5, 32.}}}, 1.));
  CHECK(solver.assembler().shortest_edge() == Approx(.5));
  CHECK(solver.energies(state).fracture > 1.);
  CHECK(plate.n_elements() < 3000);
}

TEST_CASE("A pre-crack that no quadrature point feels is an error")
{
  // Elements of 2 l0 with Gauss points at y = 12.225 and 13.
  CrackingPlate coarse(MPI_COMM_WORLD, {.target = 4.});
  CHECK_THROWS_AS(coarse.prepare(PreCrack<2>({Segment<2>{{0., 12.5}, {3., 12.5}}}, 1.)), InvalidParameter);
  CrackingPlate outside(MPI_COMM_WORLD, {.target = .5});
  CHECK_THROWS_AS(outside.prepare(PreCrack<2>({Segment<2>{{0., 60.}, {3., 60.}}}, 1.)), InvalidParameter);
}

TEST_CASE("Refinement at a frozen displacement keeps the fracture energy")
{
  // Once for a mesh that has just what the crack needs, once with everything refined.
  CrackingPlate body(MPI_COMM_WORLD, {.target = .5});
  body.prepare();
  const auto before  = body.energies();
  auto       global  = gather(body.state, body.space);
  const auto targets = span_targets(body.plate, .5);
  for (auto marked = coarse_points(body.plate, targets); !marked.empty(); marked = coarse_points(body.plate, targets))
    {
      const auto boxes = element_boxes(body.plate);
      global           = transfer(global, boxes, body.plate.refine_to(marked, targets), body.plate);
    }
  body.space.rebuild();
  body.state = distribute(global, body.space);
  body.solver.rebuild(body.state);
  CHECK(body.plate.n_elements() == 20 * 48);
  // The same functions have the same energy, to rounding.
  CHECK(body.energies().fracture == Approx(before.fracture).epsilon(1e-9));
  body.solver.equilibrate_phase(body.state);
  CHECK(body.energies().fracture == Approx(before.fracture).epsilon(5e-3));
}

TEST_CASE("A crack grows, the mesh follows, and the books balance")
{
  CrackingPlate body(MPI_COMM_WORLD, {.target = .5, .halo = 1.});
  body.prepare();
  EnergyBalance books(body.energies());
  const double  start    = tip(body);
  const int     elements = body.plate.n_elements();
  int           refined = 0, repeated = 0, n = 0;
  double        previous = body.state.time;
  while (body.state.time < .3)
    {
      const auto s = body.advance(.3);
      books.add(s);
      refined += s.refined;
      repeated += s.repeated;
      CHECK(body.state.time == Approx(previous + s.dt));
      CHECK(s.attempts == 1 + s.rejected + s.repeated);
      CHECK(s.dt <= body.controller.largest() * (1. + 1e-12));
      previous = body.state.time;
      ++n;
      // Forces on the supports are those of the step, also where the mesh was refined after it; above and below are
      // alike but for the rounding of the mesh.
      const auto top = body.solver.reaction("top"), bottom = body.solver.reaction("bottom");
      CHECK(top[1] > 0.);
      CHECK(bottom[1] == Approx(-top[1]).epsilon(1e-3));
      // paper Eq. (13); the last two steps are cut to end in time.
      if (s.refined > 0 && body.state.time < .25)
        CHECK(body.controller.step() == Approx(.2 * s.dt));
    }
  CHECK(body.state.time == .3);
  CHECK(body.state.step == n);
  CHECK(tip(body) > start + 2.);
  CHECK(refined > repeated); // some steps were accepted first
  CHECK(body.plate.n_elements() > elements);
  CHECK(std::abs(books.balance()) < .02);
  // What is left over is the integrator's, but for the residuals that Newton's method leaves: 1e-6 of the reactions.
  CHECK(books.dissipation() > 0.);
  CHECK(std::abs(books.closure()) < 1e-5);
  // Along the whole way the crack has met fine elements only.
  CHECK(body.largest_edge([&](const Point<2> &X) { return std::abs(X[1] - 12.) < 1. && X[0] < tip(body); }) ==
        Approx(.5));
}

TEST_CASE("A step that ran into coarse elements is repeated on fine ones")
{
  // Triggers so late that the crack is there before the mesh.
  CrackingPlate body(MPI_COMM_WORLD,
                     {.target = .5, .phase = .5, .halo = 1., .recompute_phase = .9, .history_fraction = 50.});
  body.prepare();
  int repeated = 0;
  while (body.state.time < .3 && repeated == 0)
    {
      const auto   before = bits(body.state, body.space.n_active_elements());
      const int    step   = body.state.step;
      const double time   = body.state.time;
      const auto   s      = body.advance(.3);
      repeated            = s.repeated;
      CHECK(body.state.step == step + 1);
      CHECK(body.state.time == Approx(time + s.dt));
      if (repeated > 0)
        {
          CHECK(s.refined >= s.repeated);
          CHECK(s.attempts == 1 + s.rejected + s.repeated);
        }
    }
  CHECK(repeated > 0);
}

TEST_CASE("A step that cannot converge leaves the state as it was")
{
  CrackingPlate body(MPI_COMM_WORLD, {.target = .5});
  body.prepare();
  body.advance(1.);
  NewtonSettings settings;
  settings.max_iterations         = 1;
  settings.displacement_tolerance = 1e-14;
  settings.phase_tolerance        = 1e-14;
  MonolithicSolver<Glass, GeneralizedAlpha> hopeless(body.model, body.space, body.supports, body.loads,
                                                     GeneralizedAlpha(.5), settings);
  hopeless.rebuild(body.state);
  const auto before = bits(body.state, body.space.n_active_elements());
  CHECK_FALSE(hopeless.attempt(body.state, 1e-3).state);
  CHECK(bits(body.state, body.space.n_active_elements()) == before);
  CHECK_THROWS_AS(body.adaptivity.advance(hopeless, body.plate, body.space, body.state, body.controller, 1.),
                  NoConvergence);
  CHECK(bits(body.state, body.space.n_active_elements()) == before);
}
