// label: unit
// ranks: 1 2 3
#include <catch2/catch.hpp>

#include <assembly/body.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

Surface<2, 2> refined_annulus()
{
  auto surface = quarter_annulus<2, 2>(1., 3.);
  refine_everywhere(surface, 1);
  refine_at_random(surface, 2, 2, 5);
  return surface;
}

} // namespace

TEST_CASE("Forces and matrix are the sums over the elements")
{
  const bool rational = GENERATE(false, true);
  Body       body(MPI_COMM_WORLD, rational ? refined_annulus() : crowded_plate(),
                  sheet(Toughness<2>([](double x, double y) { return 1. + .1 * x * y; })));
  if (!rational)
    {
      // Elements of the usual number of functions and wider ones take different paths.
      const auto &basis = body.surface.patch(0).basis;
      REQUIRE(basis.functions_of(most_loaded_element(body.surface)).size() == 16);
      REQUIRE(basis.functions_of(0).size() <= 12);
    }
  const auto state    = random_state(body.surface, stretch(1.15, 1.05, .1));
  body.state          = distribute(state, body.space);
  const auto expected = assemble_dense(body, state, .7);

  auto f = body.make_force();
  auto K = body.assembler.make_matrix();
  f.fill(3.); // what was there before does not count
  K.values()[0] = 5.;
  body.assembler.linearise(body.level(), body.state.history, .7, PhaseTangent::consistent, f, K);
  const Eigen::MatrixXd matrix = dense(K);
  // Sums of some ten numbers of either sign.
  CHECK((matrix - expected.matrix).cwiseAbs().maxCoeff() < 1e-13 * expected.matrix.cwiseAbs().maxCoeff());
  const auto force = gather(f);
  REQUIRE(static_cast<Eigen::Index>(force.size()) == expected.force.size());
  const Eigen::Map<const Eigen::VectorXd> assembled(force.data(), expected.force.size());
  CHECK((assembled - expected.force).cwiseAbs().maxCoeff() < 1e-13 * expected.force.cwiseAbs().maxCoeff());
  const auto without_matrix = body.force();
  CHECK((Eigen::Map<const Eigen::VectorXd>(without_matrix.data(), without_matrix.size()) - expected.force)
            .cwiseAbs()
            .maxCoeff() < 1e-13 * expected.force.cwiseAbs().maxCoeff());
  // Entries of the graph without an element in common would be zero: there are none.
  CHECK(((matrix.array() != 0.) == (expected.matrix.array() != 0.)).all());
}

TEST_CASE("The mass matrix")
{
  Body       body(MPI_COMM_WORLD, crowded_plate());
  const auto state = random_state(body.surface, stretch(1., 1.));
  body.state       = distribute(state, body.space);
  auto M           = body.assembler.make_matrix();
  body.assembler.mass_matrix(M);
  const auto mass = dense(M);
  const int  n    = body.surface.n_control_points();

  // Blocks: rho int N_A N_B on the displacements, 1 on the diagonal of the phase, nothing between fields.
  const auto      with = assemble_dense(body, state, 1.).matrix, without = assemble_dense(body, state, 0.).matrix;
  Eigen::MatrixXd expected = with - without;
  for (int A = 0; A < n; ++A)
    expected(3 * A + 2, 3 * A + 2) = 1.;
  CHECK((mass - expected).cwiseAbs().maxCoeff() < 1e-13);

  // Rows sum to the mass of a control point, all to that of the plate.
  double total = 0.;
  for (int A = 0; A < n; ++A)
    {
      double row = 0.;
      for (int B = 0; B < n; ++B)
        row += mass(3 * A, 3 * B);
      total += row;
      const int a = body.state.distribution->local(A);
      if (a >= 0 && a < body.state.distribution->n_owned())
        CHECK(row == Approx(1.7 * body.assembler.point_area()[a]).epsilon(1e-12));
    }
  CHECK(total == Approx(1.7 * 16.).epsilon(1e-13));

  Eigen::VectorXd v(3 * n);
  for (int A = 0; A < n; ++A)
    v.segment<3>(3 * A) << state.velocity(A, 0), state.velocity(A, 1), 0.;
  CHECK(body.energies().kinetic == Approx(.5 * v.dot(mass * v)).epsilon(1e-12));
}

