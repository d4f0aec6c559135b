// label: unit
// ranks: 1 2 3 5
#include <limits>

#include <catch2/catch.hpp>
#include <omp.h>

#include <sherd/algebra/linear_solver.h>
#include <sherd/base/exceptions.h>

#include "model_system.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

struct Outcome
{
  SolveReport report;
  double      error; ///< of the equilibrated unknowns
};

/// Solves a model system whose solution is known.
Outcome solve_known(const ModelSystem &system, const LinearSolverSettings &settings,
                    const std::shared_ptr<const Distribution> &distribution)
{
  auto       A        = system.matrix(distribution);
  const auto expected = random_vector(distribution, 3, system.displacement);
  Vector     b(distribution, 3), x(distribution, 3);
  A.multiply(expected, b);
  LinearSolver solver(settings);
  const auto   report = solver.solve(A, b, x);
  return {report, distance(x, expected, system.displacement)};
}

Outcome solve_known(const ModelSystem &system, const LinearSolverSettings &settings)
{
  return solve_known(system, settings, system.distribute(MPI_COMM_WORLD));
}

/// A plate loaded beyond several of its critical loads: indefinite, which no incomplete factorisation likes.
ModelSystem unstable_system()
{
  return {.n = 24, .inertia = -0.3};
}

} // namespace

TEST_CASE("All preconditioners lead to the same solution of a badly scaled system")
{
  const auto preconditioner =
      GENERATE(Preconditioner::point_block_ilu, Preconditioner::ifpack2_ilu, Preconditioner::mumps);
  const ModelSystem system{20};
  const auto        outcome = solve_known(system, {.preconditioner = preconditioner, .tolerance = 1e-10});

  CHECK(outcome.report.used == preconditioner);
  CHECK_FALSE(outcome.report.escalated);
  CHECK(outcome.report.relative_residual <= 1e-10);
  CHECK(outcome.report.iterations >= 1);
  CHECK(outcome.error < 1e-8); // the equilibrated matrix has a condition number of about 100
}

TEST_CASE("A rank without control points takes part")
{
  const auto preconditioner =
      GENERATE(Preconditioner::point_block_ilu, Preconditioner::ifpack2_ilu, Preconditioner::mumps);
  const ModelSystem system{12};
  const auto        distribution = system.distribute(MPI_COMM_WORLD, std::max(1, ranks_of_world() - 1));
  const auto        outcome = solve_known(system, {.preconditioner = preconditioner, .tolerance = 1e-10}, distribution);
  CHECK(outcome.report.used == preconditioner);
  CHECK(outcome.error < 1e-8);
}

TEST_CASE("Two threads take the iterations of one, more threads at most two more")
{
  const int         n_threads = omp_get_max_threads();
  const auto        bending   = GENERATE(0., 0.1);
  const ModelSystem system{.n = 90, .inertia = 0.1, .bending = bending}; // rows for several threads on each rank
  const auto        iterations = [&](int n) {
    omp_set_num_threads(n);
    const auto outcome = solve_known(system, {.tolerance = 1e-8, .escalation = Escalation::never});
    omp_set_num_threads(n_threads);
    CHECK(outcome.report.relative_residual <= 1e-8);
    return outcome.report.iterations;
  };
  const int on_one = iterations(1);
  CHECK(std::abs(iterations(2) - on_one) <= 1);
  for (const int n : {3, 5})
    CHECK(iterations(n) <= on_one + 2);
}

TEST_CASE("Iterations do not depend on the units of the fields")
{
  const LinearSolverSettings settings{.tolerance = 1e-10};
  const auto                 plain  = solve_known({.n = 16, .displacement = 1.}, settings);
  const auto                 scaled = solve_known({.n = 16, .displacement = 65536.}, settings); // exact in binary
  CHECK(plain.report.iterations == scaled.report.iterations);
  CHECK(scaled.error < 1e-8);
}

TEST_CASE("Iterations do not grow with the mesh while inertia rules")
{
  const LinearSolverSettings settings{.tolerance = 1e-8};
  const auto                 coarse = solve_known({.n = 16}, settings);
  const auto                 fine   = solve_known({.n = 48}, settings);
  CHECK(fine.report.iterations <= coarse.report.iterations + 3);
}

