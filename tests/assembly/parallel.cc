// label: unit
// ranks: 1 2 3 10
#include <catch2/catch.hpp>

#include <assembly/body.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Everything that threads sum, as bits.
std::vector<double> all_results(const Body &body)
{
  auto f = body.make_force();
  auto K = body.assembler.make_matrix();
  body.assembler.linearise(body.level(), body.state.history, .7, PhaseTangent::switched, f, K);
  std::vector<double> result(f.owned().begin(), f.owned().end());
  result.insert(result.end(), K.values().begin(), K.values().end());
  body.assembler.force(body.level(), body.state.history, f);
  result.insert(result.end(), f.owned().begin(), f.owned().end());
  const auto e = body.energies();
  result.insert(result.end(), {e.active, e.passive, e.kinetic, e.fracture, body.withheld_work()});
  const auto history = body.assembler.committed(body.level(), body.state.history);
  for (int k = 0; k < body.space.n_active_elements(); ++k)
    result.insert(result.end(), history[k], history[k] + 9);
  return result;
}

Loads<2> some_loads()
{
  Loads<2> loads;
  loads.traction("right", [](const Point<2> &X, double) { return Point<2>(1. + X[1], -2.); });
  loads.surface_load([](const Point<2> &X, double) { return Point<2>(X[0] * X[1], 3.); });
  return loads;
}

} // namespace

TEST_CASE("The number of threads does not change a bit")
{
  const auto          surface = crowded_plate();
  const auto          state   = random_state(surface, stretch(1.1, .95, .2));
  std::vector<double> expected;
  for (const int n : {1, 2, 3, 5})
    {
      const Threads threads(n);
      Body          body(MPI_COMM_WORLD, surface);
      body.state         = distribute(state, body.space);
      const auto results = all_results(body);
      if (n == 1)
        expected = results;
      CHECK(results == expected);
      // Nor do threads that come or go later.
      const Threads others(n == 2 ? 4 : 2);
      CHECK(all_results(body) == expected);
    }
}

TEST_CASE("The number of ranks changes nothing but rounding")
{
  const auto surface = crowded_plate();
  const auto state   = random_state(surface, stretch(1.1, .95, .2));
  Body       here(MPI_COMM_SELF, surface), everywhere(MPI_COMM_WORLD, surface);
  here.state       = distribute(state, here.space);
  everywhere.state = distribute(state, everywhere.space);

  // The elements of a row are summed in another order.
  const auto close = [](const auto &a, const auto &b) {
    return (a - b).cwiseAbs().maxCoeff() <= 1e-14 * (1. + b.cwiseAbs().maxCoeff());
  };
  CHECK(close(everywhere.force(), here.force()));
  CHECK(close(everywhere.loads(some_loads()), here.loads(some_loads())));
  const auto matrix = [](const Body &body) {
    auto f = body.make_force();
    auto K = body.assembler.make_matrix();
    body.assembler.linearise(body.level(), body.state.history, .7, PhaseTangent::consistent, f, K);
    return dense(K);
  };
  CHECK(close(matrix(everywhere), matrix(here)));

  const auto a = everywhere.energies(), b = here.energies();
  CHECK(a.active == Approx(b.active).epsilon(1e-13));
  CHECK(a.passive == Approx(b.passive).epsilon(1e-13));
  CHECK(a.kinetic == Approx(b.kinetic).epsilon(1e-13));
  CHECK(a.fracture == Approx(b.fracture).epsilon(1e-13));
  CHECK(everywhere.withheld_work() == Approx(here.withheld_work()).epsilon(1e-13));
  CHECK(everywhere.assembler.shortest_edge() == here.assembler.shortest_edge());

  const auto committed = [](Body &body) {
    body.state.history = body.assembler.committed(body.level(), body.state.history);
    return gather(body.state, body.space).history;
  };
  CHECK(committed(everywhere) == committed(here));
}

TEST_CASE("A rank without control points takes part")
{
  // Nine control points; with ten ranks one of them owns nothing.
  const auto surface = shapes::plate<2, 2>({1., 1.}, {1, 1});
  Body       body(MPI_COMM_WORLD, surface);
  const int  n_ranks = body.space.environment().n_ranks();
  int        empty   = body.state.distribution->n_owned() == 0 ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &empty, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  CHECK((empty > 0) == (n_ranks > 9));

  const auto state = random_state(surface, stretch(1.1, 1.05));
  Body       here(MPI_COMM_SELF, surface);
  here.state = distribute(state, here.space);
  body.state = distribute(state, body.space);
  CHECK((body.force() - here.force()).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((body.loads(some_loads()) - here.loads(some_loads())).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(body.energies().active == Approx(here.energies().active).epsilon(1e-14));
  CHECK(gather(body.state, body.space).history == state.history);
  CHECK(body.assembler.shortest_edge() == here.assembler.shortest_edge());
}