TEST_CASE("Areas, phase scales and the shortest edge")
{
  const auto Gc = [](double x, double y) { return 1. + .1 * x * y; };
  const Body body(MPI_COMM_WORLD, crowded_plate(), sheet(Toughness<2>(Gc)));
  double     sums[2] = {0., 0.};
  for (int a = 0; a < body.state.distribution->n_owned(); ++a)
    {
      CHECK(body.assembler.point_area()[a] > 0.);
      sums[0] += body.assembler.point_area()[a];
      sums[1] += body.assembler.phase_scale()[a];
    }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  CHECK(sums[0] == Approx(16.).epsilon(1e-13));
  CHECK(sums[1] == Approx((16. + .1 * 64.) / .8).epsilon(1e-6)); // int Gc / (2 l0), but for the quadrature of x y

  auto plain = shapes::plate<2, 2>({4., 4.}, {4, 4});
  refine_at_random(plain, 2, 3, 73);
  CHECK(Body(MPI_COMM_WORLD, plain).assembler.shortest_edge() == Approx(.25).epsilon(1e-13));
}

TEST_CASE("The history after a step is the larger of old and new")
{
  Body       body(MPI_COMM_WORLD, crowded_plate());
  const auto state     = random_state(body.surface, stretch(1.2, 1.1));
  body.state           = distribute(state, body.space);
  const auto committed = body.assembler.committed(body.level(), body.state.history);

  auto none = body.state.history;
  for (int e = 0; e < body.space.n_active_elements(); ++e)
    std::fill_n(none[e], 9, 0.);
  const auto energy = body.assembler.committed(body.level(), none);
  int        n_old = 0, n_new = 0;
  for (int e = 0; e < body.space.n_active_elements(); ++e)
    for (int q = 0; q < 9; ++q)
      {
        CHECK(energy[e][q] > 0.);
        CHECK(committed[e][q] == std::max(energy[e][q], body.state.history[e][q]));
        (committed[e][q] == energy[e][q] ? n_new : n_old) += 1;
      }
  CHECK(n_new > 0);

  // Unloading changes nothing any more.
  body.state.position = State<2, 2>(body.space).position;
  const auto unloaded = body.assembler.committed(body.level(), committed);
  for (int e = 0; e < body.space.n_active_elements(); ++e)
    for (int q = 0; q < 9; ++q)
      CHECK(unloaded[e][q] == committed[e][q]);
}

TEST_CASE("Suspect is an element with a point that is loaded above the onset and intact")
{
  Body         body(MPI_COMM_WORLD, crowded_plate());
  const double onset  = 1.1 / (2. * .4 * (6. - 4e-4));
  const int    target = 7; // in the numbering of the surface
  int          local  = -1;
  for (int e = 0; e < body.space.n_active_elements(); ++e)
    if (body.space.distribution().elements[e] == target)
      local = e;
  const auto found = [&] { return body.assembler.suspects(body.level(), body.state.history).active; };

  CHECK(found().empty());
  if (local >= 0)
    body.state.history[local][4] = .999 * onset;
  CHECK(found().empty());
  if (local >= 0)
    body.state.history[local][4] = 1.001 * onset;
  CHECK(found() == (local >= 0 ? std::vector<int>{local} : std::vector<int>{}));
  const auto suspects = body.assembler.suspects(body.level(), body.state.history);
  CHECK(suspects.largest_phase == (body.space.n_active_elements() > 0 ? Approx(1.) : Approx(0.)));
  body.state.phase.fill(.998);
  CHECK(found().empty());
}

TEST_CASE("Errors of one element reach all ranks")
{
  SECTION("a toughness that is not positive")
  {
    const auto bad = Toughness<2>([](double x, double y) { return x > 3.5 && y > 3.5 ? 0. : 1.; });
    CHECK_THROWS_AS(Body(MPI_COMM_WORLD, crowded_plate(), sheet(bad)), InvalidParameter);
  }
  SECTION("a degenerate element")
  {
    auto patch = shapes::plate<2, 2>({4., 4.}, {4, 4}).patch(0);
    for (int i = 0; i < patch.control_points.rows(); ++i)
      patch.control_points(i, 0) = std::min(patch.control_points(i, 0), 2.5);
    CHECK_THROWS_AS(Body(MPI_COMM_WORLD, Surface<2, 2>({patch}, {})), InvalidParameter);
  }
}
