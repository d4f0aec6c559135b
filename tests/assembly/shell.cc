// label: unit
// ranks: 1 2 3
#include <numbers>

#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/space/local_ties.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

using ShellBody = ModelBody<Shell>;

/// A quarter of a roof with hanging lines; x = 2 and y = 0 are planes of symmetry.
Surface<2, 3> quarter_roof()
{
  auto roof = shapes::roof<2>(3., 4., 40. * std::numbers::pi / 180., {3, 3}, shapes::Fit::exact, shapes::Part::quarter);
  refine_at_random(roof, 2, 2, 11);
  return roof;
}

Supports symmetric_supports()
{
  Supports supports;
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  return supports;
}

/// A twist and a stretch.
Eigen::Matrix3d gradient()
{
  return (Eigen::Matrix3d() << 1.1, .1, 0., -.05, 1.05, .1, .1, 0., .98).finished();
}

/// One load of each kind, growing with time.
Loads<3> all_loads()
{
  Loads<3> loads;
  loads.traction("top", [](const Point<3> &X, double t) -> Point<3> { return t * Point<3>(1. + X[1], -2., X[0]); });
  loads.surface_load([](const Point<3> &X, double t) -> Point<3> { return t * Point<3>(X[0] * X[1], 3., -1.); });
  loads.gravity(1.7, Point<3>(0., 0., -9.81));
  loads.point_load(Point<3>(.7, 0., 3.), [](double t) { return Point<3>(t, 2., -3.); });
  loads.pressure([](const Point<3> &X, double t) { return .3 * t + .1 * X[0]; }, PressureRelease::none);
  loads.pressure([](const Point<3> &X, double) { return .5 + .1 * X[1]; }, PressureRelease::by_phase);
  loads.edge_moment("left", [](const Point<3> &X, double t) { return .4 * t + .1 * X[1]; });
  loads.edge_moment("bottom", [](const Point<3> &X, double) { return .2 * X[0]; });
  return loads;
}

/// c = R c_free for all fields.
Eigen::MatrixXd tie_matrix(const std::vector<Tie> &ties, int n_points)
{
  Eigen::MatrixXd R = Eigen::MatrixXd::Identity(4 * n_points, 4 * n_points);
  for (const auto &tie : ties)
    {
      R(4 * tie.point + tie.field, 4 * tie.point + tie.field) = 0.;
      for (std::size_t k = 0; k < tie.masters.size(); ++k)
        R(4 * tie.point + tie.field, 4 * tie.masters[k] + tie.field) = tie.factors[k];
    }
  return R;
}

Eigen::VectorXd stacked(const ShellBody::FieldValues &values)
{
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}

struct Assembled
{
  Eigen::VectorXd force, external;
  Eigen::MatrixXd matrix;
};

/// Through the assembler, on all ranks.
Assembled assemble(const ShellBody &body, const Loads<3> *loads = nullptr, double time = 1.)
{
  auto f = body.make_force(), external = body.make_force();
  auto K = body.assembler.make_matrix();
  f.fill(3.); // what was there before does not count
  external.fill(2.);
  K.values()[0]     = 5.;
  const auto values = loads ? body.assembler.evaluate(*loads, time) : LoadValues<Shell>();
  body.assembler.linearise(body.level(), body.state.history, .7, PhaseTangent::consistent, values, f, external, K);
  return {stacked(body.on_all_ranks(f)), stacked(body.on_all_ranks(external)), dense(K)};
}

double largest(const Eigen::MatrixXd &values)
{
  return values.cwiseAbs().maxCoeff();
}

} // namespace

TEST_CASE("Forces and matrix of a shell are the sums over the elements")
{
  const auto surface = quarter_roof();
  REQUIRE(surface.patch(0).basis.functions_of(most_loaded_element(surface)).size() > 12);
  ShellBody  body(MPI_COMM_WORLD, surface, shell(Toughness<3>([](double x, double y, double z) { return z + x * y; })));
  const auto state    = random_state(surface, gradient());
  body.state          = distribute(state, body.space);
  const auto expected = assemble_dense(body, state, .7);
  const auto system   = assemble(body);
  // Sums of some ten numbers of either sign.
  CHECK(largest(system.matrix - expected.matrix) < 1e-13 * largest(expected.matrix));
  CHECK(largest(system.force - expected.force) < 1e-13 * largest(expected.force));
  CHECK(largest(stacked(body.force()) - expected.force) < 1e-13 * largest(expected.force));
  CHECK(largest(system.external) == 0.);
}

