// label: verification
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include <sherd/assembly/energy_balance.h>
#include <sherd/geometry/split.h>
#include <sherd/solve/critical_step.h>
#include <sherd/time/central_difference.h>

#include "body.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

using Explicit = Body<Glass, CentralDifference, ExplicitSolver<Glass>>;

/// Vibrations of the free displacements with a lumped mass, K v = omega^2 M v: a dense eigenvalue problem on one rank.
struct Vibrations
{
  std::vector<int> unknowns; ///< the free ones, block n_fields
  Eigen::VectorXd  omega;    ///< ascending
  Eigen::MatrixXd  shapes;   ///< a mode a column
};

template <class Model>
Vibrations vibrations(const Model &model, const ShellSpace<Model::degree, Model::spacedim> &space,
                      const Supports &supports, const State<Model::degree, Model::spacedim> &state)
{
  constexpr int                                           n_fields = Model::n_fields;
  const SupportedUnknowns<Model::degree, Model::spacedim> supported(supports, space);
  const Assembler<Model>                                  assembler(model, space, state.distribution, supported.ties());
  Matrix                                                  stiffness = assembler.make_matrix(), mass = stiffness;
  Vector force(state.distribution, n_fields), rest = state.acceleration;
  rest.fill(0.);
  assembler.linearise({state.position, rest, state.phase}, state.history, 0., PhaseTangent::consistent, force,
                      stiffness);
  assembler.mass_matrix(mass);
  const Vector lumped = lumped_mass(mass);
  Vibrations   result;
  for (int k = 0; k < state.distribution->n_owned() * n_fields; ++k)
    if (k % n_fields != Model::spacedim && !supported.fixed()[k])
      result.unknowns.push_back(k);
  const auto      n = static_cast<Eigen::Index>(result.unknowns.size());
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd root(n);
  for (Eigen::Index j = 0; j < n; ++j)
    root[j] = std::sqrt(lumped.local()[result.unknowns[j]]);
  Vector unit(state.distribution, n_fields), column = unit;
  for (Eigen::Index j = 0; j < n; ++j)
    {
      unit.fill(0.);
      unit.local()[result.unknowns[j]] = 1.;
      stiffness.multiply(unit, column);
      for (Eigen::Index i = 0; i < n; ++i)
        A(i, j) = column.local()[result.unknowns[i]] / (root[i] * root[j]);
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  result.omega  = solver.eigenvalues().cwiseMax(0.).cwiseSqrt();
  result.shapes = root.cwiseInverse().asDiagonal() * solver.eigenvectors();
  return result;
}

template <class Model>
double largest_frequency(const Model &model, const ShellSpace<Model::degree, Model::spacedim> &space,
                         const Supports &supports, const State<Model::degree, Model::spacedim> &state)
{
  const auto modes = vibrations(model, space, supports, state);
  return modes.omega[modes.omega.size() - 1];
}

/// A flat square sheet in space with n x n elements and the bending stiffness c.
struct Sheet
{
  models::Shell                 model;
  Environment                   env{MPI_COMM_WORLD};
  Surface<2, 3>                 surface;
  ShellSpace<2, 3>              space;
  Supports                      supports;
  Loads<3>                      loads;
  State<2, 3>                   state;
  ExplicitSolver<models::Shell> solver;

  Sheet(int n, double c, const Supports &supports_ = {})
      : model(split::SurfaceStretch(material::NeoHooke(1., .6), material::Canham(c), {.thickness = .01}),
              degradation::Cubic(1e-4), {}, 1e10, .2, 1.),
        surface(shapes::plate<2, 3>({1., 1.}, {n, n})),
        space(env, surface),
        supports(supports_),
        state(space),
        solver(model, space, supports, loads, CentralDifference(), {})
  {
    solver.rebuild(state);
  }

  double true_limit() const { return 2. / largest_frequency(model, space, supports, state); }
};

} // namespace

TEST_CASE("The largest explicit step is a safe bound, and not far below the limit")
{
  const auto check = [](double bound, double limit) {
    CAPTURE(bound, limit, bound / limit);
    CHECK(bound <= limit * (1. + 1e-10));
    CHECK(bound > .9 * limit); // 0.94 to 0.99, theory F.5
  };
  for (const auto &supports : {Supports(), held()})
    {
      Explicit body(unbreakable.model(), {2., 1.}, {8, 5}, {}, supports, {}, CentralDifference());
      check(body.solver.largest_step(), 2. / largest_frequency(body.model, body.space, body.supports, body.state));
    }
  Supports clamped;
  clamped.clamp("left");
  for (const double c : {1e-6, 1e-3, 1.})
    for (const auto &supports : {Supports(), clamped})
      {
        const Sheet sheet(6, c, supports);
        check(sheet.solver.largest_step(), sheet.true_limit());
      }
}

