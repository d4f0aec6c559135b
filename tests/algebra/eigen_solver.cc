// label: unit
// ranks: 1 2 3 5
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <sherd/algebra/eigen_solver.h>
#include <sherd/base/exceptions.h>

#include "model_system.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Bilinear finite elements for -Laplace u = lambda u on the unit square, n x n nodes with three unknowns each:
/// component 0 and, `ratio` times as stiff, component 1; component 2 has no mass.
struct Membranes
{
  int    n;
  double ratio    = 1.;
  double massless = 5.; ///< diagonal of K for component 2

  double spacing() const { return 1. / (n - 1); }

  /// Entry between nodes a and b of a line of n nodes.
  double stiffness(std::int64_t a, std::int64_t b) const
  {
    const bool end = a == 0 || a == n - 1;
    return std::abs(a - b) > 1 ? 0. : (a == b ? (end ? 1. : 2.) : -1.) / spacing();
  }
  double mass(std::int64_t a, std::int64_t b) const
  {
    const bool end = a == 0 || a == n - 1;
    return std::abs(a - b) > 1 ? 0. : (a == b ? (end ? 2. : 4.) : 1.) * spacing() / 6.;
  }

  /// Eigenvalue of stiffness over mass along a line, i half waves; the same for free and for fixed ends.
  double line(int i) const
  {
    const double cosine = std::cos(i * std::numbers::pi * spacing());
    return 6. / (spacing() * spacing()) * (1. - cosine) / (2. + cosine);
  }

  /// Sums of two eigenvalues of lines from @p first half waves on, with their multiples by ratio, ascending.
  std::vector<double> exact(int first, int n_modes) const
  {
    std::vector<double> result;
    for (int i = first; i < n - 1; ++i)
      for (int j = first; j < n - 1; ++j)
        for (const double factor : {1., ratio})
          result.push_back(factor * (line(i) + line(j)));
    std::sort(result.begin(), result.end());
    result.resize(n_modes);
    return result;
  }

  /// Adds a weighted stiffness and mass, each for both components.
  Matrix assemble(const std::shared_ptr<const Distribution> &distribution, double of_stiffness, double of_mass) const
  {
    auto result = ModelSystem{n}.matrix(distribution);
    result.set_zero();
    for (int A = 0; A < distribution->n_owned(); ++A)
      {
        const auto row = result.graph().row(A);
        const auto a   = distribution->global(A);
        for (std::size_t k = 0; k < row.size(); ++k)
          {
            const auto   b  = distribution->global(row[k]);
            const double mx = mass(a % n, b % n), my = mass(a / n, b / n);
            const double kxy = stiffness(a % n, b % n) * my + mx * stiffness(a / n, b / n);
            const auto   at  = [&](int c, int d) -> double    &{
              return result.values()[result.row_start(A) + c * result.row_length(A) + k * 3 + d];
            };
            at(0, 0) = of_stiffness * kxy + of_mass * mx * my;
            at(1, 1) = of_stiffness * ratio * kxy + of_mass * mx * my;
            if (a == b)
              at(2, 2) = of_stiffness * massless;
          }
      }
    return result;
  }
  Matrix stiffness_matrix(const std::shared_ptr<const Distribution> &d) const { return assemble(d, 1., 0.); }
  Matrix mass_matrix(const std::shared_ptr<const Distribution> &d) const { return assemble(d, 0., 1.); }

  std::vector<char> all_free(const Distribution &distribution) const
  {
    return std::vector<char>(static_cast<std::size_t>(distribution.n_owned()) * 3, 0);
  }

  /// The border, and component 2 everywhere.
  std::vector<char> clamped(const Distribution &distribution) const
  {
    auto fixed = all_free(distribution);
    for (int A = 0; A < distribution.n_owned(); ++A)
      {
        const auto x = distribution.global(A) % n, y = distribution.global(A) / n;
        for (int c = 0; c < 3; ++c)
          fixed[A * 3 + c] = static_cast<char>(c == 2 || x == 0 || y == 0 || x == n - 1 || y == n - 1);
      }
    return fixed;
  }
};

