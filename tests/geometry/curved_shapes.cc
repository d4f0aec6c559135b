// label: verification
#include <limits>

#include <catch2/catch.hpp>

#include <geometry/area.h>
#include <geometry/sample_surfaces.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;
using sherd::test::area;
using shapes::Fit;

namespace
{

/// Largest |f(X)| over 5 x 5 points an element.
template <int degree, int spacedim, class Function>
double largest(const Surface<degree, spacedim> &surface, const Function &f)
{
  const auto &patch  = surface.patch(0);
  double      result = 0.;
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto X = bezier_element<spacedim>(patch, e, patch.control_points);
      for (int k = 0; k < 25; ++k)
        result = std::max(result, std::abs(f(X(X.box.min[0] + X.box.size()[0] * (k % 5) / 4.,
                                               X.box.min[1] + X.box.size()[1] * (k / 5) / 4.))));
    }
  return result;
}

/// Largest |f(X)| along a named edge.
template <int degree, int spacedim, class Function>
double largest_along(const Surface<degree, spacedim> &surface, const std::string &name, const Function &f)
{
  REQUIRE(surface.edge(name).size() == 1);
  const Side  side   = surface.edge(name).front().side;
  const auto &domain = surface.patch(0).basis.domain();
  double      result = 0.;
  for (int k = 0; k <= 20; ++k)
    {
      double u = domain.max[0] * k / 20., v = domain.max[1] * k / 20.;
      if (side == Side::u_min || side == Side::u_max)
        u = side == Side::u_min ? 0. : domain.max[0];
      else
        v = side == Side::v_min ? 0. : domain.max[1];
      result = std::max(result, std::abs(f(position(surface, {0, u, v}))));
    }
  return result;
}

/// Largest |H - H(X)|, |K - K(X)| at the quadrature points; relative to @p scale and its square.
template <int degree, class Mean, class Gauss>
double curvature_defect(const Surface<degree, 3> &surface, double scale, const Mean &mean, const Gauss &gauss)
{
  double result = 0.;
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto g = element_geometry(surface, e);
      for (int q = 0; q < g.n_q; ++q)
        {
          const Voigt &A = g.reference[q].covariant, &B = g.reference[q].curvature;
          const double H = .5 * contract(g.reference[q].contravariant, B);
          const double K = (B[0] * B[1] - B[2] * B[2]) / (A[0] * A[1] - A[2] * A[2]);
          const auto   X = g.position(q);
          result         = std::max({result, std::abs(H - mean(X)) / scale, std::abs(K - gauss(X)) / (scale * scale)});
        }
    }
  return result;
}

/// Orders log2(error(n) / error(2 n)) from n = 4 on.
template <class Error>
std::vector<double> orders(const Error &error, int n_orders)
{
  std::vector<double> result;
  double              coarse = error(4);
  for (int k = 1; k <= n_orders; ++k)
    {
      const double fine = error(4 << k);
      result.push_back(std::log2(coarse / fine));
      coarse = fine;
    }
  return result;
}

double sphere_defect(const Point<3> &X)
{
  return X.norm() - 2.;
}
double cylinder_defect(const Point<3> &X)
{
  return std::hypot(X[1], X[2]) - 2.;
}
/// About the z axis, R = 3, r = 1.
double torus_defect(const Point<3> &X)
{
  return std::hypot(std::hypot(X[0], X[1]) - 3., X[2]) - 1.;
}
/// Waist 2, shape 3.
double hyperboloid_defect(const Point<3> &X)
{
  return (X[0] * X[0] + X[1] * X[1]) / 4. - X[2] * X[2] / 9. - 1.;
}

template <int degree>
void check_exact()
{
  CHECK(largest(shapes::cylinder<degree>(2., 3., {-.3, 2.7}, {2, 5}), cylinder_defect) < 1e-14);
  CHECK(largest(shapes::hemisphere_with_hole<degree>(2., M_PI / 10., {0., M_PI / 2.}, {3, 4}), sphere_defect) < 1e-14);
  CHECK(largest(shapes::torus<degree>(3., 1., {.2, 3.}, {-1.5, 1.5}, {3, 4}), torus_defect) < 1e-14);
  CHECK(largest(shapes::hyperboloid<degree>(2., 3., 8., {0., 2.}, {3, 4}), hyperboloid_defect) < 1e-14);
}

