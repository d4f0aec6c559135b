// label: unit
// ranks: 1 3
#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>
#include <sherd/state/transfer.h>

using namespace sherd;

namespace
{

struct Sample
{
  Environment      env{MPI_COMM_WORLD};
  Surface<2, 3>    surface = make();
  ShellSpace<2, 3> space{env, surface, continuity::LagrangeMultiplier()};

  static Surface<2, 3> make()
  {
    std::mt19937 random(4);
    const auto   patches = test::star<2, 3>(3, 3, random);
    return Surface<2, 3>(patches, {}, find_interfaces(patches));
  }

  /// A state in which all values differ.
  State<2, 3> state() const
  {
    State<2, 3> state(space);
    for (int a = 0; a < state.distribution->n_local(); ++a)
      {
        const double id = static_cast<double>(state.distribution->global(a));
        for (int d = 0; d < 3; ++d)
          state.position.local()[3 * a + d] += .01 * id + d;
        state.phase.local()[a] += .001 * id;
        state.previous_phase.local()[a] += .002 * id;
      }
    return state;
  }
};

} // namespace

TEST_CASE("Multipliers start at zero, and stay out of what belongs to control points")
{
  const Sample      sample;
  const State<2, 3> state(sample.space);
  CHECK(state.n_control_points == sample.surface.n_control_points());
  CHECK(state.distribution->n_global() == sample.space.n_points());
  for (int a = 0; a < state.distribution->n_local(); ++a)
    {
      const bool multiplier = sample.space.is_multiplier(state.distribution->global(a));
      CHECK(state.phase.local()[a] == (multiplier ? 0. : 1.));
      if (multiplier)
        CHECK(state.position.local()[3 * a] == 0.);
    }
  const auto all = snapshot(state);
  CHECK(all.position == sample.surface.control_points());
  CHECK(all.velocity.rows() == sample.surface.n_control_points());
  CHECK(all.phase == Eigen::VectorXd::Ones(sample.surface.n_control_points()));
}

TEST_CASE("A state with multipliers comes back from gathering it")
{
  const Sample sample;
  const auto   state  = sample.state();
  const auto   global = gather(state, sample.space);
  const int    n      = sample.surface.n_control_points();
  CHECK(global.position.rows() == n);
  CHECK(global.velocity.rows() == n);
  REQUIRE(global.multipliers.values.rows() == sample.space.n_multipliers());
  for (int k = 0; k < sample.space.n_multipliers(); ++k)
    {
      CHECK(global.multipliers.values(k, 0) == Approx(.01 * (n + k)));
      CHECK(global.multipliers.values(k, 1) == Approx(.001 * (n + k)));
      CHECK(global.multipliers.values(k, 2) == Approx(.002 * (n + k)));
    }
  const auto back = distribute(global, sample.space);
  for (int a = 0; a < state.distribution->n_local(); ++a)
    {
      CHECK(back.position.local()[3 * a] == state.position.local()[3 * a]);
      CHECK(back.phase.local()[a] == state.phase.local()[a]);
      CHECK(back.previous_phase.local()[a] == state.previous_phase.local()[a]);
    }

  const ShellSpace<2, 3> penalty(sample.env, sample.surface);
  CHECK_THROWS_AS(distribute(global, penalty), DimensionMismatch);
}

TEST_CASE("After a refinement each piece has the multiplier of the one it was cut from")
{
  Sample     sample;
  const auto old    = gather(sample.state(), sample.space);
  const auto before = sample.space.interface_pieces();
  auto       now    = old;
  for (int level = 1; level < 3; ++level)
    {
      const auto &interface = sample.surface.interfaces()[level];
      const auto  points    = points_along(sample.surface, interface.first);
      const auto  boxes     = element_boxes(sample.surface);
      const auto  refined   = sample.surface.refine_to({points[1]}, test::halved(sample.surface, level));
      now                   = transfer(now, boxes, refined, sample.surface);
    }
  sample.space.rebuild();
  const auto pieces = sample.space.interface_pieces();
  REQUIRE(pieces.size() > before.size() + 4);
  REQUIRE(now.multipliers.values.rows() == static_cast<int>(pieces.size()));
  for (std::size_t k = 0; k < pieces.size(); ++k)
    {
      std::size_t parent = 0;
      while (before[parent].interface != pieces[k].interface || !(before[parent].range[0][0] <= pieces[k].range[0][0] &&
                                                                  pieces[k].range[0][1] <= before[parent].range[0][1]))
        REQUIRE(++parent < before.size());
      CHECK(now.multipliers.values.row(k) == old.multipliers.values.row(parent));
    }
  const auto state = distribute(now, sample.space);
  CHECK(state.distribution->n_global() == sample.space.n_points());
}
