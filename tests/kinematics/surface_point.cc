#include <catch2/catch.hpp>

#include <sherd/kinematics/surface_point.h>
#include <sherd/verify/random_state.h>

#include <cmath>

using namespace sherd;

namespace
{
const Eigen::Matrix2d tangents{{1.2, -.2}, {.3, .9}}; // columns A_1, A_2

SurfacePoint<2> deformed(const Eigen::Matrix2d &F)
{
  const Eigen::Matrix2d a = F * tangents;
  return {ReferencePoint<2>(metric<2>(tangents.col(0), tangents.col(1))), metric<2>(a.col(0), a.col(1))};
}

Eigen::Matrix2d rotation(const double angle)
{
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}
} // namespace

TEST_CASE("surface point: invariants are those of the deformation gradient")
{
  const Eigen::Matrix2d F{{1.3, .2}, {-.1, .8}};
  const Eigen::Matrix2d C = F.transpose() * F;

  const auto point = deformed(F);

  CHECK(point.J == Approx(F.determinant()).epsilon(1e-14));
  CHECK(point.J_minus_1 == Approx(F.determinant() - 1.).epsilon(1e-13));
  CHECK(point.I1 == Approx(C.trace()).epsilon(1e-14));
  CHECK(point.deviator_squared == Approx(C.trace() * C.trace() / 4 - C.determinant()).epsilon(1e-13));
}

TEST_CASE("surface point: the deviator is A^ac a_cd A^db less its trace")
{
  verify::RandomNumbers random(3);
  for (int n = 0; n < 20; ++n)
    {
      const auto state = verify::random_state(random, n % 2 ? 1.3 : .7);
      const auto point = state.point();

      const Voigt          &A = point.reference.metric.contravariant, &a = point.metric.covariant;
      const Eigen::Matrix2d A2{{A[0], A[2]}, {A[2], A[1]}}, a2{{a[0], a[2]}, {a[2], a[1]}};
      const Eigen::Matrix2d D = A2 * a2 * A2 - .5 * point.I1 * A2;
      CHECK((point.deviator - Voigt(D(0, 0), D(1, 1), D(0, 1))).norm() < 1e-13 * A.norm());
      CHECK(std::abs(contract(point.deviator, point.reference.metric.covariant)) < 1e-13);
    }
}

TEST_CASE("surface point: a rigid motion is no strain")
{
  for (const double angle : {.1, 1., 2., 3.})
    {
      const auto point = deformed(rotation(angle));

      CHECK(std::abs(point.J_minus_1) < 1e-15);
      CHECK(std::abs(point.I1 - 2.) < 2e-15);
      CHECK(point.deviator.norm() < 2e-15);
    }
}

TEST_CASE("surface point: the undeformed point has exactly zero strain")
{
  const auto point = deformed(Eigen::Matrix2d::Identity());

  CHECK(point.J == 1.);
  CHECK(point.J_minus_1 == 0.);
  CHECK(point.deviator_squared == 0.);
}

TEST_CASE("surface point: small strains keep their relative accuracy")
{
  // Metrics that are exact in binary: A = diag(1, 4), a = diag(1 + 2x, 4 + 8y). Strains from differences are then
  // exact, while J^2 - 1 from determinants would be wrong by 1e-16 / x.
  for (const double x : {std::ldexp(1., -20), std::ldexp(1., -40), std::ldexp(1., -50)})
    {
      const double              y = -.25 * x;
      const verify::MetricState state{Voigt(1., 4., 0.), Voigt(1. + 2. * x, 4. + 8. * y, 0.)};

      const auto point = state.point();

      const long double J         = std::sqrt((1.L + 2.L * x) * (1.L + 2.L * y));
      const long double J_minus_1 = (2.L * x + 2.L * y + 4.L * x * y) / (1.L + J);
      CHECK(std::abs(point.J_minus_1 / static_cast<double>(J_minus_1) - 1.) < 1e-15);
      CHECK(std::abs(point.deviator_squared / ((x - y) * (x - y)) - 1.) < 1e-15);
    }
}
