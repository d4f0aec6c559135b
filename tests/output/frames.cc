#include <catch2/catch.hpp>

#include <cstring>
#include <set>

#include <zlib.h>

#include <sherd/output/frames.h>

#include "rational_surfaces.h"
#include "temporary_folder.h"

using namespace sherd;

namespace
{

/// The values of an array of a .vtu file, read as a reader would: header, blocks, zlib.
template <class T>
std::vector<T> array(const std::string &vtu, const std::string &name)
{
  const auto  start  = vtu.find("Name=\"" + name + "\"");
  const auto  offset = std::stoul(vtu.substr(vtu.find("offset=\"", start) + 8));
  const auto  data   = vtu.find("<AppendedData encoding=\"raw\">");
  const auto *p      = vtu.data() + vtu.find('_', data) + 1 + offset;
  const auto  read   = [&] {
    std::uint64_t value;
    std::memcpy(&value, p, sizeof(value));
    p += sizeof(value);
    return value;
  };
  const auto                 n_blocks = read(), block = read(), last = read();
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t k = 0; k < n_blocks; ++k)
    sizes.push_back(read());
  std::string bytes;
  for (std::uint64_t k = 0; k < n_blocks; ++k)
    {
      std::string buffer(block, '\0');
      uLongf      length = block;
      REQUIRE(uncompress(reinterpret_cast<Bytef *>(buffer.data()), &length, reinterpret_cast<const Bytef *>(p),
                         sizes[k]) == Z_OK);
      CHECK(length == (k + 1 < n_blocks || last == 0 ? block : last));
      bytes.append(buffer, 0, length);
      p += sizes[k];
    }
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

} // namespace

TEST_CASE("vtk_bezier_order: corners, sides, inside", "[output][frames]")
{
  CHECK(vtk_bezier_order(2) == std::vector<int>{0, 2, 8, 6, 1, 5, 7, 3, 4});
  CHECK(vtk_bezier_order(3) == std::vector<int>{0, 3, 15, 12, 1, 2, 7, 11, 13, 14, 4, 8, 5, 6, 9, 10});
}

TEST_CASE("Frame: a rational cell is exact, read back from the file", "[output][frames]")
{
  const test::TemporaryFolder folder;
  const auto                  cylinder = test::refined_quarter_cylinder();

  write_frame(folder.path() / "f.vtu", cylinder, test::scaled(cylinder, 1., 0.));

  const auto vtu     = test::content(folder.path() / "f.vtu");
  const auto points  = array<double>(vtu, "Points");
  const auto weights = array<double>(vtu, "RationalWeights");
  const auto cells   = array<std::int32_t>(vtu, "connectivity");
  const auto types   = array<std::uint8_t>(vtu, "types");
  const auto degrees = array<double>(vtu, "HigherOrderDegrees");
  REQUIRE(types.size() == static_cast<std::size_t>(cylinder.n_elements()));
  REQUIRE(cells.size() == 9 * types.size());
  REQUIRE(degrees.size() == 3 * types.size());
  REQUIRE(weights.size() == points.size() / 3);
  const auto order = vtk_bezier_order(2);
  double     worst = 0.;
  for (std::size_t c = 0; c < types.size(); ++c)
    {
      CHECK(types[c] == 77);
      CHECK(degrees[3 * c] == 2.);
      for (double s : {0., 0.3, 0.77, 1.})
        for (double t : {0., 0.45, 1.})
          {
            const auto B = bernstein_2d<2>(s, t).value;
            double     x = 0., y = 0., w = 0.;
            for (int k = 0; k < 9; ++k)
              {
                const auto   point = cells[9 * c + k];
                const double f     = B[order[k]] * weights[point];
                x += f * points[3 * point];
                y += f * points[3 * point + 1];
                w += f;
              }
            worst = std::max(worst, std::abs(std::hypot(x, y) / w - 1.));
          }
    }
  CHECK(worst < 1e-14); // a few roundings of numbers of size 1
}