TEST_CASE("The explicit limit is proportional to h in a membrane and to h^2 in bending")
{
  const auto ratio = [](double c) { return Sheet(5, c).solver.largest_step() / Sheet(10, c).solver.largest_step(); };
  CHECK(ratio(1e-6) == Approx(2.).epsilon(.02));
  CHECK(ratio(1.) == Approx(4.).epsilon(.02));
}

TEST_CASE("Central differences are stable below the limit and not above it")
{
  // The scheme by itself, so that it may go beyond what the solver allows.
  Explicit                      body(unbreakable.model(), {2., 1.}, {6, 4}, {}, held(), {}, CentralDifference());
  const double                  limit = 2. / largest_frequency(body.model, body.space, body.supports, body.state);
  const SupportedUnknowns<2, 2> supported(body.supports, body.space);
  const auto                   &assembler = body.solver.assembler();
  Matrix                        matrix    = assembler.make_matrix();
  assembler.mass_matrix(matrix);
  const Vector mass   = lumped_mass(matrix);
  const auto   growth = [&](double dt) {
    const Stage stage = CentralDifference().stages(dt, dt).front();
    Motion      m{body.state.position, body.state.velocity, body.state.acceleration};
    Vector      rest = m.acceleration, force(body.state.distribution, 3);
    for (std::size_t i = 0; i < m.velocity.local().size(); ++i)
      if (!supported.fixed()[i / 2 * 3 + i % 2])
        m.velocity.local()[i] = 1e-7 * std::sin(37. * static_cast<double>(i * i));
    const double start = norm(m.velocity);
    double       most  = 0.;
    for (int step = 0; step < 300; ++step)
      {
        Motion next = predict(stage, m, m);
        assembler.force({next.position, rest, body.state.phase}, body.state.history, force);
        for (std::size_t i = 0; i < rest.local().size(); ++i)
          {
            const auto k = i / 2 * 3 + i % 2;
            accelerate(stage, next, i, supported.fixed()[k] ? 0. : -force.local()[k] / mass.local()[k]);
          }
        m    = next;
        most = std::max(most, norm(m.velocity) / start);
      }
    return most;
  };
  CHECK(growth(body.solver.largest_step()) < 10.);
  CHECK(growth(.99 * limit) < 100.);
  CHECK(growth(1.02 * limit) > 1e6);
}

TEST_CASE("Damping takes from a vibration its share of critical damping, and the books show it")
{
  // A mode of frequency omega loses exp(-2 b omega^2/2 t) of its energy, b = 2 xi / omega_max.
  const CentralDifference scheme(.2);
  for (const int which : {0, 10, -1}) // the lowest, one between, the highest
    {
      Explicit     body(unbreakable.model(), {2., 1.}, {4, 3}, {}, held(), {}, scheme);
      const auto   modes = vibrations(body.model, body.space, body.supports, body.state);
      const auto   last  = modes.omega.size() - 1;
      const auto   mode  = which < 0 ? last : which;
      const double omega = modes.omega[mode], limit = body.solver.largest_step();
      CHECK(limit <= scheme.largest_step(modes.omega[last]) * (1. + 1e-10));
      CHECK(limit > .9 * scheme.largest_step(modes.omega[last]));
      for (std::size_t i = 0; i < modes.unknowns.size(); ++i)
        body.state.velocity.local()[modes.unknowns[i] / 3 * 2 + modes.unknowns[i] % 3] =
            1e-6 * modes.shapes(static_cast<Eigen::Index>(i), mode);
      body.solver.set_initial_acceleration(body.state);
      EnergyBalance books(body.solver.energies(body.state));
      const double  start = books.state().now.kinetic;
      const int     n     = static_cast<int>(std::ceil(M_PI / (omega * .05 * limit))); // half a period
      const double  b     = scheme.stiffness_factor(modes.omega[last]);
      const double  dt    = M_PI / (omega * n);
      for (int i = 0; i < n; ++i)
        {
          const auto  result = take(body, dt);
          StepSummary step;
          step.work          = result.work;
          step.withheld_work = result.withheld_work;
          step.energies      = body.solver.energies(body.state);
          books.add(step);
        }
      const auto  &energies = books.state().now;
      const double left     = energies.kinetic + energies.elastic();
      CAPTURE(mode, omega, n * dt * omega, energies.kinetic, energies.elastic(), start);
      // The solver takes b from its bound of omega_max, up to 10 % above it, and the force is half a step late.
      CHECK(std::log(start / left) == Approx(b * omega * omega * n * dt).epsilon(.1));
      CHECK(books.dissipation() == Approx(start - left).epsilon(1e-6));
      CHECK(std::abs(books.closure()) < 1e-9);
    }
}

