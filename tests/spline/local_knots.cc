#include <catch2/catch.hpp>

#include <sherd/spline/bernstein.h>
#include <sherd/spline/local_knots.h>

#include "spline_tools.h"

using namespace sherd;

namespace
{

/// Ascending knots in [0, 1] with some repetitions, not all equal.
template <int degree>
LocalKnots<degree> random_knots(std::mt19937 &generator)
{
  LocalKnots<degree> knots;
  for (auto &knot : knots)
    knot = 0.125 * test::uniform_int(generator, 9);
  knots.front() = 0.;
  knots.back()  = 1.;
  std::sort(knots.begin(), knots.end());
  return knots;
}

} // namespace

TEMPLATE_TEST_CASE_SIG("Local knots: value and derivatives agree with the textbook recurrence", "[spline]",
                       ((int degree), degree), 2, 3, 4)
{
  std::mt19937 generator(11);

  for (int trial = 0; trial < 200; ++trial)
    {
      const auto   knots = random_knots<degree>(generator);
      const double x     = test::uniform(generator);
      const int    m     = span_index<degree>(knots, x);
      REQUIRE(m >= 0);
      const auto value = evaluate_piece<degree>(knots, m, x);
      // Derivatives scale with 1/h = 8 for the shortest span, by a factor degree each.
      CHECK(std::abs(value.value - test::cox_de_boor(knots.data(), degree, x)) < 1e-14);
      CHECK(std::abs(value.first - test::cox_de_boor_derivative(knots.data(), degree, x, 1)) < 1e-14 * 8 * degree);
      CHECK(std::abs(value.second - test::cox_de_boor_derivative(knots.data(), degree, x, 2)) <
            1e-14 * 64 * degree * degree);
    }
}

TEMPLATE_TEST_CASE_SIG("Local knots: a span is half-open and outside there is none", "[spline]", ((int degree), degree),
                       2, 3, 4)
{
  LocalKnots<degree> knots;
  for (int k = 0; k < degree + 2; ++k)
    knots[k] = k < 2 ? 0. : k;

  CHECK(span_index<degree>(knots, 0.) == 1);
  CHECK(span_index<degree>(knots, 2.) == 2);
  CHECK(span_index<degree>(knots, -1e-300) == -1);
  CHECK(span_index<degree>(knots, knots.back()) == -1);
}

TEMPLATE_TEST_CASE_SIG("Local knots: Bernstein coefficients reproduce the piece on a part of a span", "[spline]",
                       ((int degree), degree), 2, 3, 4)
{
  std::mt19937 generator(12);

  for (int trial = 0; trial < 200; ++trial)
    {
      const auto knots = random_knots<degree>(generator);
      for (int m = 0; m <= degree; ++m)
        if (knots[m] < knots[m + 1])
          {
            const double length = knots[m + 1] - knots[m];
            const double a = knots[m] + 0.25 * length, b = knots[m] + 0.75 * length;
            const auto   coefficients = bernstein_coefficients<degree>(knots, a, b);
            for (const double t : {0., 0.3, 1.})
              {
                const auto bernstein = bernstein_1d<degree>(t);
                double     sum       = 0.;
                for (int j = 0; j <= degree; ++j)
                  sum += coefficients[j] * bernstein.value[j];
                CHECK(std::abs(sum - evaluate_piece<degree>(knots, m, a + t * (b - a)).value) < 2e-15);
              }
          }
      CHECK(bernstein_coefficients<degree>(knots, 1., 2.) == std::array<double, degree + 1>{});
    }
}

TEMPLATE_TEST_CASE_SIG("Knot insertion: the parts add up to the function", "[spline]", ((int degree), degree), 2, 3, 4)
{
  std::mt19937  generator(13);
  KnotInsertion parts;

  for (int trial = 0; trial < 200; ++trial)
    {
      const auto          knots = random_knots<degree>(generator);
      std::vector<double> inserted;
      for (int k = test::uniform_int(generator, 5); k >= 0; --k)
        {
          const double x = 0.0625 * (1 + test::uniform_int(generator, 15));
          const auto   n_present =
              std::count(knots.begin(), knots.end(), x) + std::count(inserted.begin(), inserted.end(), x);
          if (n_present <= degree)
            inserted.push_back(x);
        }
      insert_knots<degree>(knots, inserted, parts);
      REQUIRE(parts.knots.size() == knots.size() + inserted.size());
      REQUIRE(parts.weights.size() == inserted.size() + 1);
      CHECK(std::is_sorted(parts.knots.begin(), parts.knots.end()));
      const double x   = test::uniform(generator);
      double       sum = 0.;
      for (std::size_t k = 0; k < parts.weights.size(); ++k)
        {
          CHECK(parts.weights[k] >= 0.);
          sum += parts.weights[k] * test::cox_de_boor(parts.knots.data() + k, degree, x);
        }
      CHECK(std::abs(sum - test::cox_de_boor(knots.data(), degree, x)) < 2e-15);
    }
}

TEST_CASE("Knot insertion: one knot gives the two parts of theory H.2", "[spline]")
{
  KnotInsertion parts;

  insert_knots<2>({0., 1., 2., 4.}, std::array{1.5}, parts);

  CHECK(parts.knots == std::vector{0., 1., 1.5, 2., 4.});
  CHECK(parts.weights[0] == 1.5 / 2.);
  CHECK(parts.weights[1] == 2.5 / 3.);
}