TEST_CASE("Frame: fields, levels and cell fields are where they belong", "[output][frames]")
{
  const auto          cylinder = test::refined_quarter_cylinder();
  std::vector<double> energy;
  for (int e = 0; e < cylinder.n_elements(); ++e)
    energy.push_back(e);

  const auto grid = bezier_grid(cylinder, test::scaled(cylinder, 1.5, 0.), {{"elastic", energy}});

  REQUIRE(grid.point_data.size() == 3);
  const auto &displacement = grid.point_data[1].values, &velocity = grid.point_data[2].values;
  for (std::size_t p = 0; p < grid.points.size(); ++p)
    {
      CHECK(grid.point_data[0].values[p] == Approx(1.));
      for (int d = 0; d < 3; ++d)
        {
          // single precision of values of size 1
          CHECK(displacement[3 * p + d] == Approx(grid.points[p][d] / 3.).margin(1e-6));
          CHECK(velocity[3 * p + d] == Approx(grid.points[p][d] / 1.5).margin(1e-6));
        }
    }
  const auto     &level = grid.cell_data[0].values;
  std::set<float> levels(level.begin(), level.end());
  CHECK(levels == std::set<float>{0.f, 1.f});
  for (int e = 0; e < cylinder.n_elements(); ++e)
    CHECK(level[e] == (cylinder.patch(0).basis.element(e).size()[0] == 0.25 ? 1.f : 0.f));
  CHECK(grid.cell_data[1].name == "elastic");
  CHECK(grid.cell_data[1].values[2] == 2.f);
}

TEST_CASE("Frame: equal neighbours share points, the plane has z = 0", "[output][frames]")
{
  const auto plate = shapes::plate<3, 2>({2., 1.}, {4, 3});

  const auto grid = bezier_grid(plate, test::scaled(plate, 1., 0.));

  CHECK(grid.points.size() == (3 * 4 + 1) * (3 * 3 + 1));
  std::set<std::array<double, 3>> places(grid.points.begin(), grid.points.end());
  CHECK(places.size() == grid.points.size());
  for (const auto &x : grid.points)
    CHECK(x[2] == 0.);
}

TEST_CASE("Frame: arrays of the wrong size are refused", "[output][frames]")
{
  const auto plate    = shapes::plate<2, 2>({2., 1.}, {4, 3});
  auto       snapshot = test::scaled(plate, 1., 0.);

  CHECK_THROWS_AS(bezier_grid(plate, snapshot, {{"elastic", {1., 2.}}}), DimensionMismatch);
  snapshot.phase.resize(3);
  CHECK_THROWS_AS(bezier_grid(plate, snapshot), DimensionMismatch);
}

TEST_CASE("FrameWriter: numbers frames, lists them, and goes on after a restart", "[output][frames]")
{
  const test::TemporaryFolder folder;
  const auto                  plate = shapes::plate<2, 2>({2., 1.}, {4, 3});
  {
    FrameWriter writer(folder.path());
    for (double time : {0., 0.1, 0.2, 0.3})
      writer.write(plate, test::scaled(plate, 1., time));
  }

  auto writer = FrameWriter::resume(folder.path(), 0.2);
  CHECK(writer.n_frames() == 3);
  writer.write(plate, test::scaled(plate, 1., 1. / 3.));

  const auto entries = read_pvd(folder.path() / "frames.pvd");
  REQUIRE(entries.size() == 4);
  CHECK(entries[3].time == 1. / 3.);
  CHECK(entries[3].file == "frames/000003.vtu");
  CHECK(std::filesystem::exists(folder.path() / entries[3].file));
}

TEST_CASE("vtu_text: data of several compressed blocks read back", "[output][frames]")
{
  BezierGrid grid{1, {}, {}, {}, {{"f", 1, {}}}, {}};
  for (int k = 0; k < 50000; ++k)
    {
      grid.points.push_back({double(k), std::sin(k), 0.});
      grid.weights.push_back(1.);
      grid.point_data[0].values.push_back(std::cos(k));
      grid.cells.push_back(k);
    }

  const auto vtu = vtu_text(grid);

  const auto points = array<double>(vtu, "Points");
  REQUIRE(points.size() == 150000);
  CHECK(points[3 * 49999 + 1] == std::sin(49999));
  CHECK(array<float>(vtu, "f") == grid.point_data[0].values);
}
