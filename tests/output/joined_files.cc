// label: unit
// ranks: 1 2
#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>
#include <sherd/output/checkpoint.h>
#include <sherd/output/frames.h>

#include "temporary_folder.h"

using namespace sherd;

namespace
{

Surface<2, 3> sample()
{
  std::mt19937  random(6);
  const auto    patches = sherd::test::star<2, 3>(3, 2, random);
  Surface<2, 3> surface(patches, {{"rim", {{0, Side::u_max}}}}, find_interfaces(patches));
  surface.refine_to({points_along(surface, surface.interfaces()[0].first)[1]}, sherd::test::halved(surface, 1));
  return surface;
}

template <class Matrix>
void fill(Matrix &values, Eigen::Index rows, Eigen::Index columns, std::mt19937 &random)
{
  values.resize(rows, columns);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values.data()[i] = sherd::test::symmetric(random);
}

} // namespace

TEST_CASE("A checkpoint holds interfaces and multipliers", "[output][checkpoint]")
{
  const ::test::TemporaryFolder folder;
  const Environment             env(MPI_COMM_WORLD);
  const auto                    file    = folder.path() / "checkpoint.h5";
  const auto                    surface = sample();
  const ShellSpace<2, 3>        space(env, surface, continuity::LagrangeMultiplier());
  std::mt19937                  random(2);

  Checkpoint<2, 3> wanted{surface, {}, {}, {}, {}};
  auto            &state = wanted.state;
  const int        n     = surface.n_control_points();
  for (auto *values : {&state.position, &state.velocity, &state.acceleration})
    fill(*values, n, 3, random);
  fill(state.phase, n, 1, random);
  fill(state.previous_phase, n, 1, random);
  fill(state.history, surface.n_elements(), 9, random);
  state.multipliers.pieces = interface_pieces(surface);
  fill(state.multipliers.values, static_cast<Eigen::Index>(state.multipliers.pieces.size()), 3, random);
  if (env.rank() == 0)
    write_checkpoint(file, wanted);
  MPI_Barrier(env.comm());
  const auto found = read_checkpoint<2, 3>(env, file);
  MPI_Barrier(env.comm());

  REQUIRE(found.surface.interfaces().size() == surface.interfaces().size());
  for (std::size_t k = 0; k < surface.interfaces().size(); ++k)
    {
      const auto &a = found.surface.interfaces()[k], &b = surface.interfaces()[k];
      CHECK((a.first.patch == b.first.patch && a.first.side == b.first.side && a.second.patch == b.second.patch &&
             a.second.side == b.second.side && a.reversed == b.reversed));
    }
  CHECK(found.surface.n_control_points() == n);
  CHECK(found.surface.control_points() == surface.control_points());
  CHECK(found.state.multipliers.values == state.multipliers.values);
  CHECK(found.state.multipliers.pieces.size() == state.multipliers.pieces.size());
  CHECK(found.state.phase == state.phase);
  const auto restored = gather(distribute(found.state, space), space);
  CHECK(restored.multipliers.values == state.multipliers.values);
  CHECK(restored.position == state.position);
}

TEST_CASE("A frame of joined patches has no gaps", "[output][frames]")
{
  const auto   surface = sample();
  std::mt19937 random(3);
  const int    n = surface.n_control_points();

  Snapshot<3> snapshot;
  fill(snapshot.position, n, 3, random);
  fill(snapshot.velocity, n, 3, random);
  fill(snapshot.phase, n, 1, random);
  const auto grid = bezier_grid(surface, snapshot);

  REQUIRE(grid.cell_data.size() == 2);
  CHECK(grid.cell_data[1].name == "patch");
  for (int e = 0; e < surface.n_elements(); ++e)
    CHECK(grid.cell_data[1].values[e] == static_cast<float>(surface.locate_element(e).patch));

  // Corners of elements on an interface are points of the grid on both patches.
  for (const auto &piece : interface_pieces(surface))
    {
      int n_common = 0;
      for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
          {
            const auto &a = grid.points[grid.cells[9 * piece.elements[0] + i]];
            const auto &b = grid.points[grid.cells[9 * piece.elements[1] + j]];
            n_common += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-13;
          }
      CHECK(n_common == 3);
    }
}
