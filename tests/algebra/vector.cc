// label: unit
// ranks: 1 2 3
#include <catch2/catch.hpp>

#include <sherd/algebra/vector.h>
#include <sherd/base/exceptions.h>

#include "model_system.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("Ghosts take their owners' values")
{
  const auto distribution = ModelSystem{7}.distribute(MPI_COMM_WORLD);
  const int  block_size   = GENERATE(1, 3, 4);
  Vector     x(distribution, block_size);
  for (int a = 0; a < distribution->n_owned(); ++a)
    for (int c = 0; c < block_size; ++c)
      x.local()[a * block_size + c] = 10. * distribution->global(a) + c;

  x.update_ghosts();

  for (int a = 0; a < distribution->n_local(); ++a)
    for (int c = 0; c < block_size; ++c)
      CHECK(x.local()[a * block_size + c] == 10. * distribution->global(a) + c);
}

TEST_CASE("gather numbers values globally and scatter is its inverse")
{
  const auto distribution = ModelSystem{6}.distribute(MPI_COMM_WORLD);
  auto       x            = random_vector(distribution, 2);

  const auto values = gather(x);
  REQUIRE(values.size() == 72);
  for (int a = 0; a < distribution->n_local(); ++a)
    CHECK(values[distribution->global(a) * 2 + 1] == x.local()[a * 2 + 1]);

  Vector y(distribution, 2);
  scatter(values, y);
  CHECK(std::vector<double>(y.local().begin(), y.local().end()) ==
        std::vector<double>(x.local().begin(), x.local().end()));
  CHECK_THROWS_AS(scatter(std::vector<double>(71), y), DimensionMismatch);
}

TEST_CASE("Products count every control point once")
{
  const auto distribution = ModelSystem{6}.distribute(MPI_COMM_WORLD);
  Vector     x(distribution, 3), y(distribution, 3);
  x.fill(2.);
  y.fill(0.5);

  CHECK(dot(x, y) == Approx(108.).epsilon(1e-14));
  CHECK(norm(x) == Approx(2. * std::sqrt(108.)).epsilon(1e-14));
  axpy(3., x, y);
  scale(2., y);
  for (const double value : y.local())
    CHECK(value == 13.);
}

TEST_CASE("Copies of a vector are deep")
{
  const auto   distribution = ModelSystem{3}.distribute(MPI_COMM_WORLD);
  Vector       x(distribution, 1);
  const Vector y = x;
  x.fill(1.);
  CHECK(norm(y) == 0.);
  CHECK(norm(x) == Approx(3.));
}

TEST_CASE("A vector needs a block size")
{
  CHECK_THROWS_AS(Vector(ModelSystem{3}.distribute(MPI_COMM_WORLD), 0), InvalidParameter);
}
