#include <catch2/catch.hpp>

#include <array>
#include <vector>

#include <sherd/spline/lr_mesh.h>

using namespace sherd;

namespace
{

LRMesh square()
{
  const std::array knots{0., 0., 0., 4., 4., 4.};
  return {knots, knots};
}

/// Lines strictly inside the square.
std::vector<MeshLine> inner_lines(const LRMesh &mesh)
{
  auto lines = mesh.lines();
  std::erase_if(lines, [](const MeshLine &line) { return line.value == 0. || line.value == 4.; });
  return lines;
}

} // namespace

TEST_CASE("LRMesh: the tensor mesh has the lines of its knots", "[spline]")
{
  const std::array u{0., 0., 0., 1., 1., 2., 2., 2.};
  const std::array v{5., 5., 5., 6., 6., 6.};

  const LRMesh mesh(u, v);

  CHECK(mesh.lines() == std::vector<MeshLine>{{Direction::u, 0., 5., 6., 3},
                                              {Direction::u, 1., 5., 6., 2},
                                              {Direction::u, 2., 5., 6., 3},
                                              {Direction::v, 5., 0., 2., 3},
                                              {Direction::v, 6., 0., 2., 3}});
  CHECK(mesh.between(Direction::u, 0., 2.).size() == 1);
  CHECK(mesh.between(Direction::v, 5., 6.).empty());
}

TEST_CASE("LRMesh: overlapping and touching lines merge, separate ones stay apart", "[spline]")
{
  auto mesh = square();

  mesh.add(std::array{MeshLine{Direction::u, 1., 0., 1.}, MeshLine{Direction::u, 1., 2., 3.}});
  CHECK(inner_lines(mesh) == std::vector<MeshLine>{{Direction::u, 1., 0., 1.}, {Direction::u, 1., 2., 3.}});
  CHECK(mesh.multiplicity(Direction::u, 1., 0., 1.) == 1);
  CHECK(mesh.multiplicity(Direction::u, 1., 0.5, 2.5) == 0);

  mesh.add(std::array{MeshLine{Direction::u, 1., 1., 2.5}});
  CHECK(inner_lines(mesh) == std::vector<MeshLine>{{Direction::u, 1., 0., 3.}});
  CHECK(mesh.multiplicity(Direction::u, 1., 0., 3.) == 1);
  CHECK(mesh.multiplicity(Direction::u, 1., 0., 4.) == 0);
  CHECK(mesh.multiplicity(Direction::u, 1.5, 0., 1.) == 0);
}

TEST_CASE("LRMesh: the multiplicity counts part by part", "[spline]")
{
  auto mesh = square();

  mesh.add(std::array{MeshLine{Direction::v, 1., 0., 3., 1}, MeshLine{Direction::v, 1., 1., 4., 2}});
  CHECK(inner_lines(mesh) == std::vector<MeshLine>{{Direction::v, 1., 0., 4., 1}, {Direction::v, 1., 1., 4., 2}});
  CHECK(mesh.multiplicity(Direction::v, 1., 0., 4.) == 1);
  CHECK(mesh.multiplicity(Direction::v, 1., 1., 2.) == 2);

  mesh.add(std::array{MeshLine{Direction::v, 1., 0., 4., 1}, MeshLine{Direction::v, 1., 0., 1., 2}});
  CHECK(inner_lines(mesh) == std::vector<MeshLine>{{Direction::v, 1., 0., 4., 2}});
}

TEST_CASE("LRMesh: the order of the lines does not matter", "[spline]")
{
  const std::vector<MeshLine> lines{{Direction::u, 1., 0., 2., 1}, {Direction::u, 1., 3., 4., 2},
                                    {Direction::u, 1., 1., 4., 1}, {Direction::u, 1., 1.5, 3.5, 2},
                                    {Direction::v, 1., 0., 1., 1}, {Direction::u, 2., 0., 1., 1}};
  auto                        mesh = square();
  mesh.add(lines);

  for (std::size_t first = 1; first < lines.size(); ++first)
    {
      auto other = square();
      for (std::size_t k = 0; k < lines.size(); ++k)
        other.add(std::array{lines[(first + k) % lines.size()]});
      CHECK(other.lines() == mesh.lines());
    }
}