TEST_CASE("With ties the system is that of the free control values")
{
  const auto surface = quarter_roof();
  const auto tied    = ties(symmetric_supports(), surface);
  REQUIRE(std::any_of(tied.begin(), tied.end(), [](const Tie &tie) { return tie.masters.size() > 1; }));
  const auto R     = tie_matrix(tied, surface.n_control_points());
  const auto state = random_state(surface, gradient());
  ShellBody  body(MPI_COMM_WORLD, surface, shell(), tied), free(MPI_COMM_WORLD, surface, shell());
  body.state       = distribute(state, body.space);
  free.state       = distribute(state, free.space);
  const auto plain = assemble_dense(body, state, .7);

  Eigen::MatrixXd expected = R.transpose() * plain.matrix * R;
  for (const auto &tie : tied)
    {
      const int i = 4 * tie.point + tie.field;
      CHECK(largest(expected.row(i)) == 0.);
      CHECK(largest(expected.col(i)) == 0.);
      expected(i, i) = 1.;
    }
  const auto system = assemble(body);
  CHECK(largest(system.matrix - expected) < 1e-13 * largest(expected));
  CHECK(largest(system.force - R.transpose() * plain.force) < 1e-13 * largest(plain.force));
  CHECK(largest(stacked(body.force()) - R.transpose() * plain.force) < 1e-13 * largest(plain.force));
  for (const auto &tie : tied)
    {
      const int i = 4 * tie.point + tie.field;
      CHECK(system.force[i] == 0.);
      CHECK(system.matrix(i, i) == 1.);
      CHECK(largest(system.matrix.row(i)) == 1.);
      CHECK(system.matrix.row(i).cwiseAbs().sum() == 1.);
      CHECK(system.matrix.col(i).cwiseAbs().sum() == 1.);
    }

  // Loads, and the mass.
  const auto            loads      = all_loads();
  const auto            tied_loads = assemble(body, &loads), free_loads = assemble(free, &loads);
  const Eigen::VectorXd external = R.transpose() * free_loads.external;
  CHECK(largest(tied_loads.external - external) < 1e-13 * largest(external));
  CHECK(largest(stacked(body.loads(loads, 1.)) - external) < 1e-13 * largest(external));
  const Eigen::MatrixXd stiffness = R.transpose() * (free_loads.matrix - plain.matrix) * R;
  REQUIRE(largest(stiffness) > .1);
  CHECK(largest(tied_loads.matrix - system.matrix - stiffness) < 1e-13 * largest(expected));
  const auto mass = [](const ShellBody &b) {
    auto M = b.assembler.make_matrix();
    b.assembler.mass_matrix(M);
    return dense(M);
  };
  Eigen::MatrixXd M = R.transpose() * mass(free) * R;
  for (int A = 0; A < surface.n_control_points(); ++A)
    {
      M.row(4 * A + 3).setZero();
      M.col(4 * A + 3).setZero();
      M(4 * A + 3, 4 * A + 3) = 1.;
    }
  for (const auto &tie : tied)
    M(4 * tie.point + tie.field, 4 * tie.point + tie.field) = 1.;
  CHECK(largest(mass(body) - M) < 1e-13);
}