template <int degree>
void check_smooth_order()
{
  const auto of = [](const auto &make, const auto &defect) {
    CHECK(orders([&](int n) { return largest(make(n), defect); }, 2).back() > degree + 1 - .1);
  };
  const std::array<double, 2> turn{0., 2. * M_PI};
  of([&](int n) { return shapes::cylinder<degree>(2., 3., turn, {1, 3 * n}, Fit::smooth); }, cylinder_defect);
  of([&](int n) { return shapes::hemisphere_with_hole<degree>(2., .3, turn, {3 * n, n}, Fit::smooth); }, sphere_defect);
  of([&](int n) { return shapes::torus<degree>(3., 1., turn, turn, {3 * n, 3 * n}, Fit::smooth); }, torus_defect);
  of([&](int n) { return shapes::hyperboloid<degree>(2., 3., 8., turn, {3 * n, n}, Fit::smooth); }, hyperboloid_defect);
  // Its points at r = 1, half-way to the other rim and there: the inner rim counts.
  of(
      [&](int n) {
        return shapes::annular_plate<degree>(1., 3., turn, {1, 3 * n}, Fit::smooth);
      },
      [](const Point<3> &X) { return X.norm() < 1.3 ? X.norm() - 1. : 0.; });
}

} // namespace

TEST_CASE("Exact shapes have the exact radius at every degree")
{
  check_exact<2>();
  check_exact<3>();
  check_exact<4>();
}

TEST_CASE("Smooth shapes are polynomial and of order degree + 1")
{
  check_smooth_order<2>();
  check_smooth_order<3>();
  check_smooth_order<4>();
  CHECK((shapes::torus<3>(3., 1., {0., 6.}, {0., 6.}, {4, 5}, Fit::smooth).weights().array() == 1.).all());
  CHECK((shapes::sphere_patch<2>(3., {4, 5}, Fit::smooth).weights().array() == 1.).all());
}

TEST_CASE("Refined shapes stay exact and the same functions")
{
  auto       cylinder = shapes::cylinder<2>(2., 3., {-.3, 2.7}, {2, 3});
  const auto before   = cylinder;
  test::refine_at_random(cylinder, 3, 3, 11);
  CHECK(cylinder.n_elements() > 40);
  CHECK(largest(cylinder, cylinder_defect) < 1e-14);
  std::mt19937 random(4);
  for (int k = 0; k < 50; ++k)
    {
      const SurfacePlace place{0, 1. + test::symmetric(random), 1.5 * (1. + test::symmetric(random))};
      CHECK((position(cylinder, place) - position(before, place)).norm() < 1e-14);
    }
  auto sphere = shapes::sphere_patch<4>(2., {2, 2}, Fit::exact);
  test::refine_at_random(sphere, 2, 3, 12);
  CHECK(largest(sphere, sphere_defect) < 1e-14);
}

TEST_CASE("Areas agree with closed forms, to the order of the Gauss rule")
{
  const auto check = [](const auto &make, double exact) {
    const auto error = [&](int n) { return std::abs(area(make(n)) - exact) / exact; };
    // Three points in each direction have order 6, which long rational arcs reach from below.
    CHECK(orders(error, 1).front() > 5.4);
    CHECK(error(8) < 1e-6);
  };
  check([](int n) { return shapes::cylinder<2>(2., 3., {-.3, 2.7}, {1, n}); }, 2. * 3. * 3.);
  check([](int n) { return shapes::roof<2>(25., 50., 40. * M_PI / 180., {1, n}); }, 50. * 25. * 80. * M_PI / 180.);
  check([](int n) { return shapes::hemisphere_with_hole<2>(2., .3, {.5, 2.}, {n, n}); }, 4. * 1.5 * std::cos(.3));
  check([](int n) { return shapes::annular_plate<2>(1., 3., {0., 3.}, {n, n}); }, .5 * 3. * 8.);
  check(
      [](int n) {
        return shapes::torus<2>(3., 1., {.2, 2.7}, {-1., 1.5}, {n, n});
      },
      2.5 * (3. * 2.5 + std::sin(1.5) + std::sin(1.)));
  const double k = std::sqrt(13.) / 9.; // (waist^2 + shape^2)^(1/2) / shape^2
  check(
      [](int n) {
        return shapes::hyperboloid<2>(2., 3., 8., {0., 2.}, {n, n});
      },
      2. * 2. * (4. * std::hypot(1., 4. * k) + std::asinh(4. * k) / k));
  check([](int n) { return shapes::sphere_patch<4>(2., {n, n}, Fit::exact); }, 16. * M_PI / 6.);
}

