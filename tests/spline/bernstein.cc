#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/spline/bernstein.h>

using namespace sherd;

namespace
{

/// binom(degree, i) t^i (1-t)^(degree-i), and its derivatives by the product rule.
double textbook(int degree, int i, double t, int order)
{
  const auto term = [&](int a, int b) { // derivative of order `order` of t^a (1-t)^b
    double sum = 0.;
    for (int k = 0; k <= order; ++k)
      {
        double factor = k % 2 ? -1. : 1.; // (1-t)^b differentiated k times, t^a differentiated order-k times
        for (int m = 0; m < k; ++m)
          factor *= b - m;
        for (int m = 0; m < order - k; ++m)
          factor *= a - m;
        if (factor != 0.)
          sum += (order == 2 && k == 1 ? 2. : 1.) * factor * std::pow(t, a - (order - k)) * std::pow(1. - t, b - k);
      }
    return sum;
  };
  double binomial = 1.;
  for (int k = 1; k <= i; ++k)
    binomial = binomial * (degree - i + k) / k;
  return binomial * term(i, degree - i);
}

} // namespace

TEMPLATE_TEST_CASE_SIG("Bernstein polynomials: agree with the binomial formula", "[spline]", ((int degree), degree), 1,
                       2, 3, 4)
{
  for (const double t : {0., 0.1, 0.5, 0.77, 1.})
    {
      const auto b = bernstein_1d<degree>(t);
      for (int i = 0; i <= degree; ++i)
        {
          // Rounding: a few units of sums whose terms are at most 4, 4 * 4 and 6 * 4 * 3.
          CHECK(std::abs(b.value[i] - textbook(degree, i, t, 0)) < 2e-15);
          CHECK(std::abs(b.first[i] - textbook(degree, i, t, 1)) < 8e-15);
          CHECK(std::abs(b.second[i] - textbook(degree, i, t, 2)) < 3e-14);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("BernsteinTable: products at the Gauss points, first coordinate fastest", "[spline]",
                       ((int degree), degree), 2, 3, 4)
{
  const auto &table = BernsteinTable<degree>::get();
  const auto &rule  = gauss_legendre(degree + 1);

  double weight = 0.;
  for (int j = 0, q = 0; j <= degree; ++j)
    for (int i = 0; i <= degree; ++i, ++q)
      {
        weight += table.weights[q];
        CHECK(table.points[q] == std::array{rule.points[i], rule.points[j]});
        const auto s = bernstein_1d<degree>(rule.points[i]), t = bernstein_1d<degree>(rule.points[j]);
        for (int l = 0, b = 0; l <= degree; ++l)
          for (int k = 0; k <= degree; ++k, ++b)
            {
              // The table is made by the compiler, which rounds each product; the processor may fuse some.
              CHECK(std::abs(table.value[q][b] - s.value[k] * t.value[l]) < 1e-15);
              CHECK(std::abs(table.first[q][b][0] - s.first[k] * t.value[l]) < 8e-15);
              CHECK(std::abs(table.first[q][b][1] - s.value[k] * t.first[l]) < 8e-15);
              CHECK(std::abs(table.second[q][b][0] - s.second[k] * t.value[l]) < 3e-14);
              CHECK(std::abs(table.second[q][b][1] - s.value[k] * t.second[l]) < 3e-14);
              CHECK(std::abs(table.second[q][b][2] - s.first[k] * t.first[l]) < 3e-14);
            }
      }
  CHECK(weight == Approx(1.).epsilon(1e-15));
}

TEMPLATE_TEST_CASE_SIG("BernsteinTable: each polynomial integrates to 1/(degree+1)^2", "[spline]",
                       ((int degree), degree), 2, 3, 4)
{
  const auto &table = BernsteinTable<degree>::get();

  for (int b = 0; b < n_bernstein<degree>; ++b)
    {
      double sum = 0.;
      for (int q = 0; q < n_bernstein<degree>; ++q)
        sum += table.weights[q] * table.value[q][b];
      CHECK(sum == Approx(1. / n_bernstein<degree>).epsilon(1e-15)); // the rule is exact: rounding only
    }
}
