// label: unit
// ranks: 1 2 3 5
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <space/shared_out.h>
#include <sherd/state/state.h>

using namespace sherd;

namespace
{

using TheState  = State<2, 2>;
using TheGlobal = GlobalState<2, 2>;

Surface<2, 2> refined_plate()
{
  auto surface = shapes::plate<2, 2>({1., 1.}, {4, 4});
  test::refine_at_random(surface, 2, 3, 73);
  return surface;
}

/// Other numbers everywhere, the same on all ranks.
TheGlobal random_state(const Surface<2, 2> &surface)
{
  std::mt19937 random(19);
  const auto   fill = [&](auto &values, int rows, int columns) {
    values.resize(rows, columns);
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values.data()[i] = test::symmetric(random);
  };
  TheGlobal global;
  const int n = surface.n_control_points();
  fill(global.position, n, 2);
  fill(global.velocity, n, 2);
  fill(global.acceleration, n, 2);
  fill(global.phase, n, 1);
  fill(global.previous_phase, n, 1);
  fill(global.history, surface.n_elements(), 9);
  global.time      = 1.5;
  global.step_size = .25;
  global.step      = 42;
  return global;
}

} // namespace

TEST_CASE("A new state is at rest, undeformed and intact")
{
  const auto             surface = refined_plate();
  const ShellSpace<2, 2> space(Environment(MPI_COMM_WORLD), surface);
  const TheState         state(space);
  const auto             X = surface.control_points();
  for (int a = 0; a < state.distribution->n_local(); ++a)
    for (int d = 0; d < 2; ++d)
      {
        CHECK(state.position.local()[2 * a + d] == X(state.distribution->global(a), d));
        CHECK(state.velocity.local()[2 * a + d] == 0.);
        CHECK(state.acceleration.local()[2 * a + d] == 0.);
      }
  for (const double phi : state.phase.local())
    CHECK(phi == 1.);
  for (const double phi : state.previous_phase.local())
    CHECK(phi == 1.);
  REQUIRE(state.history.n_points() == 9);
  for (int e = 0; e < space.n_active_elements(); ++e)
    for (int q = 0; q < 9; ++q)
      CHECK(state.history[e][q] == 0.);
  CHECK(state.time == 0.);
  CHECK(state.step == 0);
}

TEST_CASE("Distributing and gathering a state gives the same bits on any number of ranks")
{
  const auto             surface = refined_plate();
  const ShellSpace<2, 2> space(Environment(MPI_COMM_WORLD), surface);
  const auto             global = random_state(surface);
  const auto             state  = distribute(global, space);
  const auto             back   = gather(state, space);

  CHECK(back.position == global.position);
  CHECK(back.velocity == global.velocity);
  CHECK(back.acceleration == global.acceleration);
  CHECK(back.phase == global.phase);
  CHECK(back.previous_phase == global.previous_phase);
  CHECK(back.history == global.history);
  CHECK(back.time == global.time);
  CHECK(back.step_size == global.step_size);
  CHECK(back.step == global.step);

  // Ghosts are set, and every active element has its history whoever owns it.
  for (int a = 0; a < state.distribution->n_local(); ++a)
    CHECK(state.phase.local()[a] == global.phase[state.distribution->global(a)]);
  for (int e = 0; e < space.n_active_elements(); ++e)
    for (int q = 0; q < 9; ++q)
      CHECK(state.history[e][q] == global.history(space.distribution().elements[e], q));
}

TEST_CASE("State and history move with their control points and elements when these go to other ranks")
{
  const auto             surface = refined_plate();
  const Environment      env(MPI_COMM_WORLD);
  const int              last   = env.n_ranks() - 1;
  const auto             global = random_state(surface);
  const ShellSpace<2, 2> first(env, surface), second(env, surface, continuity::Penalty(), test::leaving_out(last)),
      third(env, surface, continuity::Penalty(), test::leaving_out(0));
  const auto moved = distribute(gather(distribute(global, first), first), second);
  const auto again = distribute(gather(moved, second), third);
  if (env.n_ranks() > 1)
    {
      CHECK((env.rank() == last) == (second.n_active_elements() == 0));
      CHECK((env.rank() == 0) == (third.n_active_elements() == 0));
    }

  for (const auto &[space, state] : {std::pair(&second, &moved), std::pair(&third, &again)})
    {
      for (int e = 0; e < space->n_active_elements(); ++e)
        for (int q = 0; q < 9; ++q)
          CHECK(state->history[e][q] == global.history(space->distribution().elements[e], q));
      const auto back = gather(*state, *space);
      CHECK(back.history == global.history);
      CHECK(back.position == global.position);
      CHECK(back.previous_phase == global.previous_phase);
    }
}

TEST_CASE("The history that is gathered is its owner's")
{
  const auto             surface = refined_plate();
  const ShellSpace<2, 2> space(Environment(MPI_COMM_WORLD), surface);
  TheState               state(space);
  for (int e = 0; e < space.n_active_elements(); ++e)
    std::fill_n(state.history[e], 9, space.environment().rank() + 1.);
  const auto  global = gather(state, space);
  const auto &owner  = space.distribution().element_owner;
  for (int e = 0; e < surface.n_elements(); ++e)
    CHECK((global.history.row(e).array() == owner[e] + 1.).all());
}

TEST_CASE("A snapshot is complete on every rank")
{
  const auto             surface = refined_plate();
  const ShellSpace<2, 2> space(Environment(MPI_COMM_WORLD), surface);
  const auto             global = random_state(surface);
  const auto             shot   = snapshot(distribute(global, space));
  CHECK(shot.time == 1.5);
  CHECK(shot.position == global.position);
  CHECK(shot.velocity == global.velocity);
  CHECK(shot.phase == global.phase);
}

TEST_CASE("A copy of a state is independent")
{
  const auto             surface = refined_plate();
  const ShellSpace<2, 2> space(Environment(MPI_COMM_WORLD), surface);
  auto                   state = distribute(random_state(surface), space);
  const auto             copy  = state;
  for (Vector *v : {&state.position, &state.velocity, &state.acceleration, &state.phase, &state.previous_phase})
    v->fill(7.);
  for (int e = 0; e < space.n_active_elements(); ++e)
    std::fill_n(state.history[e], 9, 7.);
  state.time = 9.;

  const auto kept = gather(copy, space), expected = random_state(surface);
  CHECK(kept.position == expected.position);
  CHECK(kept.velocity == expected.velocity);
  CHECK(kept.acceleration == expected.acceleration);
  CHECK(kept.phase == expected.phase);
  CHECK(kept.previous_phase == expected.previous_phase);
  CHECK(kept.history == expected.history);
  CHECK(kept.time == 1.5);

  state = copy; // a rejected step
  CHECK(gather(state, space).history == expected.history);
  CHECK(gather(state, space).position == expected.position);
}
