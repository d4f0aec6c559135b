// label: verification
// ranks: 1 3
#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/assembly/step_work.h>

using namespace sherd;
using namespace sherd::test;

TEST_CASE("Work of external forces adds up by load")
{
  ExternalWork sum;
  sum += {2., {}};
  CHECK(sum.loads.empty());
  sum += {1., {3., 5.}};
  sum += {.5, {1., 1.}};
  CHECK(sum.supports == 3.5);
  CHECK(sum.loads == std::vector{4., 6.});
  CHECK(sum.of_loads() == 10.);
  CHECK(sum.total() == 13.5);
}

TEST_CASE("A plate that moves as a whole: every force does its own work")
{
  // Homogeneous stretch, phase and acceleration on 4 x 4; then all of it moves by d and the phase by a constant.
  Body           body(MPI_COMM_WORLD, crowded_plate());
  const double   area = 16., phi = .7, change = -.05, H = 2.;
  const Point<2> d(.1, -.2), acceleration(3., 4.);
  auto           state         = random_state(body.surface, stretch(1.1, 1.05), 0.);
  state.acceleration.rowwise() = acceleration.transpose().eval();
  state.phase.setConstant(phi);
  state.history.setConstant(H);
  body.state = distribute(state, body.space);

  Loads<2> loads;
  loads.traction("top", [](const Point<2> &, double t) { return Point<2>(0., 3. * t); });
  loads.gravity(1.7, {0., -10.});
  loads.traction("right", [](const Point<2> &, double) { return Point<2>(5., 1.); });
  const double time  = 2.;
  auto         total = body.make_force(), external = total;
  body.assembler.force(body.level(), body.state.history, body.assembler.evaluate(loads, time), total, external);
  Vector displacement = body.state.position, phase_change = body.state.phase;
  for (int a = 0; a < body.state.distribution->n_local(); ++a)
    {
      phase_change.local()[a] = change;
      for (int c = 0; c < 2; ++c)
        displacement.local()[a * 2 + c] = d[c];
    }
  const BalancedForces forces{body.level(), time, total, external};
  const auto           is_held = [&](std::size_t k) {
    return k % 3 == 0 && body.surface.control_points()(body.state.distribution->global(k / 3), 0) == 0.;
  };
  const auto work = step_work(body.assembler, loads, forces, is_held, displacement, phase_change);

  REQUIRE(work.external.loads.size() == 3);
  CHECK(work.external.loads[0] == Approx(4. * 6. * d[1]).epsilon(1e-12));
  CHECK(work.external.loads[1] == Approx(-17. * area * d[1]).epsilon(1e-12));
  CHECK(work.external.loads[2] == Approx(4. * (5. * d[0] + d[1])).epsilon(1e-12));
  CHECK(work.inertial == Approx(1.7 * area * acceleration.dot(d)).epsilon(1e-12));
  const degradation::Cubic g;
  const double             phase_work = area * (g.first(phi) * H + 1.1 / (2. * .4) * (phi - 1.)) * change;
  CHECK(work.internal == Approx(work.inertial + phase_work).epsilon(1e-12));

  // The supports on the left exert the horizontal force that is missing there.
  const auto values  = body.force();
  const auto applied = body.loads(loads, time);
  double     missing = 0.;
  for (int i = 0; i < body.surface.n_control_points(); ++i)
    if (body.surface.control_points()(i, 0) == 0.)
      missing += values(i, 0) - applied(i, 0);
  REQUIRE(std::abs(missing) > .1);
  CHECK(work.external.supports == Approx(missing * d[0]).epsilon(1e-12));

  // A single load has the work of all.
  const auto alone = loads.only(2);
  body.assembler.external_force(body.level(), body.assembler.evaluate(alone, time), external);
  const auto single =
      step_work(body.assembler, alone, {body.level(), time, total, external}, is_held, displacement, phase_change);
  REQUIRE(single.external.loads.size() == 1);
  CHECK(single.external.loads[0] == Approx(work.external.loads[2]).epsilon(1e-12));
}

TEST_CASE("Bending energy is what the change of curvature adds, degraded or not")
{
  const auto energies = [](double c, double height, double phi) {
    const models::Shell      model(StretchSplit(material::NeoHooke(2.1, 1.3), material::Canham(c), {.thickness = .2}),
                                   degradation::Cubic(), {}, 1.1, .4, 1.7);
    ModelBody<models::Shell> body(MPI_COMM_WORLD, shapes::plate<2, 3>({2., 3.}, {4, 6}), model);
    for (int a = 0; a < body.state.distribution->n_local(); ++a)
      {
        const auto X = body.surface.control_points().row(body.state.distribution->global(a)).eval();
        body.state.position.local()[3 * a]     = 1.1 * X[0];
        body.state.position.local()[3 * a + 1] = .97 * X[1];
        body.state.position.local()[3 * a + 2] = height * std::sin(X[0]) * std::cos(X[1]);
        body.state.phase.local()[a]            = phi;
      }
    return body.energies();
  };
  for (const double phi : {1., .4})
    {
      const auto flat = energies(.02, 0., phi), bent = energies(.02, .4, phi), stiff = energies(.06, .4, phi);
      CHECK(std::abs(flat.bending) < 1e-14 * flat.elastic());
      CHECK(bent.bending > .01 * bent.elastic());
      CHECK(bent.membrane() + bent.bending == Approx(bent.active + bent.passive).epsilon(1e-13));
      CHECK(stiff.bending == Approx(3. * bent.bending).epsilon(1e-12));
      CHECK(stiff.membrane() == Approx(bent.membrane()).epsilon(1e-12));
    }
}
