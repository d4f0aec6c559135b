#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/spline/quadrature.h>

using namespace sherd;

TEST_CASE("GaussRule: exact up to degree 2n-1 and not beyond", "[spline]")
{
  const int n = GENERATE(range(1, GaussRule::max_points + 1));
  CAPTURE(n);

  const auto &rule  = gauss_legendre(n);
  const auto  error = [&](int power) {
    double sum = 0.;
    for (int q = 0; q < rule.n_points; ++q)
      sum += rule.weights[q] * std::pow(rule.points[q], power);
    return std::abs(sum - 1. / (power + 1));
  };

  CHECK(rule.n_points == n);
  for (int power = 0; power < 2 * n; ++power)
    CHECK(error(power) < 4e-16); // rounding of a sum of positive terms that is at most 1
  // The error term is (n!)^4 / ((2n+1) ((2n)!)^2), above rounding for all n here.
  CHECK(error(2 * n) > 1e-13);
}

TEST_CASE("GaussRule: points ascend and are symmetric", "[spline]")
{
  const int   n    = GENERATE(range(1, GaussRule::max_points + 1));
  const auto &rule = gauss_legendre(n);

  for (int q = 0; q < n; ++q)
    {
      CHECK(rule.points[q] + rule.points[n - 1 - q] == Approx(1.).epsilon(4e-16));
      CHECK(rule.weights[q] == Approx(rule.weights[n - 1 - q]).epsilon(4e-16));
      if (q > 0)
        CHECK(rule.points[q - 1] < rule.points[q]);
    }
  CHECK(gauss_legendre(2).points[0] == Approx(0.5 - std::sqrt(3.) / 6.).epsilon(4e-16));
}

TEST_CASE("GaussRule: refuses numbers of points it does not have", "[spline]")
{
  CHECK_THROWS_AS(gauss_legendre(0), InvalidParameter);
  CHECK_THROWS_AS(gauss_legendre(GaussRule::max_points + 1), InvalidParameter);
}