/// What the interface promises of vectors: M-orthonormal, zero where fixed, with ghosts.
void check_vectors(const EigenPairs &pairs, const Matrix &mass, const std::vector<char> &fixed)
{
  REQUIRE(pairs.vectors.size() == pairs.values.size());
  for (std::size_t i = 0; i < pairs.vectors.size(); ++i)
    {
      const auto &v = pairs.vectors[i];
      for (std::size_t k = 0; k < fixed.size(); ++k)
        if (fixed[k] != 0)
          CHECK(v.owned()[k] == 0.);
      auto with_ghosts = v;
      with_ghosts.update_ghosts();
      CHECK(std::equal(v.local().begin(), v.local().end(), with_ghosts.local().begin()));
      Vector mass_v = v;
      mass.multiply(v, mass_v);
      for (std::size_t j = 0; j <= i; ++j)
        CHECK(dot(pairs.vectors[j], mass_v) == Approx(i == j ? 1. : 0.).margin(1e-7)); // the tolerance is 1e-9
    }
}

// Eigenvalues are as exact as rounding lets them be: errors are of the order of the squared tolerance (1e-18), and
// 1e-16 times the condition number, which is below 1e4 here.
constexpr double rounding = 1e-11;

} // namespace

TEST_CASE("Modes of clamped membranes have their closed form, multiple ones as often as they occur")
{
  const int       n_modes = GENERATE(1, 4, 13); // 13: the last one's twin is left out
  const double    ratio   = GENERATE(1., 1.7);  // 1: simple modes are double, double ones fourfold
  const Membranes model{.n = 16, .ratio = ratio};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD);
  const auto      K = model.stiffness_matrix(distribution), M = model.mass_matrix(distribution);
  const auto      fixed = model.clamped(*distribution);

  const auto pairs = lowest_eigenpairs(K, M, fixed, {.n_modes = n_modes});

  const auto exact = model.exact(1, n_modes);
  REQUIRE(pairs.values.size() == exact.size());
  for (int k = 0; k < n_modes; ++k)
    {
      CHECK(pairs.values[k] == Approx(exact[k]).epsilon(rounding));
      CHECK(pairs.residuals[k] < 1e-8); // tolerance 1e-9, other norm
    }
  CHECK(pairs.n_below_shift == 0);
  check_vectors(pairs, M, fixed);
}

TEST_CASE("A rank without control points takes part in finding modes")
{
  const Membranes model{.n = 12};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD, std::max(1, ranks_of_world() - 1));
  const auto      K = model.stiffness_matrix(distribution), M = model.mass_matrix(distribution);
  const auto      fixed = model.clamped(*distribution);
  const auto      pairs = lowest_eigenpairs(K, M, fixed, {.n_modes = 3});
  const auto      exact = model.exact(1, 3);
  for (int k = 0; k < 3; ++k)
    CHECK(pairs.values[k] == Approx(exact[k]).epsilon(rounding));
  check_vectors(pairs, M, fixed);
}

TEST_CASE("Residuals are those of the vectors")
{
  const Membranes model{.n = 12};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD);
  const auto      K = model.stiffness_matrix(distribution), M = model.mass_matrix(distribution);
  // A loose tolerance leaves residuals that are not rounding.
  const auto pairs = lowest_eigenpairs(K, M, model.clamped(*distribution), {.n_modes = 5, .tolerance = 1e-2});
  const auto fixed = model.clamped(*distribution);
  for (std::size_t k = 0; k < pairs.values.size(); ++k)
    {
      Vector Kv = pairs.vectors[k], Mv = pairs.vectors[k];
      K.multiply(pairs.vectors[k], Kv);
      M.multiply(pairs.vectors[k], Mv);
      for (std::size_t i = 0; i < fixed.size(); ++i)
        if (fixed[i] != 0)
          Kv.owned()[i] = Mv.owned()[i] = 0.;
      auto difference = Kv;
      axpy(-pairs.values[k], Mv, difference);
      CHECK(pairs.residuals[k] ==
            Approx(norm(difference) / (norm(Kv) + std::abs(pairs.values[k]) * norm(Mv))).margin(1e-13));
    }
}

