// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/edge_geometry.h>

using namespace sherd;

namespace
{

/// int f(X) dS over a named edge.
template <int degree, int spacedim, class Function>
auto integral(const Surface<degree, spacedim> &surface, const std::string &name, const Function &f)
{
  std::decay_t<decltype(f(Point<spacedim>()))> sum = 0. * f(Point<spacedim>(Point<spacedim>::Zero()));
  for (const auto &edge : surface.edge(name))
    for (const auto &piece : edge_geometry(surface, edge))
      for (const auto &q : piece.quadrature)
        sum += q.dS * f(q.position);
  return sum;
}

} // namespace

TEST_CASE("Lengths and moments of straight edges are exact, hanging lines or not")
{
  auto surface = test::distorted(shapes::plate<2, 2>({2., 3.}, {4, 4}), .1);
  test::refine_at_random(surface, 2, 4, 12);
  for (const auto &[name, length, x, y] : {std::tuple{"left", 3., 0., 1.5}, std::tuple{"right", 3., 2., 1.5},
                                           std::tuple{"bottom", 2., 1., 0.}, std::tuple{"top", 2., 1., 3.}})
    {
      INFO(name);
      CHECK(integral(surface, name, [](const Point<2> &) { return 1.; }) == Approx(length).epsilon(1e-14));
      CHECK(integral(surface, name, [](const Point<2> &X) { return X[0]; }) == Approx(length * x).margin(1e-13));
      CHECK(integral(surface, name, [](const Point<2> &X) { return X[1]; }) == Approx(length * y).margin(1e-13));
    }
}

TEST_CASE("Shape functions on an edge sum to one and reproduce the position")
{
  auto surface = test::quarter_annulus<2, 2>(1., 2.);
  test::refine_at_random(surface, 3, 2, 4);
  const auto X = surface.control_points();
  for (const auto &[name, sides] : surface.edges())
    for (const auto &piece : edge_geometry(surface, sides.front()))
      for (const auto &q : piece.quadrature)
        {
          double   sum = 0.;
          Point<2> x   = Point<2>::Zero();
          for (std::size_t k = 0; k < piece.points.size(); ++k)
            {
              sum += q.value[k];
              x += q.value[k] * X.row(piece.points[k]).transpose();
            }
          CHECK(sum == Approx(1.).epsilon(1e-14));
          CHECK((x - q.position).norm() < 1e-14);
          if (name == "inner" || name == "outer")
            CHECK(q.position.norm() == Approx(name == "inner" ? 1. : 2.).epsilon(1e-14));
          else
            CHECK(std::abs(q.position[name == "start" ? 1 : 0]) < 1e-14);
        }
}

TEST_CASE("Length and resultant pressure of an arc converge with order 6")
{
  // int e_r dS over the outer quarter of radius 2 is (2, 2).
  auto   surface = test::quarter_annulus<2, 2>(1., 2.);
  double length[3], force[3];
  for (int level = 0; level < 3; ++level)
    {
      length[level] = std::abs(integral(surface, "outer", [](const Point<2> &) { return 1.; }) - M_PI);
      force[level] =
          (integral(surface, "outer", [](const Point<2> &X) -> Point<2> { return X / 2.; }) - Point<2>(2., 2.)).norm();
      test::refine_everywhere(surface, level + 1);
    }
  CHECK(std::log2(length[0] / length[1]) > 5.);
  CHECK(std::log2(length[1] / length[2]) > 5.5);
  CHECK(std::log2(force[0] / force[1]) > 5.);
  CHECK(length[2] < 1e-7); // what four elements reach
  CHECK(force[2] < 1e-7);
  CHECK(integral(surface, "start", [](const Point<2> &) { return 1.; }) == Approx(1.).epsilon(1e-14));
}

TEST_CASE("Pieces follow the edge in the direction of its parameter")
{
  auto surface = test::quarter_turn<2, 3>(1., 0., 1., 2.); // cylinder, u along its axis
  test::refine_at_random(surface, 3, 2, 9);
  double z = 0.;
  for (const auto &piece : edge_geometry(surface, surface.edge("start").front()))
    for (const auto &q : piece.quadrature)
      {
        CHECK(q.position[2] > z);
        z = q.position[2];
      }
  double y = 0.;
  for (const auto &piece : edge_geometry(surface, surface.edge("outer").front()))
    for (const auto &q : piece.quadrature)
      {
        CHECK(q.position[1] > y);
        y = q.position[1];
      }
}
