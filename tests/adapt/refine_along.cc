// label: unit
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <sherd/adapt/refine_along.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;

TEST_CASE("The mesh is fine along a line and stays coarse away from it")
{
  constexpr double target = 1. / 32., width = .1;
  auto             plate = shapes::plate<2, 2>({4., 2.}, {16, 8});
  // Between control points of the coarse mesh, bent, and it ends inside.
  const Polyline<2> line({{.3, .3}, {1.1, .62}, {1.3, .2}});
  refine_along(plate, line, width, target);

  int n_far = 0;
  for (int e = 0; e < plate.n_elements(); ++e)
    {
      const auto     element = plate.patch(0).basis.element(e);
      const auto     size    = element.size(); // a knot span is a quarter
      const Point<2> middle(.125 * (element.min[0] + element.max[0]), .125 * (element.min[1] + element.max[1]));
      if (distance(middle, line) <= width)
        {
          CHECK(.25 * size[0] <= target * (1. + 1e-9));
          CHECK(.25 * size[1] <= target * (1. + 1e-9));
        }
      else if (distance(middle, line) > 1.)
        {
          CHECK(size[0] == 1.);
          ++n_far;
        }
    }
  CHECK(n_far > 40);

  const int n = plate.n_elements();
  refine_along(plate, line, width, target);
  CHECK(plate.n_elements() == n);
}

TEST_CASE("The mesh is fine along a line on a curved surface, too")
{
  // Control points lie off the surface, by as much as coarse elements are long; the line runs from patch to patch.
  constexpr double target = .05, width = .08;
  auto             sphere    = shapes::sphere<2>(1., 4);
  const auto       on_sphere = [](double azimuth, double z) {
    const double r = std::sqrt(1. - z * z);
    return Point<3>(r * std::cos(azimuth), r * std::sin(azimuth), z);
  };
  std::vector<Point<3>> points;
  for (int k = 0; k <= 60; ++k)
    points.push_back(on_sphere(.2 + k / 60. * 1.6, .9 - k / 60. * 1.1));
  const Polyline<3> line(points);
  refine_along(sphere, line, width, target);

  // A length of a side in three pieces.
  const auto longest_side = [&](int p, const Box &box) {
    const auto at      = [&](double u, double v) { return position(sphere, SurfacePlace{p, u, v}); };
    double     longest = 0.;
    for (const bool along_u : {true, false})
      for (const double end : {0., 1.})
        {
          double length = 0.;
          for (int k = 0; k < 3; ++k)
            {
              const auto corner = [&](double t) {
                const double s = along_u ? t : end, r = along_u ? end : t;
                return at(box.min[0] + s * box.size()[0], box.min[1] + r * box.size()[1]);
              };
              length += (corner((k + 1) / 3.) - corner(k / 3.)).norm();
            }
          longest = std::max(longest, length);
        }
    return longest;
  };
  int n_near = 0, n_far = 0;
  for (int e = 0; e < sphere.n_elements(); ++e)
    {
      const auto [p, local] = sphere.locate_element(e);
      const Box &box        = sphere.patch(p).basis.element(local);
      const auto middle =
          position(sphere, SurfacePlace{p, .5 * (box.min[0] + box.max[0]), .5 * (box.min[1] + box.max[1])});
      if (distance(middle, line) <= width)
        {
          // Targets are those of the quadrature points of the first mesh.
          CHECK(longest_side(p, box) <= 1.02 * target);
          ++n_near;
        }
      else if (distance(middle, line) > 1.2)
        {
          CHECK(longest_side(p, box) > 4. * target);
          ++n_far;
        }
    }
  CHECK(n_near > 100);
  CHECK(n_far >= 4);
}

TEST_CASE("A width or a target that makes no sense is refused, and nothing is refined")
{
  auto              plate = shapes::plate<2, 2>({4., 2.}, {4, 2});
  const Polyline<2> line({{.3, .3}, {1.1, .62}});
  const double      nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double width : {-.1, nan, infinity})
    CHECK_THROWS_WITH(refine_along(plate, line, width, .1), Catch::Contains("width"));
  for (const double target : {0., -1., nan, infinity})
    CHECK_THROWS_WITH(refine_along(plate, line, .1, target), Catch::Contains("target"));
  CHECK(plate.n_elements() == 8);
}
