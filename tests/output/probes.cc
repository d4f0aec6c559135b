#include <catch2/catch.hpp>

#include <sherd/output/probes.h>

#include "rational_surfaces.h"
#include "temporary_folder.h"

using namespace sherd;

TEST_CASE("Probes: displacement, phase and reactions in named columns", "[output][probes]")
{
  const test::TemporaryFolder folder;
  const auto                  plate    = shapes::plate<2, 2>({2., 1.}, {4, 3});
  auto                        snapshot = test::scaled(plate, 1.5, 0.25);
  snapshot.phase                       = 0.25 * plate.control_points().col(0);

  Probes<2> probes(folder.path(), plate, {{"tip", {2., 1.}}, {"middle", {1., 0.5}}}, {"top"});
  probes.append(plate, snapshot, {Point<2>(3., -4.)});

  std::istringstream text(test::content(folder.path() / "probes.csv"));
  std::string        header, row;
  std::getline(text, header);
  std::getline(text, row);
  CHECK(header == "time,tip.ux,tip.uy,tip.phi,middle.ux,middle.uy,middle.phi,top.rx,top.ry");
  std::replace(row.begin(), row.end(), ',', ' ');
  std::istringstream cells(row);
  for (const double expected : {0.25, 1., 0.5, 0.5, 0.5, 0.25, 0.25, 3., -4.})
    {
      double value;
      REQUIRE(cells >> value);
      CHECK(value == Approx(expected).margin(1e-9));
    }
}

TEST_CASE("Probes: unusable names and places are refused before a file is touched", "[output][probes]")
{
  const test::TemporaryFolder folder;
  const auto                  plate = shapes::plate<2, 2>({2., 1.}, {4, 3});
  const auto make = [&](const std::vector<PointProbe<2>> &points, const std::vector<std::string> &edges) {
    Probes<2>(folder.path(), plate, points, edges);
  };

  CHECK_THROWS_AS(make({{"a", {0., 0.}}, {"a", {1., 0.}}}, {}), InvalidParameter);
  CHECK_THROWS_AS(make({{"a", {0., 0.}}}, {"a"}), InvalidParameter);
  CHECK_THROWS_AS(make({{"a,b", {0., 0.}}}, {}), InvalidParameter);
  CHECK_THROWS_AS(make({{"a", {0., 3.}}}, {}), InvalidParameter);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "probes.csv"));
}
