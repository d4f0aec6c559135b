#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/spline/extraction.h>
#include <sherd/spline/independence.h>

#include "spline_tools.h"

using namespace sherd;

namespace
{

/// Rank of the Bernstein coefficients of all functions on all elements, by Gaussian elimination with full pivoting.
template <int degree>
int global_rank(const LRBasis<degree> &basis)
{
  constexpr int                    n_b = n_bernstein<degree>;
  std::vector<std::vector<double>> rows(basis.n_functions(), std::vector<double>(n_b * basis.n_elements(), 0.));
  for (int e = 0; e < basis.n_elements(); ++e)
    {
      const auto local     = extraction(basis, e);
      const auto functions = basis.functions_of(e);
      for (std::size_t k = 0; k < functions.size(); ++k)
        for (int b = 0; b < n_b; ++b)
          rows[functions[k]][n_b * e + b] = local(k, b);
    }
  const auto magnitude = [](double a, double b) { return std::abs(a) < std::abs(b); };
  for (std::size_t rank = 0; rank < rows.size(); ++rank)
    {
      std::size_t pivot = rank, column = 0;
      double      largest = -1.;
      for (std::size_t k = rank; k < rows.size(); ++k)
        {
          const auto entry = std::max_element(rows[k].begin(), rows[k].end(), magnitude);
          if (std::abs(*entry) > largest)
            {
              largest = std::abs(*entry);
              pivot   = k;
              column  = entry - rows[k].begin();
            }
        }
      if (largest < 1e-10) // rounding of entries up to 1
        return static_cast<int>(rank);
      std::swap(rows[rank], rows[pivot]);
      for (std::size_t k = rank + 1; k < rows.size(); ++k)
        if (const double factor = rows[k][column] / rows[rank][column]; factor != 0.)
          for (std::size_t c = 0; c < rows[k].size(); ++c)
            rows[k][c] -= factor * rows[rank][c];
    }
  return static_cast<int>(rows.size());
}

} // namespace

TEST_CASE("Independence: a tensor product has no overloaded element", "[spline][lr]")
{
  const LRBasis<3> basis(test::integer_knots(3, 4), test::integer_knots(3, 3));

  const auto result = check_independence(basis);

  CHECK(result.overloaded_elements.empty());
  CHECK(result.overloaded_functions.empty());
  CHECK(result.independent());
}

TEMPLATE_TEST_CASE_SIG("Independence: a known dependence of eight functions is found", "[spline][lr]",
                       ((int degree), degree), 2, 3)
{
  const std::vector<MeshLine> quadratic{{Direction::u, 3.5, 0., 3.},
                                        {Direction::v, 2.5, 2., 4.},
                                        {Direction::u, 3.25, 1., 3.},
                                        {Direction::u, 2.5, 1.25, 4.},
                                        {Direction::v, 1.25, 0., 3.5}};
  const std::vector<MeshLine> cubic{{Direction::v, 3.5, 1., 5.},   {Direction::u, 2.5, 2., 5.},
                                    {Direction::v, 3.125, 1., 4.}, {Direction::u, 3.5, 0., 3.75},
                                    {Direction::v, 3.75, 2., 5.},  {Direction::v, 3.625, 2., 5.}};
  const int                   n = degree + 2;
  LRBasis<degree>             basis(test::integer_knots(degree, n), test::integer_knots(degree, n));
  basis.insert(degree == 2 ? quadratic : cubic);

  const auto result = check_independence(basis);

  CHECK(global_rank(basis) == basis.n_functions() - 1);
  CHECK(!result.independent());
  CHECK(result.dependent.size() == 8);
  CHECK(std::includes(result.left_after_peeling.begin(), result.left_after_peeling.end(), result.dependent.begin(),
                      result.dependent.end()));
  CHECK(std::includes(result.overloaded_functions.begin(), result.overloaded_functions.end(),
                      result.left_after_peeling.begin(), result.left_after_peeling.end()));
}

TEST_CASE("Independence: agrees with the rank of all functions for random lines", "[spline][lr]")
{
  int n_undecided_by_peeling = 0;
  for (int seed = 0; seed < 12; ++seed)
    {
      CAPTURE(seed);
      std::mt19937 generator(seed);
      LRBasis<2>   basis(test::integer_knots(2, 4), test::integer_knots(2, 4));
      for (int k = 0; k < 12; ++k)
        basis.insert(std::array{test::random_line(basis, 2, generator)});

      const auto result = check_independence(basis);

      CHECK(result.independent() == (global_rank(basis) == basis.n_functions()));
      n_undecided_by_peeling += !result.left_after_peeling.empty();
    }
  CHECK(n_undecided_by_peeling > 0);
}