TEST_CASE("More fill and overlap save iterations")
{
  const ModelSystem system{24};
  const auto        iterations = [&](int fill_level, int overlap) {
    return solve_known(system, {.fill_level = fill_level, .overlap = overlap, .tolerance = 1e-8}).report.iterations;
  };
  CHECK(iterations(2, 1) < iterations(0, 1));
  if (ranks_of_world() > 1)
    CHECK(iterations(1, 1) < iterations(1, 0));
}

TEST_CASE("A solver is used again with new values and after the mesh has changed")
{
  LinearSolver solver({.tolerance = 1e-10});
  for (const int n : {10, 14})
    {
      const ModelSystem system{n};
      const auto        distribution = system.distribute(MPI_COMM_WORLD);
      auto              A            = system.matrix(distribution);
      const auto        expected     = random_vector(distribution, 3, system.displacement);
      for (const double inertia : {1., 5.})
        {
          ModelSystem{.n = n, .inertia = inertia}.fill(A);
          Vector b(distribution, 3), x(distribution, 3);
          A.multiply(expected, b);
          x.fill(17.); // old content has no influence
          solver.solve(A, b, x);
          CHECK(distance(x, expected, system.displacement) < 1e-8);
          auto with_ghosts = x;
          with_ghosts.update_ghosts();
          CHECK(std::equal(x.local().begin(), x.local().end(), with_ghosts.local().begin()));
        }
    }
}

TEST_CASE("A matrix that stays is solved with again")
{
  for (const auto preconditioner : {Preconditioner::point_block_ilu, Preconditioner::mumps})
    {
      LinearSolver      solver({.preconditioner = preconditioner, .tolerance = 1e-10});
      const ModelSystem system{12};
      const auto        distribution = system.distribute(MPI_COMM_WORLD);
      auto              A            = system.matrix(distribution);
      const auto        first        = random_vector(distribution, 3, system.displacement);
      Vector            b(distribution, 3), b2(distribution, 3), x(distribution, 3);
      CHECK_THROWS_AS(solver.solve_again(A, b, x), Error);
      A.multiply(first, b);
      auto second = first;
      for (std::size_t i = 0; i < second.local().size(); ++i)
        second.local()[i] *= i % 2 ? -3. : .5;
      second.update_ghosts();
      A.multiply(second, b2);
      solver.solve(A, b, x); // leaves A equilibrated
      const auto report = solver.solve_again(A, b2, x);
      CHECK(distance(x, second, system.displacement) < 1e-8);
      CHECK(report.iterations > 0);
      solver.forget();
      CHECK_THROWS_AS(solver.solve_again(A, b, x), Error);
    }
}

TEST_CASE("Unknowns with a row of the identity are exact")
{
  const auto        preconditioner = GENERATE(Preconditioner::point_block_ilu, Preconditioner::mumps);
  const ModelSystem system{14};
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  auto              A            = system.matrix(distribution);
  Vector            b(distribution, 3), x(distribution, 3);
  for (int a = 0; a < distribution->n_owned(); ++a)
    if (distribution->global(a) < 14)
      for (int c = 0; c < 2; ++c)
        {
          make_identity_row(A, a, c);
          b.local()[a * 3 + c] = 0.1 * distribution->global(a) + c;
        }
  const auto before = A;

  const auto report = LinearSolver({.preconditioner = preconditioner, .tolerance = 1e-3}).solve(A, b, x);

  CHECK(report.relative_residual <= 1e-3);
  for (int a = 0; a < distribution->n_owned(); ++a)
    if (distribution->global(a) < 14)
      for (int c = 0; c < 2; ++c)
        CHECK(x.local()[a * 3 + c] == 0.1 * distribution->global(a) + c);
  Vector Ax(distribution, 3);
  before.multiply(x, Ax);
  CHECK(norm(x) > 1.);
  CHECK(distance(Ax, b) / norm(Ax) < 1.); // no overflow hides behind the scaling
}