TEST_CASE("The tangent of the loads is the derivative of the assembled external force, ties included")
{
  const auto surface   = quarter_roof();
  const bool with_ties = GENERATE(false, true);
  const auto tied      = with_ties ? ties(symmetric_supports(), surface) : std::vector<Tie>();
  const auto R         = tie_matrix(tied, surface.n_control_points());
  const auto state     = random_state(surface, gradient());
  ShellBody  body(MPI_COMM_WORLD, surface, shell(), tied);
  body.state = distribute(state, body.space);

  Loads<3>   loads;
  const auto kind = GENERATE(0, 1, 2, 3);
  if (kind == 0)
    loads = all_loads();
  else if (kind == 1)
    loads.pressure([](const Point<3> &X, double t) { return .3 * t + .1 * X[0]; }, PressureRelease::by_phase);
  else if (kind == 2)
    loads.edge_moment("left", [](const Point<3> &X, double t) { return .4 * t + .1 * X[1]; });
  else
    loads.traction("top", [](const Point<3> &X, double t) -> Point<3> { return t * Point<3>(1. + X[1], -2., X[0]); });
  CAPTURE(with_ties, kind);

  const int       n = surface.n_control_points();
  std::mt19937    random(3);
  Eigen::VectorXd free(4 * n);
  for (auto &value : free)
    value = symmetric(random);
  for (const auto &tie : tied)
    free[4 * tie.point + tie.field] = 0.;
  const Eigen::VectorXd d        = R * free;
  const auto            external = [&](double h) {
    auto moved = state;
    for (int A = 0; A < n; ++A)
      {
        moved.position.row(A) += h * d.segment<3>(4 * A).transpose();
        moved.phase[A] += h * d[4 * A + 3];
      }
    body.state = distribute(moved, body.space);
    return stacked(body.loads(loads, 2.));
  };
  const auto            with = assemble(body, &loads, 2.), without = assemble(body);
  const Eigen::VectorXd derivative = -(with.matrix - without.matrix) * free;
  CHECK(largest(with.external - external(0.)) <= 1e-14 * largest(with.external));
  CHECK(largest(with.force - without.force) == 0.);
  if (kind == 3)
    CHECK(largest(with.matrix - without.matrix) == 0.);
  else
    REQUIRE(largest(derivative) > 1e-2);
  // The difference of two matrices is rounded like the stiffness.
  const auto check = verify::check_derivative(external, derivative, 1e-3, 8);
  CAPTURE(check.order, check.smallest_defect);
  CHECK(check.passed());
}

TEST_CASE("Dead loads have the resultants they were declared with")
{
  ShellBody  body(MPI_COMM_WORLD, quarter_roof(), shell());
  const auto resultant = [&](const auto &declare) {
    Loads<3> loads;
    declare(loads);
    const auto f = body.loads(loads, 2.);
    CHECK(f.col(3).cwiseAbs().maxCoeff() == 0.);
    return Eigen::Vector3d(f.leftCols<3>().colwise().sum().transpose());
  };
  const double          arc = 3. * 40. * std::numbers::pi / 180., area = 2. * arc;
  const Eigen::Vector3d t(1., -2., .5);
  // The Gauss rule measures arcs of spline elements to 1e-9.
  CHECK((resultant(
             [&](auto &loads) { loads.traction("right", [&](const auto &, double s) { return Point<3>(s * t); }); }) -
         2. * arc * t)
            .norm() < 1e-6);
  CHECK((resultant([&](auto &loads) { loads.surface_load([&](const auto &, double s) { return Point<3>(s * t); }); }) -
         2. * area * t)
            .norm() < 1e-6);
  CHECK((resultant([&](auto &loads) { loads.gravity(1.7, t); }) - 1.7 * area * t).norm() < 1e-6);
  CHECK((resultant([&](auto &loads) {
           loads.point_load({2., 0., 3.}, [&](double s) { return Point<3>(s * t); });
         }) -
         2. * t)
            .norm() < 1e-14);
  Loads<3> away;
  away.point_load({2., 0., 3.3}, [](double) { return Point<3>(0., 0., 1.); });
  CHECK_THROWS_AS(body.assembler.evaluate(away, 0.), InvalidParameter);
}

TEST_CASE("Ranks change nothing but rounding, threads not a bit: shells with ties and loads")
{
  const auto surface = quarter_roof();
  const auto tied    = ties(symmetric_supports(), surface);
  const auto state   = random_state(surface, gradient());
  const auto loads   = all_loads();
  ShellBody  here(MPI_COMM_SELF, surface, shell(), tied);
  here.state          = distribute(state, here.space);
  const auto expected = assemble(here, &loads);
  Assembled  one;
  for (const int n : {1, 2})
    {
      const Threads threads(n);
      ShellBody     body(MPI_COMM_WORLD, surface, shell(), tied);
      body.state        = distribute(state, body.space);
      const auto system = assemble(body, &loads);
      CHECK(largest(system.matrix - expected.matrix) <= 1e-14 * largest(expected.matrix));
      CHECK(largest(system.force - expected.force) <= 1e-14 * largest(expected.force));
      CHECK(largest(system.external - expected.external) <= 1e-14 * largest(expected.external));
      CHECK(largest(stacked(body.loads(loads, 1.)) - expected.external) <= 1e-14 * largest(expected.external));
      CHECK(body.energies().elastic() == Approx(here.energies().elastic()).epsilon(1e-13));
      CHECK(body.energies().fracture == Approx(here.energies().fracture).epsilon(1e-13));
      if (n == 1)
        one = system;
      CHECK(one.matrix == system.matrix);
      CHECK(one.force == system.force);
      CHECK(one.external == system.external);
    }
}