TEST_CASE("Curvature of exact shapes with their normals outward")
{
  // Second derivatives on elements of a third to a sixth of the shape.
  const double tolerance = 1e-11;
  const auto   constant  = [](double value) { return [value](const Point<3> &) { return value; }; };
  CHECK(curvature_defect(shapes::sphere_patch<4>(2., {3, 2}, Fit::exact), .5, constant(-.5), constant(.25)) <
        tolerance);
  CHECK(curvature_defect(shapes::hemisphere_with_hole<2>(2., .2, {0., 3.}, {6, 3}), .5, constant(-.5), constant(.25)) <
        tolerance);
  CHECK(curvature_defect(shapes::cylinder<3>(2., 3., {-1., 2.}, {2, 5}), .5, constant(-.25), constant(0.)) < tolerance);
  CHECK(curvature_defect(shapes::annular_plate<2>(1., 3., {0., 3.}, {3, 5}), 1., constant(0.), constant(0.)) <
        tolerance);

  // cos b / (r (R + r cos b)) and -(R + 2 r cos b) / (2 r (R + r cos b)).
  CHECK(curvature_defect(
            shapes::torus<2>(3., 1., {.2, 3.}, {.3, 3.2}, {4, 4}), 1.,
            [](const Point<3> &X) {
              const double R = X.head<2>().norm();
              return -(3. + 2. * (R - 3.)) / (2. * R);
            },
            [](const Point<3> &X) {
              const double R = X.head<2>().norm();
              return (R - 3.) / R;
            }) < tolerance);

  // Of the level set r^2/4 - z^2/9: |grad|/2 = (r^2/16 + z^2/81)^(1/2) =: g; K = -1/(4 4 9 g^4).
  CHECK(curvature_defect(
            shapes::hyperboloid<2>(2., 3., 8., {0., 2.}, {4, 4}), 1.,
            [](const Point<3> &X) {
              const double r2 = X.head<2>().squaredNorm(), z2 = X[2] * X[2], g2 = r2 / 16. + z2 / 81.;
              // Divergence of the unit normal is -2 H.
              const double trace = 1. / 4. + 1. / 4. - 1. / 9.;
              const double along = (r2 / 16. / 4. - z2 / 81. / 9.) / g2;
              return -.5 * (trace - along) / std::sqrt(g2);
            },
            [](const Point<3> &X) {
              const double g2 = X.head<2>().squaredNorm() / 16. + X[2] * X[2] / 81.;
              return -1. / (144. * g2 * g2);
            }) < tolerance);
}

TEST_CASE("On a sphere the curvature is minus the metric over the radius")
{
  const auto sphere = shapes::sphere_patch<4>(2., {2, 2}, Fit::exact);
  const auto plane  = shapes::plate<2, 2>({1., 1.}, {1, 1});
  for (int e = 0; e < sphere.n_elements(); ++e)
    for (const auto &point : element_geometry(sphere, e).reference)
      CHECK((point.curvature + point.covariant / 2.).norm() < 1e-12);
  for (const auto &point : element_geometry(plane, 0).reference)
    CHECK(point.curvature == Voigt::Zero());
}

TEST_CASE("Curvature of smooth shapes converges with order degree - 1")
{
  const auto error = [](int n) {
    return curvature_defect(
        shapes::hemisphere_with_hole<3>(2., .3, {0., 2. * M_PI}, {4 * n, n}, Fit::smooth), .5,
        [](const Point<3> &) { return -.5; }, [](const Point<3> &) { return .25; });
  };
  CHECK(orders(error, 1).front() > 1.9);
}

TEST_CASE("The annular plate faces up, also in the plane")
{
  const auto plate = shapes::annular_plate<2, 2>(1., 3., {.1, 2.}, {2, 2});
  const auto at    = [&](double u, double v) { return position(plate, {0, u, v}); };
  const auto a1 = (at(1.1, 1.) - at(.9, 1.)).eval(), a2 = (at(1., 1.1) - at(1., .9)).eval();
  CHECK(a1[0] * a2[1] - a1[1] * a2[0] > 0.);
  CHECK(area(plate) == Approx(.5 * 1.9 * 8.).epsilon(1e-5));
}