TEST_CASE("A system that defeats incomplete factors goes to MUMPS, is solved and told")
{
  const auto   system = unstable_system();
  LinearSolver solver({.tolerance = 1e-8});
  const auto   distribution = system.distribute(MPI_COMM_WORLD);
  auto         A            = system.matrix(distribution);
  const auto   expected     = random_vector(distribution, 3, system.displacement);
  Vector       b(distribution, 3), x(distribution, 3);
  A.multiply(expected, b);

  const auto first = solver.solve(A, b, x);
  CHECK(first.escalated);
  CHECK(first.used == Preconditioner::mumps);
  CHECK(first.relative_residual <= 1e-8);
  CHECK_THAT(first.message, Catch::Contains("point_block_ilu(1)") && Catch::Contains("point_block_ilu(2)") &&
                                Catch::Contains("mumps"));

  system.fill(A);
  const auto second = solver.solve(A, b, x);
  CHECK_FALSE(second.escalated); // begins where the first ended
  CHECK(second.used == Preconditioner::mumps);

  solver.forget();
  system.fill(A);
  CHECK(solver.solve(A, b, x).escalated);
}

TEST_CASE("An escalated solver tries the cheaper preconditioner again")
{
  const auto   unstable = unstable_system();
  LinearSolver solver({.tolerance = 1e-8, .retry_interval = 2});
  const auto   distribution = unstable.distribute(MPI_COMM_WORLD);
  auto         A            = unstable.matrix(distribution);
  auto         b            = random_vector(distribution, 3);
  Vector       x(distribution, 3);
  REQUIRE(solver.solve(A, b, x).used == Preconditioner::mumps);

  const ModelSystem easy{24};
  const auto        next = [&] {
    easy.fill(A);
    return solver.solve(A, b, x);
  };
  CHECK(next().used == Preconditioner::mumps);
  const auto lower = next();
  CHECK(lower.used == Preconditioner::point_block_ilu);
  CHECK(lower.fill_level == 2);
  next();
  CHECK(next().fill_level == 1);
}

TEST_CASE("Without escalation a solver that does not converge says so on all ranks")
{
  CHECK_THROWS_AS(
      solve_known(unstable_system(), {.tolerance = 1e-8, .escalation = Escalation::never, .max_iterations = 20}),
      NoConvergence);
}

TEST_CASE("A pivot block that becomes singular escalates on all ranks")
{
  // [1 1; 1 1] in the first unknowns of the first two control points: singular within ILU, not within the matrix.
  const int                 rank = rank_of_world();
  std::vector<std::int64_t> owned, none;
  if (rank == 0)
    owned = {0, 1, 2};
  const auto distribution = std::make_shared<const Distribution>(MPI_COMM_WORLD, owned, none);
  Matrix     A(distribution, rank == 0 ? SparseGraph{{0, 3, 6, 9}, {0, 1, 2, 0, 1, 2, 0, 1, 2}} : SparseGraph{}, 1);
  Vector     b(distribution, 1), x(distribution, 1);
  if (rank == 0)
    {
      const std::vector<double> values = {1., 1., 0., 1., 1., 1., 0., 1., 1.};
      std::copy(values.begin(), values.end(), A.values().begin());
      std::copy_n(std::vector<double>{3., 6., 5.}.begin(), 3, b.owned().begin());
    }

  const auto report = LinearSolver({.tolerance = 1e-12}).solve(A, b, x);

  CHECK(report.used == Preconditioner::mumps);
  CHECK_THAT(report.message, Catch::Contains("singular diagonal block"));
  const auto result = gather(x);
  for (int i = 0; i < 3; ++i)
    CHECK(result[i] == Approx(i + 1.).epsilon(1e-10));
}

TEST_CASE("An unknown without diagonal, as a multiplier has, is scaled and solved")
{
  const auto        preconditioner = GENERATE(Preconditioner::point_block_ilu, Preconditioner::mumps);
  const ModelSystem system{8};
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  auto              A            = system.matrix(distribution);
  const auto        last         = distribution->local(63);
  if (last >= 0 && last < distribution->n_owned())
    {
      const auto row      = A.graph().row(last);
      const auto k        = std::find(row.begin(), row.end(), last) - row.begin();
      double    &diagonal = A.values()[A.row_start(last) + 2 * A.row_length(last) + k * 3 + 2];
      diagonal            = 0.;
    }
  const auto expected = random_vector(distribution, 3, system.displacement);
  Vector     b(distribution, 3), x(distribution, 3);
  A.multiply(expected, b);
  LinearSolver({.preconditioner = preconditioner, .tolerance = 1e-11}).solve(A, b, x);
  CHECK(distance(x, expected, system.displacement) < 1e-7);
}

