// label: unit
#include <catch2/catch.hpp>

#include <sherd/adapt/refine_along.h>
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