TEST_CASE("The edges of curved shapes lie where their names say")
{
  const double tolerance = 1e-14;
  const auto   azimuth   = [](double angle) {
    return [angle](const Point<3> &X) { return X[0] * std::sin(angle) - X[1] * std::cos(angle); };
  };
  const auto height = [](double z) { return [z](const Point<3> &X) { return X[2] - z; }; };

  const auto cylinder = shapes::cylinder<2>(2., 3., {.1, 2.}, {2, 3});
  CHECK(largest_along(cylinder, "left", [](const Point<3> &X) { return X[0]; }) < tolerance);
  CHECK(largest_along(cylinder, "right", [](const Point<3> &X) { return X[0] - 3.; }) < tolerance);
  for (const auto &[name, angle] : {std::pair{"bottom", .1}, std::pair{"top", 2.}})
    {
      CHECK(largest_along(cylinder, name,
                          [&, angle = angle](const Point<3> &X) { return X[1] - 2. * std::sin(angle); }) < tolerance);
      CHECK(largest_along(cylinder, name,
                          [&, angle = angle](const Point<3> &X) { return X[2] - 2. * std::cos(angle); }) < tolerance);
    }

  const auto whole   = shapes::roof<3>(2., 6., .7, {2, 4});
  const auto quarter = shapes::roof<3>(2., 6., .7, {2, 4}, Fit::exact, shapes::Part::quarter);
  CHECK(largest(whole, cylinder_defect) < tolerance);
  CHECK(largest_along(whole, "bottom", [](const Point<3> &X) { return X[1] + 2. * std::sin(.7); }) < tolerance);
  CHECK(largest_along(whole, "top", [](const Point<3> &X) { return X[1] - 2. * std::sin(.7); }) < tolerance);
  CHECK(largest_along(whole, "right", [](const Point<3> &X) { return X[0] - 6.; }) < tolerance);
  CHECK(largest_along(quarter, "bottom", [](const Point<3> &X) { return X[1]; }) < tolerance);
  CHECK(largest_along(quarter, "top", [](const Point<3> &X) { return X[1] - 2. * std::sin(.7); }) < tolerance);
  CHECK(largest_along(quarter, "left", [](const Point<3> &X) { return X[0]; }) < tolerance);
  CHECK(largest_along(quarter, "right", [](const Point<3> &X) { return X[0] - 3.; }) < tolerance);
  CHECK(4. * area(quarter) == Approx(area(whole)).epsilon(1e-6));

  const auto hemisphere = shapes::hemisphere_with_hole<2>(2., .3, {.2, 1.5}, {2, 3});
  CHECK(largest_along(hemisphere, "equator", height(0.)) < tolerance);
  CHECK(largest_along(hemisphere, "hole", height(2. * std::cos(.3))) < tolerance);
  CHECK(largest_along(hemisphere, "left", azimuth(.2)) < tolerance);
  CHECK(largest_along(hemisphere, "right", azimuth(1.5)) < tolerance);

  const auto annulus = shapes::annular_plate<2>(1., 3., {.2, 1.5}, {2, 3});
  CHECK(largest_along(annulus, "inner", [](const Point<3> &X) { return X.norm() - 1.; }) < tolerance);
  CHECK(largest_along(annulus, "outer", [](const Point<3> &X) { return X.norm() - 3.; }) < tolerance);
  CHECK(largest_along(annulus, "begin", azimuth(.2)) < tolerance);
  CHECK(largest_along(annulus, "end", azimuth(1.5)) < tolerance);
  CHECK(largest(annulus, height(0.)) == 0.);

  const auto torus = shapes::torus<4>(3., 1., {.2, 1.5}, {.1, 2.}, {2, 3});
  CHECK(largest_along(torus, "bottom", height(std::sin(.1))) < tolerance);
  CHECK(largest_along(torus, "top", height(std::sin(2.))) < tolerance);
  CHECK(largest_along(torus, "left", azimuth(.2)) < tolerance);
  CHECK(largest_along(torus, "right", azimuth(1.5)) < tolerance);

  for (const Fit fit : {Fit::exact, Fit::smooth})
    {
      const auto hyperboloid = shapes::hyperboloid<2>(2., 3., 8., {.2, 1.5}, {2, 3}, fit);
      CHECK(largest_along(hyperboloid, "bottom", height(-4.)) < tolerance);
      CHECK(largest_along(hyperboloid, "top", height(4.)) < tolerance);
      CHECK(largest_along(hyperboloid, "left", azimuth(.2)) < tolerance);
      CHECK(largest_along(hyperboloid, "right", azimuth(1.5)) < tolerance);
    }
}