TEST_CASE("A free body has rigid modes, found with a negative shift")
{
  const Membranes model{.n = 14, .ratio = 1.3};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD);
  const auto      K = model.stiffness_matrix(distribution), M = model.mass_matrix(distribution);
  const auto      fixed = model.all_free(*distribution); // component 2: infinite eigenvalues, not among the modes

  const auto pairs = lowest_eigenpairs(K, M, fixed, {.n_modes = 9, .shift = -5.});
  const auto exact = model.exact(0, 9);
  CHECK(exact[1] == 0.);
  for (int k = 0; k < 9; ++k)
    {
      CHECK(pairs.values[k] == Approx(exact[k]).epsilon(rounding).margin(5. * rounding));
      CHECK(pairs.residuals[k] < 1e-8);
    }
  CHECK(pairs.n_below_shift == 0);
  check_vectors(pairs, M, fixed);

  CHECK_THROWS_WITH(lowest_eigenpairs(K, M, fixed, {.n_modes = 3}),
                    Catch::Contains("shift = 0") && Catch::Contains("negative"));
}

TEST_CASE("An indefinite stiffness shows how many eigenvalues lie below the shift")
{
  const Membranes model{.n = 14, .ratio = 1.3};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD);
  const double    load         = 80.; // lowers every eigenvalue
  const auto      K = model.assemble(distribution, 1., -load), M = model.mass_matrix(distribution);
  const auto      fixed = model.clamped(*distribution);
  const auto      exact = model.exact(1, 20);
  const auto      n_negative =
      static_cast<int>(std::count_if(exact.begin(), exact.end(), [&](double x) { return x < load; }));
  REQUIRE(n_negative > 3);

  const auto above = lowest_eigenpairs(K, M, fixed, {.n_modes = 4});
  CHECK(above.n_below_shift == n_negative);
  for (int k = 0; k < 4; ++k)
    CHECK(above.values[k] == Approx(exact[n_negative + k] - load).epsilon(10. * rounding));

  const auto all = lowest_eigenpairs(K, M, fixed, {.n_modes = 7, .shift = -load});
  CHECK(all.n_below_shift == 0);
  for (int k = 0; k < 7; ++k)
    CHECK(all.values[k] == Approx(exact[k] - load).epsilon(10. * rounding));
}

TEST_CASE("A random pair agrees with a dense solver")
{
  const int  n = 5, size = n * n * 3;
  const auto distribution = ModelSystem{n}.distribute(MPI_COMM_WORLD);
  auto       K = ModelSystem{n}.matrix(distribution), M = K;

  // Symmetric values on the stencil, diagonally dominant.
  std::mt19937                           engine(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto                             random_spd = [&](double extra) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    for (int a = 0; a < n * n; ++a)
      for (const auto b : ModelSystem{n}.neighbours(a))
        for (int c = 0; c < 3; ++c)
          for (int d = 0; d < 3; ++d)
            if (a * 3 + c < b * 3 + d)
              A(a * 3 + c, b * 3 + d) = A(b * 3 + d, a * 3 + c) = uniform(engine);
    for (int i = 0; i < size; ++i)
      A(i, i) = A.row(i).cwiseAbs().sum() * (1. + extra * (1. + uniform(engine)));
    return A;
  };
  const Eigen::MatrixXd dense_K = random_spd(2.), dense_M = random_spd(0.1);
  const auto            copy = [&](const Eigen::MatrixXd &from, Matrix &to) {
    for (int A = 0; A < distribution->n_owned(); ++A)
      for (std::size_t k = 0; k < to.graph().row(A).size(); ++k)
        for (int c = 0; c < 3; ++c)
          for (int d = 0; d < 3; ++d)
            to.values()[to.row_start(A) + c * to.row_length(A) + k * 3 + d] =
                from(distribution->global(A) * 3 + c, distribution->global(to.graph().row(A)[k]) * 3 + d);
  };
  copy(dense_K, K);
  copy(dense_M, M);

  const std::vector<char> fixed(static_cast<std::size_t>(distribution->n_owned()) * 3, 0);
  const auto              pairs = lowest_eigenpairs(K, M, fixed, {.n_modes = 10});
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(dense_K, dense_M);
  for (int k = 0; k < 10; ++k)
    {
      CHECK(pairs.values[k] == Approx(dense.eigenvalues()[k]).epsilon(rounding));
      CHECK(pairs.residuals[k] < 1e-8);
      const auto v = gather(pairs.vectors[k]);
      const auto overlap =
          (dense.eigenvectors().col(k).transpose() * dense_M * Eigen::Map<const Eigen::VectorXd>(v.data(), size))
              .value();
      CHECK(std::abs(overlap) == Approx(1.).epsilon(1e-8)); // simple eigenvalues: the same vector
    }
}