TEST_CASE("A step above the explicit limit is refused, with the reason")
{
  Explicit   body(Units().model(), {4., 4.}, {4, 4}, {}, {}, {}, CentralDifference());
  const auto limit = body.solver.largest_step();
  CHECK(std::isfinite(limit));
  const auto result = body.solver.attempt(body.state, 1.001 * limit);
  CHECK_FALSE(result.state);
  CHECK_THAT(result.failure, Catch::Contains("exceeds the largest stable one"));
  CHECK(body.solver.attempt(body.state, limit).state);
  CHECK(body.solver.attempt(body.state, limit * (1. + 1e-10)).state); // what is left up to a given time
  CHECK_FALSE(body.solver.attempt(body.state, std::numeric_limits<double>::quiet_NaN()).state);
}

TEST_CASE("Values that are not finite are a failed explicit step")
{
  const double bad   = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const int    which = GENERATE(0, 1, 2, 3, 4);
  CAPTURE(bad, which);
  Explicit     body(Units().model(), {4., 4.}, {4, 4}, {}, {}, {}, CentralDifference());
  const double dt       = body.solver.largest_step();
  Vector      *fields[] = {&body.state.position, &body.state.velocity, &body.state.acceleration, &body.state.phase};
  if (which < 4)
    fields[which]->local()[9] = bad;
  else
    body.state.history[3][2] = bad;
  const auto result = body.solver.attempt(body.state, dt);
  CHECK_FALSE(result.state);
  CHECK_FALSE(result.failure.empty());
  body.state = State<2, 2>(body.space);
  CHECK(body.solver.attempt(body.state, dt).state);
}

TEST_CASE("Explicit motion is of second order in time, also under changing steps")
{
  const auto swung = [](int n_cycles) {
    Explicit body(Units{100., .2, 1e10}.model(), {2., 1.}, {3, 2}, {}, held(), {}, CentralDifference());
    for (int a = 0; a < body.state.distribution->n_local(); ++a)
      {
        const auto X                           = body.reference(a);
        body.state.velocity.local()[2 * a]     = 4. * .3 * X[0] * std::cos(X[1]);
        body.state.velocity.local()[2 * a + 1] = X[0] * X[0];
      }
    body.solver.set_initial_acceleration(body.state);
    for (int c = 0; c < n_cycles; ++c)
      for (const double s : {1., 1.5, .5})
        take(body, .06 * s / (3. * n_cycles));
    return gather(body.state.position);
  };
  const auto a = swung(4), b = swung(8), c = swung(16);
  CHECK(std::log2(distance(a, b) / distance(b, c)) == Approx(2.).margin(.1));
}

TEST_CASE("Supports are followed and the balance of energy closes")
{
  const auto pull     = [](double t) { return 1e-4 * t * t / (.02 * .02); };
  Supports   supports = held();
  supports.prescribe("right", Component::x, pull);
  Loads<2> loads;
  loads.traction("top", [](const Point<2> &X, double t) { return Point<2>(0., .5 * t * X[0]); });
  loads.surface_load([](const Point<2> &, double) { return Point<2>(.1, 0.); });
  const double damping = GENERATE(0., .1);
  Explicit     body(unbreakable.model(), {2., 1.}, {4, 2}, {}, supports, loads, CentralDifference(damping));
  body.solver.set_initial_acceleration(body.state);

  StepWork     work;
  const int    n  = static_cast<int>(std::ceil(.02 / (.2 * body.solver.largest_step())));
  const double dt = .02 / n;
  for (int i = 0; i < n; ++i)
    work += take(body, i % 2 == 0 ? 1.2 * dt : .8 * dt).work;
  const double t = body.state.time;
  const auto   X = body.surface.control_points();
  const auto   x = gather(body.state.position), v = gather(body.state.velocity), a = gather(body.state.acceleration);
  for (const int point : points_along(body.surface, body.surface.edge("right")[0]))
    {
      CHECK(x[2 * point] - X(point, 0) == Approx(pull(t)).epsilon(1e-10));
      CHECK(v[2 * point] == Approx(2. * pull(t) / t).epsilon(1e-8));
      CHECK(a[2 * point] == Approx(2. * pull(t) / (t * t)).epsilon(1e-4));
    }
  const auto energies = body.solver.energies(body.state);
  REQUIRE(work.external.total() > 0.);
  CHECK(work.internal == Approx(work.external.total()).epsilon(1e-8));
  const double kept = (energies.kinetic + energies.elastic()) / work.external.total();
  CAPTURE(damping, kept);
  if (damping == 0.)
    CHECK(kept == Approx(1.).epsilon(1e-3));
  else
    CHECK((kept < 1. && kept > .9));
}