TEST_CASE("The two sides of the slit of a closed shape lie on each other")
{
  const std::array<double, 2> turn{0., 2. * M_PI};
  const auto                  check = [](const auto &surface, const std::string &one, const std::string &other) {
    const auto a = points_along(surface, surface.edge(one).front()),
               b = points_along(surface, surface.edge(other).front());
    REQUIRE(a.size() == b.size());
    const auto X = surface.control_points();
    for (std::size_t k = 0; k < a.size(); ++k)
      CHECK((X.row(a[k]) - X.row(b[k])).norm() < 1e-14);
  };
  check(shapes::cylinder<2>(2., 3., turn, {2, 12}, Fit::smooth), "bottom", "top");
  check(shapes::annular_plate<2>(1., 3., turn, {2, 12}, Fit::smooth), "begin", "end");
  const auto torus = shapes::torus<3>(3., 1., turn, turn, {12, 8}, Fit::smooth);
  check(torus, "left", "right");
  check(torus, "bottom", "top");
}

TEST_CASE("The speed of an exact arc varies by the factor that is promised")
{
  const double opening  = 3.;
  const auto   cylinder = shapes::cylinder<2>(1., 1., {0., opening}, {1, 1});
  const auto   speed    = [&](double v) {
    const double h = 1e-5;
    return (position(cylinder, {0, 0., v + h}) - position(cylinder, {0, 0., v - h})).norm() / (2. * h);
  };
  CHECK(speed(.5) / speed(1e-5) == Approx(1. / std::pow(std::cos(opening / 4.), 2)).epsilon(1e-3));
}

TEST_CASE("Curved shapes refuse what they cannot be, and say why")
{
  const double                nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 2> quarter{0., M_PI / 2.}, half{0., M_PI}, turn{-M_PI, M_PI};
  const auto                  says = [](const std::string &text) { return Catch::Contains(text); };

  CHECK_THROWS_AS(shapes::cylinder<2>(1., 1., half, {1, 1}), InvalidParameter);
  CHECK_THROWS_WITH(shapes::cylinder<2>(1., 1., half, {1, 1}),
                    says("cylinder: angles = {0, 3.14") && says("less than 180 degrees") && says("Fit::smooth"));
  CHECK_THROWS_WITH(shapes::torus<2>(3., 1., quarter, turn, {1, 1}, Fit::rational),
                    says("torus: tube_angles") && says("Fit::smooth"));
  CHECK_NOTHROW(shapes::cylinder<2>(1., 1., turn, {1, 6}, Fit::smooth));
  CHECK_NOTHROW(shapes::cylinder<2>(1., 1., {.1, .1 + 2. * M_PI}, {1, 6}, Fit::smooth));
  CHECK_THROWS_WITH(shapes::cylinder<2>(1., 1., {0., 6.3}, {1, 6}, Fit::smooth), says("6.3") && says("full turn"));
  CHECK_THROWS_WITH(shapes::cylinder<2>(1., 1., {1., 1.}, {1, 1}), says("{1, 1}") && says("begin < end"));
  CHECK_THROWS_WITH(shapes::cylinder<2>(1., 1., {nan, 1.}, {1, 1}), says("nan") && says("finite"));
  CHECK_THROWS_WITH(shapes::cylinder<2>(-2., 1., quarter, {1, 1}), says("cylinder: radius = -2"));
  CHECK_THROWS_WITH(shapes::cylinder<2>(2., 0., quarter, {1, 1}), says("cylinder: length = 0"));
  CHECK_THROWS_WITH(shapes::cylinder<2>(2., 1., quarter, {1, 0}), says("elements[1] = 0") && says("at least 1"));
  CHECK_THROWS_WITH(shapes::roof<2>(2., 1., 1.6, {1, 1}), says("half_angle = 1.6") && says("Fit::smooth"));
  CHECK_THROWS_WITH(shapes::hemisphere_with_hole<2>(2., 0., quarter, {1, 1}), says("hole_angle = 0"));
  CHECK_THROWS_WITH(shapes::hemisphere_with_hole<2>(2., 1.6, quarter, {1, 1}), says("less than pi/2"));
  CHECK_THROWS_WITH(shapes::annular_plate<2>(2., 1., quarter, {1, 1}), says("inner = 2, outer = 1"));
  CHECK_THROWS_WITH(shapes::torus<2>(1., 1., quarter, quarter, {1, 1}), says("tube_radius = 1"));
  CHECK_THROWS_WITH(shapes::hyperboloid<2>(1., nan, 1., quarter, {1, 1}), says("hyperboloid: shape = nan"));
  CHECK_THROWS_WITH(shapes::sphere_patch<3>(1., {1, 1}, Fit::exact), says("degree 3") && says("Fit::rational"));
}
