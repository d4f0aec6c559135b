// label: unit
#include <catch2/catch.hpp>

#include <geometry/area.h>
#include <geometry/sample_surfaces.h>
#include <sherd/geometry/element_geometry.h>

using namespace sherd;
using sherd::test::area;

namespace
{

/// Position and its first and second derivatives (11, 22, 12) at a quadrature point, from the Bernstein form.
template <int spacedim>
struct Jet
{
  Point<spacedim> X = Point<spacedim>::Zero(), d1 = X, d2 = X, d11 = X, d22 = X, d12 = X;
};

template <int degree, int spacedim>
Jet<spacedim> jet(const ElementGeometry<degree, spacedim> &g, int q)
{
  std::optional<ShapeValues<degree>> storage;
  const auto                        &s = g.shapes(storage);
  Jet<spacedim>                      j;
  for (int b = 0; b < g.n_b; ++b)
    {
      const Point<spacedim> P = g.bezier_points.col(b);
      j.X += s.value[q][b] * P;
      j.d1 += s.d1[q][b] * P;
      j.d2 += s.d2[q][b] * P;
      j.d11 += s.d11[q][b] * P;
      j.d22 += s.d22[q][b] * P;
      j.d12 += s.d12[q][b] * P;
    }
  return j;
}

/// A^ab (f,ab - Gamma^c_ab f,c) as the element has it.
double laplacian(const ReferenceQuadraturePoint &r, double f1, double f2, double f11, double f22, double f12)
{
  const auto &A = r.contravariant;
  return A[0] * f11 + A[1] * f22 + 2. * A[2] * f12 - r.laplace_1 * f1 - r.laplace_2 * f2;
}

/// Largest |lap f - expected| of f(X) = x^3 - 3 x y^2 (harmonic) and x^2 + 3 y^2 (lap = 8) on a plane surface, by the
/// chain rule.
template <int degree>
double laplacian_defect(const Surface<degree, 2> &surface)
{
  double largest = 0.;
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto g = element_geometry(surface, e);
      for (int q = 0; q < g.n_q; ++q)
        {
          const auto   j = jet(g, q);
          const double x = j.X[0], y = j.X[1];
          const auto   of = [&](const Point<2> &gradient, const Eigen::Matrix2d &hessian) {
            return laplacian(
                  g.reference[q], gradient.dot(j.d1), gradient.dot(j.d2), j.d1.dot(hessian * j.d1) + gradient.dot(j.d11),
                  j.d2.dot(hessian * j.d2) + gradient.dot(j.d22), j.d1.dot(hessian * j.d2) + gradient.dot(j.d12));
          };
          Eigen::Matrix2d harmonic, quadratic;
          harmonic << 6. * x, -6. * y, -6. * y, -6. * x;
          quadratic << 2., 0., 0., 6.;
          largest = std::max(largest, std::abs(of({3. * x * x - 3. * y * y, -6. * x * y}, harmonic)));
          largest = std::max(largest, std::abs(of({2. * x, 6. * y}, quadratic) - 8.));
        }
    }
  return largest;
}

} // namespace

TEST_CASE("Quadrature points, extraction and shape functions agree with the spline itself")
{
  // Position at the Gauss points of every element, on LR elements of many functions and on rational ones.
  const auto check = [](const auto &surface) {
    const auto &basis   = surface.patch(0).basis;
    const auto &gauss   = BernsteinTable<2>::get().points;
    double      largest = 0.;
    for (int e = 0; e < surface.n_elements(); ++e)
      {
        const auto  g   = element_geometry(surface, e);
        const auto &box = basis.element(e);
        CHECK(g.points.size() == basis.functions_of(e).size());
        for (int q = 0; q < g.n_q; ++q)
          largest = std::max(
              largest, (g.position(q) - test::position_at(surface.patch(0), box.min[0] + gauss[q][0] * box.size()[0],
                                                          box.min[1] + gauss[q][1] * box.size()[1]))
                           .norm());
      }
    CHECK(largest < 1e-14);
  };
  auto plate = test::distorted(shapes::plate<2, 2>({1., 1.}, {4, 4}), .05);
  test::refine_at_random(plate, 2, 3, 73);
  check(plate);
  auto annulus = test::quarter_annulus<2, 2>(1., 2.);
  test::refine_everywhere(annulus, 1);
  test::refine_at_random(annulus, 3, 2, 5);
  check(annulus);
}

TEST_CASE("Metric of a quarter annulus")
{
  auto surface = test::quarter_annulus<2, 2>(1., 3.);
  test::refine_everywhere(surface, 1);
  const auto  &gauss = BernsteinTable<2>::get();
  const double h = .5, s2 = std::sqrt(2.);
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto g = element_geometry(surface, e);
      REQUIRE(g.denominator);
      const auto &box = surface.patch(0).basis.element(e);
      for (int q = 0; q < g.n_q; ++q)
        {
          // The radius is linear in u; the angle of the arc follows from tan = Y / X with its numerators X, Y.
          const double u = box.min[0] + h * gauss.points[q][0], v = box.min[1] + h * gauss.points[q][1];
          const double r = 1. + 2. * u;
          const double X = (1. - v) * (1. - v) + s2 * v * (1. - v), Y = v * v + s2 * v * (1. - v);
          const double dX = -2. * (1. - v) + s2 * (1. - 2. * v), dY = 2. * v + s2 * (1. - 2. * v);
          const double turning = (X * dY - Y * dX) / (X * X + Y * Y);

          CHECK(g.position(q).norm() == Approx(r).epsilon(1e-14));
          const auto &point = g.reference[q];
          CHECK(point.covariant[0] == Approx(4. * h * h).epsilon(1e-13));
          CHECK(point.covariant[1] == Approx(std::pow(r * turning * h, 2)).epsilon(1e-13));
          CHECK(std::abs(point.covariant[2]) < 1e-14);
          CHECK(point.dA == Approx(gauss.weights[q] * 2. * h * r * turning * h).epsilon(1e-13));
          CHECK(point.contravariant[0] * point.covariant[0] == Approx(1.).epsilon(1e-14));
          CHECK(point.contravariant[1] * point.covariant[1] == Approx(1.).epsilon(1e-14));
        }
    }
}

