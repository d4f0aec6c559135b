// label: unit
// ranks: 1 2 3
#include <catch2/catch.hpp>
#include <omp.h>

#include <sherd/algebra/matrix.h>
#include <sherd/base/exceptions.h>

#include "model_system.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("The product with a vector is the sum over the stencil, on any number of ranks")
{
  const ModelSystem system{.n = 9, .displacement = 1.};
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  const auto        A            = system.matrix(distribution);
  const auto        x            = random_vector(distribution, 3);
  Vector            y(distribution, 3);

  A.multiply(x, y);

  const auto in = gather(x), out = gather(y);
  for (std::int64_t row = 0; row < 81; ++row)
    {
      double expected[3] = {};
      for (std::int64_t column = 0; column < 81; ++column)
        {
          const auto block = system.block(row, column);
          for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
              expected[c] += block[c * 3 + d] * in[column * 3 + d];
        }
      for (int c = 0; c < 3; ++c)
        CHECK(out[row * 3 + c] == Approx(expected[c]).margin(1e-13)); // sums of 75 products of order 1
    }
}

TEST_CASE("The product is the same on any number of threads")
{
  const ModelSystem system{.n = 60}; // enough rows for threads on each rank
  const auto        distribution = system.distribute(MPI_COMM_WORLD);
  const auto        A            = system.matrix(distribution);
  const auto        x            = random_vector(distribution, 3);
  const int         n_threads    = omp_get_max_threads();
  Vector            one(distribution, 3), other(distribution, 3);

  omp_set_num_threads(1);
  A.multiply(x, one);
  for (const int n : {2, 3})
    {
      omp_set_num_threads(n);
      other.fill(0.);
      A.multiply(x, other);
      CHECK(std::equal(one.owned().begin(), one.owned().end(), other.owned().begin()));
    }
  omp_set_num_threads(n_threads);
  CHECK(norm(one) > 0.);
}

TEST_CASE("Every block size multiplies")
{
  const int  block_size   = GENERATE(1, 2, 3, 4);
  const auto distribution = std::make_shared<const Distribution>(
      MPI_COMM_WORLD, rank_of_world() == 0 ? std::vector<std::int64_t>{0, 1} : std::vector<std::int64_t>{},
      std::vector<std::int64_t>{});
  Matrix A(distribution, rank_of_world() == 0 ? SparseGraph{{0, 2, 4}, {0, 1, 0, 1}} : SparseGraph{}, block_size);
  if (rank_of_world() == 0)
    for (int k = 0; k < 2; ++k) // block row 1 = [P Q], P(c, d) = c, Q(c, d) = 10 d
      for (int c = 0; c < block_size; ++c)
        for (int d = 0; d < block_size; ++d)
          A.values()[A.row_start(1) + c * A.row_length(1) + k * block_size + d] = k == 0 ? c : 10. * d;
  Vector x(distribution, block_size), y(distribution, block_size);
  x.fill(1.);

  A.multiply(x, y);

  const auto result = gather(y);
  for (int c = 0; c < block_size; ++c)
    {
      CHECK(result[c] == 0.);
      CHECK(result[block_size + c] == c * block_size + 10. * block_size * (block_size - 1) / 2);
    }
}

TEST_CASE("Copies of a matrix have their own values and share the graph")
{
  const ModelSystem system{4};
  auto              A = system.matrix(system.distribute(MPI_COMM_WORLD));
  const auto        B = A;
  A.set_zero();
  CHECK(A.shared_graph() == B.shared_graph());
  for (const double value : A.values())
    CHECK(value == 0.);
  if (!B.values().empty())
    CHECK(B.values()[0] > 0.);
}

TEST_CASE("A matrix refuses graphs that do not fit")
{
  const auto distribution = std::make_shared<const Distribution>(
      MPI_COMM_WORLD, rank_of_world() == 0 ? std::vector<std::int64_t>{0, 1} : std::vector<std::int64_t>{},
      std::vector<std::int64_t>{});
  if (rank_of_world() > 0)
    return;
  CHECK_THROWS_AS(Matrix(distribution, SparseGraph{{0, 1}, {0}}, 3), DimensionMismatch);
  CHECK_THROWS_AS(Matrix(distribution, SparseGraph{{0, 2, 3}, {0, 2, 1}}, 3), DimensionMismatch);
  CHECK_THROWS_AS(Matrix(distribution, SparseGraph{{0, 2, 3}, {1, 0, 1}}, 3), InvalidParameter);
  CHECK_THROWS_AS(Matrix(distribution, SparseGraph{{0, 1, 2}, {1, 1}}, 3), InvalidParameter);
  CHECK_THROWS_AS(Matrix(distribution, SparseGraph{{0, 1, 2}, {0, 1}}, 5), InvalidParameter);

  Matrix A(distribution, SparseGraph{{0, 1, 2}, {0, 1}}, 3);
  CHECK_THROWS_AS(A.multiply(std::vector<double>(5), A.values()), DimensionMismatch);
}