TEST_CASE("An explicit plate tears as an implicit one does")
{
  // From rest, opened smoothly within some passages of waves. A lumped mass makes waves slower: 4 % of the growth here,
  // 3 % with elements of half the size.
  const auto pull = [](double t) { return t * t / .24; };
  Supports   supports;
  supports.prescribe("top", Component::y, pull);
  supports.prescribe("bottom", Component::y, [=](double t) { return -pull(t); });
  struct Outcome
  {
    double growth, elastic, work, left; ///< of the crack; at the end; of the supports; what the balance leaves over
  };
  const auto run = [&](auto &body, double dt) {
    body.crack(PreCrack<2>({Segment<2>{{-3., 3.}, {4., 3.}}}, 1.));
    body.solver.equilibrate_phase(body.state);
    body.solver.set_initial_acceleration(body.state);
    const double start = body.solver.energies(body.state).fracture;
    const int    n     = static_cast<int>(std::ceil(.06 / dt));
    double       work = 0., withheld = 0.;
    for (int i = 0; i < n; ++i)
      {
        const auto result = take(body, .06 / n);
        work += result.work.external.total();
        withheld += result.withheld_work;
      }
    const auto e = body.solver.energies(body.state);
    return Outcome{e.fracture - start, e.elastic(), work,
                   e.elastic() + e.kinetic + e.fracture - start - work + withheld};
  };
  Explicit                   torn(Units().model(), {8., 6.}, {12, 9}, {}, supports, {}, CentralDifference());
  const auto                 by_forces = run(torn, .2 * torn.solver.largest_step());
  Body<Glass, AnyIntegrator> implicit(Units().model(), {8., 6.}, {12, 9}, {}, supports, {}, GeneralizedAlpha(.8));
  const auto                 by_newton = run(implicit, 5e-4);
  CAPTURE(by_forces.growth, by_newton.growth, by_forces.elastic, by_newton.elastic, by_forces.left, by_newton.left);
  REQUIRE(by_newton.growth > .5);
  CHECK(by_forces.growth == Approx(by_newton.growth).epsilon(.06));
  CHECK(by_forces.elastic == Approx(by_newton.elastic).epsilon(.02));
  CHECK(std::abs(by_forces.left) < 1e-3 * by_forces.work);
  CHECK(torn.is_stable());
}

TEST_CASE("Multipliers have no mass: the explicit solver refuses them")
{
  const Environment   env(MPI_COMM_WORLD);
  const auto          surface = split_patches(shapes::plate<2, 3>({1., 1.}, {4, 4}), {2, 1});
  const models::Shell model(
      split::SurfaceStretch(material::NeoHooke(1., .6), material::Canham(1e-3), {.thickness = .01}),
      degradation::Cubic(1e-4), {}, 1., .2, 1.);
  const ShellSpace<2, 3>        space(env, surface, continuity::LagrangeMultiplier());
  const Supports                none;
  const Loads<3>                loads;
  ExplicitSolver<models::Shell> solver(model, space, none, loads, CentralDifference(), {});
  CHECK_THROWS_WITH(solver.rebuild(State<2, 3>(space)), Catch::Contains("multipliers"));
}

TEST_CASE("Where the branch of the phase ends, an explicit step goes downhill even if Newton's method does not arrive")
{
  // Stretched a little beyond the peak of theory C.3, l0 H / Gc = 1/12, at which the intact phase ends. So few
  // iterations do not reach the false root above 1, nor any other.
  for (const int iterations : {2, 3})
    {
      NewtonSettings settings;
      settings.max_iterations = iterations;
      Explicit     body(Units().model(), {4., 4.}, {4, 4}, settings, {}, {}, CentralDifference());
      const double load    = .1;
      const double stretch = biaxial_stretch(load, body.model.split.bulk());
      body.deform([&](const Point<2> &X) { return Point<2>(stretch * X[0], stretch * X[1]); });
      REQUIRE(body.peak_load() == Approx(load).epsilon(1e-6));
      const auto result = body.solver.attempt(body.state, 1e-9);
      CAPTURE(iterations, result.failure, result.newton);
      REQUIRE(result.state);
      CHECK(result.switched == 1);
      body.state = *result.state;
      CHECK(body.is_stable());
      CHECK(body.smallest_phase() == Approx(homogeneous_phase(body.model.degradation, load, 1., 1.)).epsilon(1e-3));
      CHECK(body.largest_phase() == Approx(body.smallest_phase()).epsilon(1e-6));
    }
}