TEST_CASE("Rows and columns of fixed unknowns have no influence")
{
  const Membranes model{.n = 12};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD);
  auto            K = model.stiffness_matrix(distribution), M = model.mass_matrix(distribution);
  const auto      fixed = model.clamped(*distribution);
  // Large values, negative mass and coupling between fixed and free unknowns.
  for (int A = 0; A < distribution->n_owned(); ++A)
    for (std::size_t k = 0; k < K.graph().row(A).size(); ++k)
      for (int c = 0; c < 3; ++c)
        {
          const auto place = K.row_start(A) + c * K.row_length(A) + k * 3;
          if (fixed[A * 3 + c] != 0)
            for (int d = 0; d < 3; ++d)
              {
                K.values()[place + d] = 1e3 * (d + 1);
                M.values()[place + d] = -10.;
              }
          else
            K.values()[place + 2] = M.values()[place + 2] = 7.;
        }
  const auto pairs = lowest_eigenpairs(K, M, fixed, {.n_modes = 6});
  const auto exact = model.exact(1, 6);
  for (int k = 0; k < 6; ++k)
    CHECK(pairs.values[k] == Approx(exact[k]).epsilon(rounding));
}

TEST_CASE("The eigen-solver refuses what it cannot do, on all ranks")
{
  const Membranes model{.n = 6};
  const auto      distribution = ModelSystem{model.n}.distribute(MPI_COMM_WORLD);
  const auto      K = model.stiffness_matrix(distribution), M = model.mass_matrix(distribution);
  const auto      fixed = model.clamped(*distribution); // 32 unknowns are free

  CHECK_THROWS_AS(lowest_eigenpairs(K, M, fixed, {.n_modes = 0}), InvalidParameter);
  CHECK_THROWS_AS(lowest_eigenpairs(K, M, fixed, {.block_size = 1}), InvalidParameter);
  CHECK_THROWS_AS(lowest_eigenpairs(K, M, fixed, {.tolerance = 0.}), InvalidParameter);
  CHECK_THROWS_WITH(lowest_eigenpairs(K, M, fixed, {.n_modes = 21}), Catch::Contains("there are 32"));
  CHECK_THROWS_AS(lowest_eigenpairs(K, M, std::vector<char>(1), {}), DimensionMismatch);
  const Matrix other(distribution, K.graph(), 2);
  CHECK_THROWS_AS(lowest_eigenpairs(K, other, fixed, {}), DimensionMismatch);

  // All 32 eigenvalues lie below the shift, then all but a few.
  const auto values = model.exact(1, 32);
  CHECK_THROWS_AS(lowest_eigenpairs(K, M, fixed, {.shift = 2. * values.back()}), NoConvergence);
  CHECK_THROWS_WITH(lowest_eigenpairs(K, M, fixed, {.n_modes = 6, .shift = 0.5 * (values[25] + values[26])}),
                    Catch::Contains("lower shift"));

  const Membranes large{.n = 16};
  const auto      same = ModelSystem{large.n}.distribute(MPI_COMM_WORLD);
  CHECK_THROWS_WITH(lowest_eigenpairs(large.stiffness_matrix(same), large.mass_matrix(same), large.clamped(*same),
                                      {.n_modes = 4, .tolerance = 1e-17, .max_restarts = 0}),
                    Catch::Contains("of 5 modes") && Catch::Contains("0 restarts"));
}
