#include <catch2/catch.hpp>

#include <sherd/verify/derivative.h>

#include <cmath>
#include <limits>

using namespace sherd;
using verify::check_derivative;

TEST_CASE("derivative check: a right derivative has order 2 and a small defect")
{
  const auto check = check_derivative([](const double h) { return std::exp(1. + h); }, std::exp(1.));

  CHECK(check.order == Approx(2.).margin(.02));
  CHECK(check.smallest_defect < 1e-9);
  CHECK(check.passed());
}

TEST_CASE("derivative check: vectors and matrices")
{
  const Eigen::Vector2d slope(std::cos(.3), -std::sin(.3));
  const auto            curve = [](const double h) { return Eigen::Vector2d(std::sin(.3 + h), std::cos(.3 + h)); };
  CHECK(check_derivative(curve, slope).passed());

  Eigen::MatrixXd matrix(2, 3);
  matrix << 1., 2., 3., 4., 5., 6.;
  const auto path = [&](const double h) { return Eigen::MatrixXd(std::sin(1. + h) * matrix); };
  CHECK(check_derivative(path, Eigen::MatrixXd(std::cos(1.) * matrix)).passed());
}

TEST_CASE("derivative check: polynomials of degree 2 are exact")
{
  const auto check = check_derivative([](const double h) { return 3. + 2. * h - 5. * h * h; }, 2.);

  CHECK(std::isinf(check.order));
  CHECK(check.passed());
}

TEST_CASE("derivative check: a constant with derivative zero passes")
{
  CHECK(check_derivative([](const double) { return 4.; }, 0.).passed());
  CHECK(check_derivative([](const double) { return 0.; }, 0.).passed());
}

TEST_CASE("derivative check: a wrong derivative fails with order 0")
{
  for (const double error : {1e-1, 1e-3, -1e-5})
    {
      const auto check = check_derivative([](const double h) { return std::exp(h); }, 1. + error);

      CHECK(check.smallest_defect > .1 * std::abs(error));
      CHECK_FALSE(check.passed());
    }
  CHECK(check_derivative([](const double h) { return std::exp(h); }, 1.1).order == Approx(0.).margin(.01));
}

TEST_CASE("derivative check: one wrong entry of many fails")
{
  const auto path = [](const double h) { return Eigen::Vector3d(std::sin(h), 1e3 * std::cos(1. + h), std::exp(h)); };
  CHECK(check_derivative(path, Eigen::Vector3d(1., -1e3 * std::sin(1.), 1.)).passed());
  CHECK_FALSE(check_derivative(path, Eigen::Vector3d(1., -1e3 * std::sin(1.), 1.1)).passed());
}

TEST_CASE("derivative check: a kink at the point fails")
{
  CHECK_FALSE(check_derivative([](const double h) { return std::max(h, 0.); }, 0.).passed());
  CHECK_FALSE(check_derivative([](const double h) { return std::max(h, 0.); }, 1.).passed());
}

TEST_CASE("derivative check: NaN fails")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(check_derivative([&](const double h) { return h > 0. ? nan : 1.; }, 0.).passed());
  CHECK_FALSE(check_derivative([](const double h) { return h; }, nan).passed());
  CHECK_FALSE(
      check_derivative([&](const double h) { return Eigen::Vector2d(h, nan); }, Eigen::Vector2d(1., 0.)).passed());
}