TEST_CASE("The area of a quarter annulus converges with the order of the Gauss rule")
{
  auto         surface = test::quarter_annulus<2, 2>(1., 2.);
  const double exact   = M_PI / 4. * 3.;
  const double coarse  = std::abs(area(surface) - exact);
  test::refine_everywhere(surface, 1);
  const double medium = std::abs(area(surface) - exact);
  test::refine_everywhere(surface, 2);
  const double fine = std::abs(area(surface) - exact);
  // Three points integrate with order 6; the rational arc is smooth.
  CHECK(std::log2(coarse / medium) > 5.);
  CHECK(std::log2(medium / fine) > 5.5);
  CHECK(fine < 1e-7); // what four elements along the arc reach
}

TEST_CASE("The Laplacian is that of the plane on curved and rational parametrisations")
{
  // Second derivatives on elements of size 1/4 to 1/8: rounding grows by 1/size^2.
  auto plate = test::distorted(shapes::plate<2, 2>({1., 1.}, {4, 4}), .05);
  test::refine_at_random(plate, 1, 3, 2);
  CHECK(laplacian_defect(plate) < 1e-10);
  CHECK(laplacian_defect(test::distorted(shapes::plate<3, 2>({1., 1.}, {2, 3}), .05)) < 1e-10);
  auto annulus = test::quarter_annulus<2, 2>(1., 2.);
  CHECK(laplacian_defect(annulus) < 1e-11);
  test::refine_at_random(annulus, 2, 2, 5);
  CHECK(laplacian_defect(annulus) < 1e-10);
  CHECK(laplacian_defect(test::quarter_annulus<3, 2>(1., 2.)) < 1e-11);
}

TEST_CASE("The Laplacian of the position is the curvature vector of a cylinder")
{
  // lap X = 2 H n, and on a cylinder of radius R this is -e_r / R.
  const double R       = 1.7;
  auto         surface = test::quarter_turn<2, 3>(R, 0., R, 2.);
  test::refine_everywhere(surface, 1);
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto g = element_geometry(surface, e);
      for (int q = 0; q < g.n_q; ++q)
        {
          const auto      j = jet(g, q);
          Eigen::Vector3d lap;
          for (int d = 0; d < 3; ++d)
            lap[d] = laplacian(g.reference[q], j.d1[d], j.d2[d], j.d11[d], j.d22[d], j.d12[d]);
          CHECK((lap + Eigen::Vector3d(j.X[0], j.X[1], 0.) / (R * R)).norm() < 1e-12);
        }
    }
}

TEST_CASE("The shortest edge is an arc length")
{
  CHECK(shortest_edge(element_geometry(shapes::plate<2, 2>({4., 1.}, {4, 4}), 0)) == Approx(.25).epsilon(1e-14));

  // Straight with a speed that varies along it: still exact.
  const auto knots = shapes::uniform_knots<3>(1);
  const auto graded =
      interpolate<3, 2>(knots, knots, [](double u, double v) { return Point<2>(.3 * u * (1. + u), .6 * v); });
  CHECK(shortest_edge(element_geometry(graded, 0)) == Approx(.6).epsilon(1e-14));

  // The inner arc of an annulus, with the order of the Gauss rule; its halves are equal by symmetry.
  auto   annulus = test::quarter_annulus<2, 2>(1., 9.);
  double error[3];
  for (int level = 0; level < 3; ++level)
    {
      error[level] = std::abs(shortest_edge(element_geometry(annulus, 0)) / std::ldexp(M_PI / 2., -level) - 1.);
      test::refine_everywhere(annulus, level + 1);
    }
  CHECK(error[0] < 1e-3);
  CHECK(std::log2(error[0] / error[1]) > 5.);
}

TEST_CASE("A degenerate element is refused by its number")
{
  const auto plate = shapes::plate<2, 2>({2., 1.}, {2, 1});
  auto       patch = plate.patch(0);
  for (int i = 0; i < patch.control_points.rows(); ++i)
    if (patch.control_points(i, 0) > .4) // the right element collapses to a line, the left one does not
      patch.control_points(i, 0) = .4;
  const Surface<2, 2> collapsed({patch}, {});
  CHECK_NOTHROW(element_geometry(collapsed, 0));
  CHECK_THROWS_AS(element_geometry(collapsed, 1), InvalidParameter);
  CHECK_THROWS_WITH(element_geometry(collapsed, 1), Catch::Contains("element 1 is degenerate"));
}