TEST_CASE("Several right-hand sides have the solutions that each has alone")
{
  const auto preconditioner =
      GENERATE(Preconditioner::point_block_ilu, Preconditioner::ifpack2_ilu, Preconditioner::mumps);
  const ModelSystem          system{16};
  const LinearSolverSettings settings{.preconditioner = preconditioner, .tolerance = 1e-10};
  const auto                 distribution = system.distribute(MPI_COMM_WORLD);
  auto                       A            = system.matrix(distribution);
  const auto                 first        = random_vector(distribution, 3);
  Vector                     second(distribution, 3), nothing(distribution, 3);
  for (std::size_t i = 0; i < second.owned().size(); ++i)
    second.owned()[i] = 1. + first.owned()[i] * first.owned()[i];
  const std::vector<Vector> rhs = {first, nothing, second};
  std::vector<Vector>       solutions(3, first);

  LinearSolver solver(settings);
  const auto   together   = solver.solve(A, rhs, solutions);
  int          iterations = 0;
  double       residual   = 0.;
  for (int k = 0; k < 3; ++k)
    {
      Vector alone(distribution, 3);
      system.fill(A);
      const auto report = LinearSolver(settings).solve(A, rhs[k], alone);
      iterations += report.iterations;
      residual = std::max(residual, report.relative_residual);
      // The same factors and iterations; MUMPS may sum in another order on several ranks.
      CHECK(distance(solutions[k], alone, system.displacement) <= 1e-12 * (1. + system.displacement * norm(alone)));
    }
  CHECK(together.iterations == iterations);
  CHECK(together.relative_residual <= 1e-10);
  CHECK(together.used == preconditioner);
  CHECK_FALSE(together.escalated);
  CHECK_THAT(together.message, Catch::Contains("right-hand side 0") && Catch::Contains("right-hand side 2") &&
                                   !Catch::Contains("right-hand side 1"));
}

TEST_CASE("A right-hand side that needs a stronger preconditioner hands it on to the next")
{
  const auto                system       = unstable_system();
  const auto                distribution = system.distribute(MPI_COMM_WORLD);
  auto                      A            = system.matrix(distribution);
  const std::vector<Vector> rhs(2, random_vector(distribution, 3));
  std::vector<Vector>       solutions(2, rhs[0]);
  const auto                report = LinearSolver({.tolerance = 1e-8}).solve(A, rhs, solutions);
  CHECK(report.escalated);
  CHECK(report.used == Preconditioner::mumps);
  CHECK_THAT(report.message, Catch::EndsWith("right-hand side 1: mumps after 1 iteration at a relative residual of " +
                                             report.message.substr(report.message.rfind(' ') + 1)));
  CHECK(distance(solutions[0], solutions[1]) < 1e-6 * norm(solutions[0])); // residuals of 1e-8

  solutions.pop_back();
  CHECK_THROWS_AS(LinearSolver({}).solve(A, rhs, solutions), DimensionMismatch);
}

TEST_CASE("Nothing to solve takes no iteration")
{
  const ModelSystem system{6};
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  auto              A            = system.matrix(distribution);
  Vector            b(distribution, 3), x(distribution, 3);
  x.fill(1.);
  const auto report = LinearSolver({}).solve(A, b, x);
  CHECK(report.iterations == 0);
  CHECK(norm(x) == 0.);
}

