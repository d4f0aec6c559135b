// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;

namespace
{

/// Exact quarter cylinder with hanging lines.
Surface<2, 3> refined_cylinder()
{
  auto surface = shapes::cylinder<2>(1., 2., {0., M_PI / 2.}, {2, 2});
  test::refine_at_random(surface, 2, 2, 31);
  return surface;
}

} // namespace

TEST_CASE("The closest place finds the parameters of points of curved surfaces")
{
  const auto check = [](const auto &surface) {
    const auto &domain = surface.patch(0).basis.domain();
    for (const double s : {0., .11, .5, .93, 1.})
      for (const double t : {0., .37, 1.})
        {
          const double u = s * domain.max[0], v = t * domain.max[1];
          const auto   place = closest_place(surface, test::position_at(surface.patch(0), u, v));
          CHECK(place.patch == 0);
          CHECK(place.u == Approx(u).margin(1e-7)); // square root of the rounding of a distance
          CHECK(place.v == Approx(v).margin(1e-7));
        }
  };
  check(refined_cylinder());
  check(shapes::sphere_patch<2>(3., {3, 2}, shapes::Fit::rational));
  check(shapes::torus<3>(3., 1., {0., 2.}, {-2., 2.5}, {3, 4}, shapes::Fit::smooth));
  check(shapes::plate<4, 2>({2., 5.}, {3, 1}));
}

TEST_CASE("Points off the surface go to the foot of their normal")
{
  const auto   cylinder = refined_cylinder(); // X = (x, sin, cos), one unit of u is one of x, v = 1 is 45 degrees
  const double factor   = GENERATE(.4, 1., 1.7);
  for (const double angle : {.1, M_PI / 4., 1.5})
    {
      const Point<3> X(1.3, factor * std::sin(angle), factor * std::cos(angle));
      const auto     place = closest_place(cylinder, X);
      const auto     foot  = position(cylinder, place);
      CHECK(place.u == Approx(1.3).margin(1e-7));
      CHECK((foot - Point<3>(1.3, std::sin(angle), std::cos(angle))).norm() < 2e-7);
    }
}

TEST_CASE("Beyond the border the closest place lies on it")
{
  const auto plate = shapes::plate<2, 2>({2., 1.}, {4, 3});
  const auto check = [&](const Point<2> &X, double u, double v) {
    const auto place = closest_place(plate, X);
    CHECK(place.u == Approx(u).margin(1e-9));
    CHECK(place.v == Approx(v).margin(1e-9));
  };
  check({3., .4}, 4., 1.2);
  check({.55, -2.}, 1.1, 0.);
  check({-1., 7.}, 0., 3.);

  // A sheared border: the nearest point of the side x = y is not the projection in the parameters.
  const auto knots   = shapes::uniform_knots<2>(2);
  const auto sheared = interpolate<2, 2>(knots, knots, [](double u, double v) { return Point<2>(u + v, v); });
  const auto place   = closest_place(sheared, Point<2>(0., 1.));
  CHECK(place.u == 0.);
  CHECK(place.v == Approx(.5).margin(1e-7));
}

TEST_CASE("The closest place is found on every patch")
{
  auto lower = shapes::plate<2, 2>({1., 1.}, {2, 3}).patch(0);
  auto upper = shapes::plate<2, 2>({1., 1.}, {4, 2}).patch(0);
  upper.control_points.col(1).array() += 1.;
  const Surface<2, 2> surface({lower, upper}, {});
  const auto          place = closest_place(surface, Point<2>(.3, 1.6));
  CHECK(place.patch == 1);
  CHECK(place.u == Approx(1.2).margin(1e-8));
  CHECK(place.v == Approx(1.2).margin(1e-8));
  const auto shape = evaluate(surface, place);
  CHECK(shape.points.size() == 9);
  CHECK(*std::min_element(shape.points.begin(), shape.points.end()) >= surface.point(1, 0));
  CHECK((position(surface, place) - Point<2>(.3, 1.6)).norm() < 1e-8);
}

TEST_CASE("The closest place of a closed surface lies on the patch below the point")
{
  // Patches share the samples on their edges, so that the closest one to a point near an edge belongs to the neighbour,
  // too.
  const auto   sphere = shapes::sphere<4>(2., 2, shapes::Fit::exact);
  std::mt19937 random(11);
  for (int k = 0; k < 100; ++k)
    {
      Point<3> direction(test::symmetric(random), test::symmetric(random), test::symmetric(random));
      if (direction.norm() < .1)
        continue;
      direction.normalize();
      // From outside, on the surface and from inside.
      for (const double radius : {2.7, 2., 1.6})
        {
          const auto foot = position(sphere, closest_place(sphere, Point<3>(radius * direction)));
          CHECK((foot - 2. * direction).norm() < 1e-6);
        }
    }
}

TEST_CASE("The closest place is found where a side is drawn together to a point")
{
  // A sector of a disc, its tip at u = 0.
  const auto knots = shapes::uniform_knots<2>(3);
  const auto sector =
      interpolate<2, 2>(knots, knots, [](double u, double v) { return Point<2>(u, u * (v / 3. - .5)); });
  for (const Point<2> &X : {Point<2>(0., 0.), Point<2>(-.3, .1), Point<2>(1.7, .2), Point<2>(1e-3, 0.)})
    {
      const auto   foot = position(sector, closest_place(sector, X));
      const double best = X[0] < 0. ? X.norm() : 0.;
      CHECK((foot - X).norm() == Approx(best).margin(1e-7));
    }
}

TEST_CASE("Shape functions at a place sum to one and give position and fields")
{
  const auto      surface = refined_cylinder();
  const auto      X       = surface.control_points();
  const auto     &domain  = surface.patch(0).basis.domain();
  Eigen::VectorXd field(X.rows());
  std::mt19937    random(5);
  for (double &value : field)
    value = test::symmetric(random);
  const Patch<2, 1> patch{surface.patch(0).basis, field, surface.weights()};
  for (const double s : {0., .2, .61, 1.})
    for (const double t : {0., .5, .77, 1.})
      {
        const SurfacePlace place{0, s * domain.max[0], t * domain.max[1]};
        const auto         shape = evaluate(surface, place);
        double             sum = 0., value = 0.;
        for (std::size_t k = 0; k < shape.points.size(); ++k)
          {
            sum += shape.value[k];
            value += shape.value[k] * field[shape.points[k]];
          }
        CHECK(sum == Approx(1.).epsilon(1e-15));
        CHECK(value == Approx(test::position_at(patch, place.u, place.v)[0]).margin(1e-15));
        CHECK((position(surface, place) - test::position_at(surface.patch(0), place.u, place.v)).norm() < 1e-15);
      }
  CHECK_THROWS_AS(evaluate(surface, SurfacePlace{0, -1., 0.}), InvalidParameter);
}
