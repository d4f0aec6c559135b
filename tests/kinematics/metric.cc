#include <catch2/catch.hpp>

#include <sherd/kinematics/metric.h>
#include <sherd/kinematics/orthonormal_frame.h>
#include <sherd/verify/derivative.h>

#include <cmath>

using namespace sherd;

namespace
{
const Point<3> a1_in_space(1.2, .3, -.4), a2_in_space(-.2, .9, .5);
const Point<2> a1_in_plane(1.2, .3), a2_in_plane(-.2, .9);

Eigen::Matrix2d matrix(const Voigt &T)
{
  return Eigen::Matrix2d{{T[0], T[2]}, {T[2], T[1]}};
}
} // namespace

TEST_CASE("metric: holds the scalar products of the tangents")
{
  const Metric m = metric(a1_in_space, a2_in_space);

  CHECK(m.covariant[0] == Approx(1.2 * 1.2 + .3 * .3 + .4 * .4).epsilon(1e-15));
  CHECK(m.covariant[1] == Approx(.2 * .2 + .9 * .9 + .5 * .5).epsilon(1e-15));
  CHECK(m.covariant[2] == Approx(-1.2 * .2 + .3 * .9 - .4 * .5).epsilon(1e-15));
}

TEST_CASE("metric: contravariant components are the inverse, determinant is that of the covariant ones")
{
  for (const Metric &m :
       {metric(a1_in_space, a2_in_space), metric(a1_in_plane, a2_in_plane), metric(Voigt(2., 3., -1.))})
    {
      CHECK((matrix(m.covariant) * matrix(m.contravariant) - Eigen::Matrix2d::Identity()).norm() < 1e-15);
      CHECK(m.determinant == Approx(matrix(m.covariant).determinant()).epsilon(1e-14));
    }
}

TEST_CASE("metric: a surface in the plane z = 0 and the plane itself agree")
{
  const Metric plane = metric(a1_in_plane, a2_in_plane);
  const Metric space = metric(Point<3>(1.2, .3, 0.), Point<3>(-.2, .9, 0.));

  CHECK((plane.covariant - space.covariant).norm() < 1e-15);
  CHECK((plane.contravariant - space.contravariant).norm() < 1e-15);
  CHECK(plane.determinant == Approx(space.determinant).epsilon(1e-15));
}

TEST_CASE("metric: determinant of nearly parallel tangents keeps its digits")
{
  // a_1 x a_2 = 1e-9 exactly in the arithmetic of the cross product; a_11 a_22 - a_12^2 would give 0.
  const Metric m = metric(Point<2>(1., 0.), Point<2>(1., 1e-9));

  CHECK(m.determinant == Approx(1e-18).epsilon(1e-14));
}

TEST_CASE("metric: derivative of the inverse")
{
  const Voigt a(2., 3., -1.), path(.3, -.7, .4);

  const auto check = verify::check_derivative([&](const double h) { return metric(Voigt(a + h * path)).contravariant; },
                                              Voigt(inverse_derivative(metric(a)) * voigt_weight.cwiseProduct(path)));

  INFO("order " << check.order << ", defect " << check.smallest_defect);
  CHECK(check.passed());
  CHECK(inverse_derivative(metric(a)).isApprox(inverse_derivative(metric(a)).transpose(), 1e-15));
}

TEST_CASE("orthonormal frame: the metric itself becomes the identity")
{
  const Metric           m = metric(a1_in_space, a2_in_space);
  const OrthonormalFrame frame(m);

  CHECK((frame.pull(m.covariant) - Voigt(1., 1., 0.)).norm() < 1e-15);
  CHECK((frame.push(Voigt(1., 1., 0.)) - m.contravariant).norm() < 1e-15);
}

TEST_CASE("orthonormal frame: pull and push are adjoint and keep invariants")
{
  const Metric           m = metric(a1_in_space, a2_in_space);
  const OrthonormalFrame frame(m);
  const Voigt            E(.3, -.2, .5), S(1., 2., -.7);

  CHECK(contract(frame.pull(E), S) == Approx(contract(E, frame.push(S))).epsilon(1e-14));
  const Eigen::Matrix2d mixed = matrix(m.contravariant) * matrix(E), cartesian = matrix(frame.pull(E));
  CHECK(cartesian.trace() == Approx(mixed.trace()).epsilon(1e-14));
  CHECK(cartesian.determinant() == Approx(mixed.determinant()).epsilon(1e-14));
}
