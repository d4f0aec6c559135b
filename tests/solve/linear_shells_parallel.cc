// label: reference
// ranks: 2 3
#include <catch2/catch.hpp>

#include "linear_benchmarks.h"

using namespace sherd;
using namespace sherd::test;

// The values of one rank, on which tests/solve/linear_shells.cc builds. They differ by rounding only, which a stiff
// system enlarges.
TEST_CASE("Linear shells: the same values on several ranks", "[shell][mpi]")
{
  CHECK(deflection(roof<3>(8), 8., 8.)[2] == Approx(-.30058446111).epsilon(1e-9));
  CHECK(work(roof<3>(8)) == Approx(2413.13299841).epsilon(1e-9));
  CHECK(deflection(hemisphere<4>(8, 18.), 0., 0.)[0] == Approx(.0932697103).epsilon(1e-7));
}
