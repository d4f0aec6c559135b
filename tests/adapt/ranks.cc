// label: verification
// ranks: 1 2 3
#include <catch2/catch.hpp>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// What a run of a cracking plate came to, step by step.
struct Run
{
  std::vector<double> dt, fracture, elastic, kinetic, work;
  std::vector<int>    newton, elements;
};

Run run(MPI_Comm comm)
{
  NewtonSettings settings;
  settings.linear.tolerance = 1e-12;
  CrackingPlate body(comm, {.target = .5, .halo = 1.}, .15, settings);
  body.prepare();
  Run result;
  while (body.state.time < .2)
    {
      const auto s = body.advance(.2);
      result.dt.push_back(s.dt);
      result.fracture.push_back(s.energies.fracture);
      result.elastic.push_back(s.energies.elastic());
      result.kinetic.push_back(s.energies.kinetic);
      result.work.push_back(s.external_work);
      result.newton.push_back(s.newton);
      result.elements.push_back(body.plate.n_elements());
    }
  return result;
}

} // namespace

TEST_CASE("The number of ranks has no influence on a run")
{
  // Every rank also runs the whole problem alone.
  const Run together = run(MPI_COMM_WORLD), alone = run(MPI_COMM_SELF);
  REQUIRE(together.dt.size() == alone.dt.size());
  CHECK(together.newton == alone.newton);
  CHECK(together.elements == alone.elements);
  CHECK(alone.elements.back() > alone.elements.front());
  for (std::size_t i = 0; i < alone.dt.size(); ++i)
    {
      CAPTURE(i);
      CHECK(together.dt[i] == Approx(alone.dt[i]).epsilon(1e-12));
      CHECK(together.fracture[i] == Approx(alone.fracture[i]).epsilon(1e-8));
      CHECK(together.elastic[i] == Approx(alone.elastic[i]).epsilon(1e-8));
      CHECK(together.kinetic[i] == Approx(alone.kinetic[i]).epsilon(1e-8));
      CHECK(together.work[i] == Approx(alone.work[i]).epsilon(1e-8));
    }
}
