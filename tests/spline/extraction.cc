#include <catch2/catch.hpp>

#include <sherd/spline/extraction.h>

#include "spline_tools.h"

using namespace sherd;

TEMPLATE_TEST_CASE_SIG("Extraction: Bernstein form equals direct evaluation, columns sum to 1", "[spline][lr]",
                       ((int degree), degree), 2, 3, 4)
{
  std::mt19937    generator(21);
  LRBasis<degree> basis(test::open_knots(degree, {0., 1., 1.5, 3., 3., 4.}), test::integer_knots(degree, 4));
  for (int level = 0; level < 3; ++level)
    basis.refine(test::random_functions(basis, 0.08, generator), {{0.2, 0.2}});
  for (int k = 0; k < 6; ++k)
    basis.insert(std::array{test::random_line(basis, 2, generator)});

  for (int e = 0; e < basis.n_elements(); ++e)
    {
      const auto rows      = extraction(basis, e);
      const auto functions = basis.functions_of(e);
      REQUIRE(rows.rows() == static_cast<Eigen::Index>(functions.size()));
      for (int b = 0; b < n_bernstein<degree>; ++b)
        {
          double sum = 0.;
          for (Eigen::Index k = 0; k < rows.rows(); ++k)
            {
              REQUIRE(rows(k, b) >= 0.);
              sum += rows(k, b);
            }
          CHECK(std::abs(sum - 1.) < 4e-15); // sums of at most some dozens of positive terms
        }

      const auto point     = test::point_inside(basis.element(e), generator);
      const auto size      = basis.element(e).size();
      const auto bernstein = bernstein_2d<degree>((point[0] - basis.element(e).min[0]) / size[0],
                                                  (point[1] - basis.element(e).min[1]) / size[1]);
      const auto values    = evaluate(basis, e, point[0], point[1]);
      for (std::size_t k = 0; k < values.size(); ++k)
        {
          FunctionValue sum{};
          for (int b = 0; b < n_bernstein<degree>; ++b)
            {
              sum.value += rows(k, b) * bernstein.value[b];
              for (int d = 0; d < 2; ++d)
                sum.first[d] += rows(k, b) * bernstein.first[b][d] / size[d];
              for (int d = 0; d < 3; ++d)
                sum.second[d] += rows(k, b) * bernstein.second[b][d] / (size[d == 1] * size[d > 0]);
            }
          // Relative to degree / size for each derivative; the point itself is rounded by 1e-16 times its magnitude 4.
          const double tolerance = 2e-14, in_u = degree / size[0], in_v = degree / size[1];
          CHECK(std::abs(sum.value - values[k].value) < tolerance);
          CHECK(std::abs(sum.first[0] - values[k].first[0]) < tolerance * in_u);
          CHECK(std::abs(sum.first[1] - values[k].first[1]) < tolerance * in_v);
          CHECK(std::abs(sum.second[0] - values[k].second[0]) < tolerance * in_u * in_u);
          CHECK(std::abs(sum.second[1] - values[k].second[1]) < tolerance * in_v * in_v);
          CHECK(std::abs(sum.second[2] - values[k].second[2]) < tolerance * in_u * in_v);
        }
    }
}

TEST_CASE("Extraction: the operator of a uniform quadratic element", "[spline]")
{
  const LRBasis<2> basis(test::integer_knots(2, 3), test::integer_knots(2, 3));

  const auto rows = extraction(basis, basis.element_at(1.5, 1.5));

  // Univariate coefficients of the three quadratic B-splines of an inner element.
  const double e[3][3] = {{0.5, 0., 0.}, {0.5, 1., 0.5}, {0., 0., 0.5}};
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          CHECK(rows(3 * l + k, 3 * j + i) == e[k][i] * e[l][j]);
}
