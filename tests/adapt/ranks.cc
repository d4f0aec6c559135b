// label: verification
// ranks: 1 2 3 5
#include <catch2/catch.hpp>

#include <space/shared_out.h>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// What a run of a cracking plate came to, step by step.
struct Run
{
  std::vector<double> dt, fracture, elastic, kinetic, work;
  std::vector<int>    newton, rejected, repeated, elements;
};

Run run(MPI_Comm comm, const Partitioner &partitioner)
{
  NewtonSettings settings;
  settings.linear.tolerance = 1e-12;
  CrackingPlate body(comm, {.target = .5, .halo = 1.}, .15, settings, {5, 12}, partitioner);
  body.prepare();
  Run        result;
  const auto add = [&](const StepSummary &s) {
    result.dt.push_back(s.dt);
    result.fracture.push_back(s.energies.fracture);
    result.elastic.push_back(s.energies.elastic());
    result.kinetic.push_back(s.energies.kinetic);
    result.work.push_back(s.work.external.total());
    result.newton.push_back(s.newton);
    result.rejected.push_back(s.rejected);
    result.repeated.push_back(s.repeated);
    result.elements.push_back(body.plate.n_elements());
  };
  while (body.state.time < .2)
    add(body.advance(.2));

  // A step that may not take the iterations it needs is rejected; half of it comes next.
  settings.max_iterations = 1;
  MonolithicSolver<Glass, GeneralizedAlpha> impatient(body.model, body.space, body.supports, body.loads,
                                                      GeneralizedAlpha(.5), settings);
  impatient.rebuild(body.state);
  const double dt       = body.controller.step();
  const auto   rejected = impatient.attempt(body.state, dt);
  CHECK_FALSE(rejected.state);
  body.controller.reject(rejected.failure, dt);
  add(body.advance(1.));
  CHECK(result.dt.back() == Approx(.5 * dt));
  return result;
}

void check_same(const Run &together, const Run &alone)
{
  REQUIRE(together.dt.size() == alone.dt.size());
  CHECK(together.newton == alone.newton);
  CHECK(together.rejected == alone.rejected);
  CHECK(together.repeated == alone.repeated);
  CHECK(together.elements == alone.elements);
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

} // namespace

TEST_CASE("The number of ranks has no influence on a run, nor has a rank that owns nothing")
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const Run together = run(MPI_COMM_WORLD, partition);
  const Run with_gap = run(MPI_COMM_WORLD, leaving_out(n_ranks / 2));
  if (rank > 0)
    return;
  const Run alone = run(MPI_COMM_SELF, partition);
  CHECK(alone.elements.back() > alone.elements.front());
  CHECK(alone.fracture.back() > alone.fracture.front());
  check_same(together, alone);
  check_same(with_gap, alone);
}