TEST_CASE("Values that are not finite and rows of zeros are named on all ranks")
{
  const ModelSystem system{10};
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  auto              A            = system.matrix(distribution);
  auto              b            = random_vector(distribution, 3);
  Vector            x(distribution, 3);
  LinearSolver      solver({});
  const int         place = distribution->local(57);
  const bool        mine  = place >= 0 && place < distribution->n_owned();

  SECTION("in the matrix")
  {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      {
        system.fill(A);
        if (mine)
          A.values()[A.row_start(place) + A.row_length(place) + 4] = value;
        CHECK_THROWS_WITH(solver.solve(A, b, x), Catch::Contains("control point 57, component 1"));
      }
  }
  SECTION("in the right-hand side")
  {
    if (mine)
      b.local()[place * 3 + 2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(solver.solve(A, b, x),
                      Catch::Contains("right-hand side") && Catch::Contains("control point 57, component 2"));
  }
  SECTION("zero rows")
  {
    if (mine)
      for (int m = 0; m < A.row_length(place); ++m)
        A.values()[A.row_start(place) + m] = 0.;
    CHECK_THROWS_AS(solver.solve(A, b, x), NoConvergence);
    system.fill(A);
    if (mine)
      for (int m = 0; m < A.row_length(place); ++m)
        A.values()[A.row_start(place) + m] = 0.;
    CHECK_THROWS_WITH(solver.solve(A, b, x),
                      Catch::Contains("control point 57, component 0") && Catch::Contains("is zero"));
  }
}

TEST_CASE("A singular matrix is an error of the direct solver that says so")
{
  const ModelSystem system{6};
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  auto              A            = system.matrix(distribution);
  std::fill(A.values().begin(), A.values().end(), 1.);
  const auto b = random_vector(distribution, 3);
  Vector     x(distribution, 3);
  CHECK_THROWS_WITH(LinearSolver({.preconditioner = Preconditioner::mumps}).solve(A, b, x),
                    Catch::Contains("the matrix is singular") && Catch::Contains("supports"));
}

TEST_CASE("A static body without supports is told to be singular, and solved once it has them")
{
  // A chain of springs; a free end on either side makes one rigid motion.
  const auto stiffness = GENERATE(1., 1e6);
  const int  n         = 60;
  const auto graph_of  = [](const Distribution &distribution) {
    SparseGraph graph;
    for (int A = 0; A < distribution.n_owned(); ++A)
      {
        std::vector<int> row;
        for (const auto b : ModelSystem{n}.neighbours(distribution.global(A)))
          row.push_back(distribution.local(b));
        std::sort(row.begin(), row.end());
        graph.columns.insert(graph.columns.end(), row.begin(), row.end());
        graph.offsets.push_back(static_cast<int>(graph.columns.size()));
      }
    return graph;
  };
  const auto distribution = ModelSystem{n}.distribute(MPI_COMM_WORLD);
  Matrix     A(distribution, graph_of(*distribution), 1);
  const auto assemble = [&] {
    for (int a = 0; a < distribution->n_owned(); ++a)
      {
        const auto row = A.graph().row(a);
        for (std::size_t k = 0; k < row.size(); ++k)
          A.values()[A.row_start(a) + k] =
              row[k] == a ? stiffness * (static_cast<double>(row.size()) - 1.) : -stiffness;
      }
  };
  const auto   b = random_vector(distribution, 1);
  Vector       x(distribution, 1);
  LinearSolver solver({.preconditioner = Preconditioner::mumps, .tolerance = 1e-8});
  assemble();
  CHECK_THROWS_WITH(solver.solve(A, b, x), Catch::Contains("singular") && Catch::Contains("supports"));

  assemble();
  if (const int a = distribution->local(0); a >= 0 && a < distribution->n_owned())
    make_identity_row(A, a, 0);
  CHECK(solver.solve(A, b, x).relative_residual <= 1e-8);
}

TEST_CASE("Preconditioners have names")
{
  for (const auto preconditioner :
       {Preconditioner::point_block_ilu, Preconditioner::ifpack2_ilu, Preconditioner::mumps})
    CHECK(preconditioner_from_name(to_string(preconditioner)) == preconditioner);
  CHECK_THROWS_WITH(preconditioner_from_name("ilu"), Catch::Contains("\"ilu\"") && Catch::Contains("point_block_ilu"));
}

TEST_CASE("Settings out of range are refused")
{
  CHECK_THROWS_AS(LinearSolver({.fill_level = -1}), InvalidParameter);
  CHECK_THROWS_AS(LinearSolver({.overlap = 2}), InvalidParameter);
  CHECK_THROWS_AS(LinearSolver({.tolerance = 0.}), InvalidParameter);
  CHECK_THROWS_AS(LinearSolver({.iteration_limit = 0}), InvalidParameter);
  CHECK_THROWS_AS(LinearSolver({.restart = 0}), InvalidParameter);
}
