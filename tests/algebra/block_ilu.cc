// label: unit
#include <algorithm>
#include <random>
#include <set>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <omp.h>

#include <sherd/algebra/block_ilu.h>
#include <sherd/base/exceptions.h>

using namespace sherd;

namespace
{

using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Random values on a graph of blocks, strong on the diagonal, in the layout of Matrix::values().
std::vector<double> random_values(const SparseGraph &graph, int block_size)
{
  std::mt19937                           engine(7);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::vector<double>                    values;
  for (int i = 0; i < graph.n_rows(); ++i)
    for (int c = 0; c < block_size; ++c)
      for (const int j : graph.row(i))
        for (int d = 0; d < block_size; ++d)
          values.push_back(uniform(engine) + (i == j && c == d ? 2. * block_size * graph.row(i).size() : 0.));
  return values;
}

Dense dense(const SparseGraph &graph, int block_size, const std::vector<double> &values)
{
  Dense       result = Dense::Zero(graph.n_rows() * block_size, graph.n_rows() * block_size);
  std::size_t place  = 0;
  for (int i = 0; i < graph.n_rows(); ++i)
    for (int c = 0; c < block_size; ++c)
      for (const int j : graph.row(i))
        for (int d = 0; d < block_size; ++d, ++place)
          if (j < graph.n_rows())
            result(i * block_size + c, j * block_size + d) = values[place];
  return result;
}

SparseGraph tridiagonal(int n)
{
  SparseGraph graph;
  for (int i = 0; i < n; ++i)
    {
      for (int j = std::max(0, i - 1); j <= std::min(n - 1, i + 1); ++j)
        graph.columns.push_back(j);
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
    }
  return graph;
}

SparseGraph complete_graph(int n)
{
  SparseGraph graph;
  for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
        graph.columns.push_back(j);
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
    }
  return graph;
}

/// The graph with row i standing for row order[i].
SparseGraph permuted(const SparseGraph &graph, std::span<const int> order)
{
  std::vector<int> positions(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    positions[order[i]] = static_cast<int>(i);
  SparseGraph result;
  for (const int row : order)
    {
      std::set<int> columns;
      for (const int j : graph.row(row))
        columns.insert(positions[j]);
      result.columns.insert(result.columns.end(), columns.begin(), columns.end());
      result.offsets.push_back(static_cast<int>(result.columns.size()));
    }
  return result;
}

/// Symmetric graph with the diagonal and about @p n_edges random edges.
SparseGraph random_graph(int n, int n_edges)
{
  std::mt19937                       engine(3);
  std::uniform_int_distribution<int> uniform(0, n - 1);
  std::vector<std::set<int>>         rows(n);
  for (int i = 0; i < n; ++i)
    rows[i].insert(i);
  for (int k = 0; k < n_edges; ++k)
    {
      const int i = uniform(engine), j = uniform(engine);
      rows[i].insert(j);
      rows[j].insert(i);
    }
  SparseGraph graph;
  for (const auto &row : rows)
    {
      graph.columns.insert(graph.columns.end(), row.begin(), row.end());
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
    }
  return graph;
}

/// The product L U of the factors, by solving for the columns of its inverse.
Dense product(BlockIlu &factors)
{
  const int n       = factors.n_rows() * factors.block_size();
  Dense     inverse = Dense::Identity(n, n); // rows hold the columns of the inverse
  for (int i = 0; i < n; ++i)
    factors.solve({inverse.row(i).data(), static_cast<std::size_t>(n)});
  return inverse.transpose().inverse();
}

/// Levels of fill by their definition, block by block; large where there is no fill at all.
Eigen::MatrixXi levels_by_definition(const SparseGraph &graph)
{
  const int       n      = graph.n_rows();
  Eigen::MatrixXi levels = Eigen::MatrixXi::Constant(n, n, 1000);
  for (int i = 0; i < n; ++i)
    {
      levels(i, i) = 0;
      for (const int j : graph.row(i))
        levels(i, j) = 0;
    }
  for (int p = 0; p < n; ++p)
    for (int i = p + 1; i < n; ++i)
      for (int j = p + 1; j < n; ++j)
        levels(i, j) = std::min(levels(i, j), levels(i, p) + levels(p, j) + 1);
  return levels;
}

// Factors are rounded to float (6e-8) where entries are of the size of the diagonal; matrices here have condition
// numbers below 10.
constexpr double float_rounding = 2e-6;

} // namespace

TEST_CASE("ILU(0) of a block-tridiagonal matrix is exact")
{
  const int  block_size = GENERATE(1, 2, 3, 4);
  const auto graph      = tridiagonal(20);
  const auto values     = random_values(graph, block_size);
  const auto A          = dense(graph, block_size, values);

  BlockIlu factors(graph, block_size, 0);
  factors.factor(graph, values);

  CHECK(factors.n_blocks() == graph.columns.size());
  CHECK((product(factors) - A).norm() < float_rounding * A.norm());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(A.rows(), -1., 1.), b = A * x;
  factors.solve({b.data(), static_cast<std::size_t>(b.size())});
  CHECK((b - x).norm() < float_rounding * x.norm());
}

TEST_CASE("ILU(k) with a level as large as the matrix is a complete factorisation")
{
  const int  block_size = GENERATE(1, 3, 4);
  const auto graph      = random_graph(25, 40);
  const auto values     = random_values(graph, block_size);
  const auto A          = dense(graph, block_size, values);

  BlockIlu incomplete(graph, block_size, 0), complete(graph, block_size, graph.n_rows());
  incomplete.factor(graph, values);
  complete.factor(graph, values);

  CHECK((product(complete) - A).norm() < float_rounding * A.norm());
  CHECK((product(incomplete) - A).norm() > 100. * float_rounding * A.norm());
}

TEST_CASE("The pattern of ILU(k) follows the definition of the level of fill")
{
  const auto graph  = random_graph(40, 70);
  const auto levels = levels_by_definition(graph);
  for (const int fill_level : {0, 1, 2, 3})
    {
      const BlockIlu factors(graph, 1, fill_level);
      for (int i = 0; i < graph.n_rows(); ++i)
        {
          std::vector<int> expected;
          for (int j = 0; j < graph.n_rows(); ++j)
            if (levels(i, j) <= fill_level)
              expected.push_back(j);
          const auto row = factors.row(i);
          CHECK(row == expected);
        }
    }
}

TEST_CASE("The product of the incomplete factors is the matrix on the pattern that is kept")
{
  const int  block_size = 3, fill_level = GENERATE(0, 1);
  const auto graph  = random_graph(30, 60);
  const auto values = random_values(graph, block_size);
  const auto A      = dense(graph, block_size, values);

  BlockIlu factors(graph, block_size, fill_level);
  factors.factor(graph, values);
  const Dense error = product(factors) - A;

  double on_pattern = 0.;
  for (int i = 0; i < graph.n_rows(); ++i)
    for (const int j : factors.row(i))
      on_pattern += error.block(i * block_size, j * block_size, block_size, block_size).squaredNorm();
  CHECK(std::sqrt(on_pattern) < float_rounding * A.norm());
  CHECK(error.norm() > 100. * std::sqrt(on_pattern)); // something is left out elsewhere
}

TEST_CASE("Complete factors are exact on any number of threads, more than rows too")
{
  const int  block_size = GENERATE(1, 3, 4), n_threads = GENERATE(1, 2, 3, 5, 40);
  const auto graph  = GENERATE(random_graph(25, 40), tridiagonal(30), complete_graph(6));
  const auto values = random_values(graph, block_size);
  const auto A      = dense(graph, block_size, values);

  BlockIlu factors(graph, block_size, graph.n_rows(), n_threads);
  factors.factor(graph, values);

  CHECK((product(factors) - A).norm() < float_rounding * A.norm());
}

TEST_CASE("On several threads, too, the pattern follows the definition, in the order of elimination")
{
  const auto graph     = GENERATE(random_graph(40, 30), tridiagonal(40));
  const int  n_threads = GENERATE(1, 2, 3, 5, 50);
  for (const int fill_level : {0, 1, 3})
    {
      const BlockIlu factors(graph, 1, fill_level, n_threads);
      const auto     order = factors.order();
      CHECK(std::set<int>(order.begin(), order.end()).size() == 40);
      const auto levels = levels_by_definition(permuted(graph, order));
      for (int i = 0; i < graph.n_rows(); ++i)
        {
          std::vector<int> expected;
          for (int j = 0; j < graph.n_rows(); ++j)
            if (levels(i, j) <= fill_level)
              expected.push_back(j);
          CHECK(factors.row(i) == expected);
        }
    }
}

TEST_CASE("Separators are the first rows of the chunks behind the first, as many as the band is wide")
{
  const auto graph = tridiagonal(30);
  for (const int n_threads : {1, 2, 3, 5})
    {
      const BlockIlu factors(graph, 1, 0, n_threads);
      CHECK(factors.n_separator_rows() == n_threads - 1);
    }
  // One edge, given in one direction only, joins the chunks {0, 1} and {2, 3}.
  const SparseGraph one_edge{{0, 1, 3, 4, 5}, {0, 1, 2, 2, 3}};
  const BlockIlu    factors(one_edge, 1, 0, 2);
  REQUIRE(factors.n_separator_rows() == 1);
  CHECK(factors.order()[3] == 2);
}

// A chain of unknowns, between which multipliers without a diagonal stand behind the second of their two neighbours.
TEST_CASE("Rows without a diagonal are eliminated behind their neighbours, in descending interiors too")
{
  const int           n = 60; // unknowns; rows 3 k + 2 are multipliers of the two before
  SparseGraph         graph;
  std::vector<double> values;
  std::vector<char>   deferred;
  const auto          is_multiplier = [](int i) { return i % 3 == 2; };
  for (int i = 0; i < n; ++i)
    {
      for (int j = std::max(0, i - 2); j <= std::min(n - 1, i + 2); ++j)
        {
          const bool same_group = i / 3 == j / 3;
          if (i != j && !same_group && (is_multiplier(i) || is_multiplier(j)))
            continue;
          graph.columns.push_back(j);
          const bool constraint = is_multiplier(i) || is_multiplier(j);
          values.push_back(i == j       ? (is_multiplier(i) ? 0. : 4.)
                           : constraint ? (std::min(i, j) % 3 == 0 ? 1. : -1.)
                                        : 1.);
        }
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
      deferred.push_back(is_multiplier(i));
    }
  const auto A = dense(graph, 1, values);
  for (const int n_threads : {1, 2, 3, 4})
    {
      BlockIlu factors(graph, 1, n, n_threads, deferred);
      factors.factor(graph, values);
      CHECK((product(factors) - A).norm() < 10. * float_rounding * A.norm());
      std::vector<int> places(n);
      for (int k = 0; k < n; ++k)
        places[factors.order()[k]] = k;
      for (int i = 2; i < n; i += 3)
        CHECK(places[i] > std::min(places[i - 1], places[i - 2])); // the other one may be in a later separator
    }
  BlockIlu unaware(graph, 1, n, 2);
  CHECK_THROWS_AS(unaware.factor(graph, values), NoConvergence);
  CHECK_THROWS_AS(BlockIlu(graph, 1, 0, 2, std::vector<char>(3)), DimensionMismatch);
}

TEST_CASE("Factors do not depend on how many threads really run, nor on the run")
{
  const int  block_size = 3, n_threads = 4;
  const auto graph  = tridiagonal(200);
  const auto values = random_values(graph, block_size);

  const auto solution = [&] {
    BlockIlu factors(graph, block_size, 1, n_threads);
    factors.factor(graph, values);
    std::vector<double> x(200 * block_size);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = 1. / (i + 1.);
    factors.solve(x);
    return x;
  };
  const auto expected = solution();
  for (int repetition = 0; repetition < 5; ++repetition)
    CHECK(solution() == expected);

  std::vector<double> on_one_thread;
  const int           levels = omp_get_max_active_levels();
  omp_set_max_active_levels(1);
#pragma omp parallel num_threads(2)
#pragma omp          single
  on_one_thread = solution(); // inner regions have a single thread
  omp_set_max_active_levels(levels);
  CHECK(on_one_thread == expected);
}

TEST_CASE("One right-hand side stays as it is, or is replaced")
{
  const auto graph  = tridiagonal(12);
  const auto values = random_values(graph, 3);
  BlockIlu   factors(graph, 3, 0, 2);
  factors.factor(graph, values);
  const std::vector<double> b(36, 1.);
  std::vector<double>       x(36), y = b;
  factors.solve(b, x);
  factors.solve(y);
  CHECK(x == y);
  CHECK(b == std::vector<double>(36, 1.));
}

TEST_CASE("A singular block is reported from every thread")
{
  const auto graph = tridiagonal(20);
  for (const int row : {1, 10, 18}) // interior, separator, other interior
    {
      auto values                    = random_values(graph, 1);
      values[graph.offsets[row] + 1] = 0.;
      values[graph.offsets[row]]     = 0.; // nothing left of the diagonal
      values[graph.offsets[row] + 2] = 0.;
      BlockIlu factors(graph, 1, 0, 2);
      CHECK_THROWS_AS(factors.factor(graph, values), NoConvergence);
      factors.factor(graph, random_values(graph, 1)); // as good as new
      std::vector<double> x(20, 1.);
      factors.solve(x);
      CHECK(std::abs(x[row]) < 1.);
    }
}

TEST_CASE("Columns beyond the rows are left out and a missing diagonal is added")
{
  const SparseGraph         wide{{0, 3, 6}, {0, 1, 3, 0, 1, 2}};
  const SparseGraph         square{{0, 2, 4}, {0, 1, 0, 1}};
  const std::vector<double> wide_values = {4., 1., 9., 2., 5., 9.}, square_values = {4., 1., 2., 5.};

  BlockIlu from_wide(wide, 1, 0), from_square(square, 1, 0);
  from_wide.factor(wide, wide_values);
  from_square.factor(square, square_values);
  std::vector<double> x = {1., 2.}, y = x;
  from_wide.solve(x);
  from_square.solve(y);
  CHECK(x == y);

  const SparseGraph no_diagonal{{0, 2, 3}, {0, 1, 0}}; // [4 1; 2 0], the zero filled in by elimination
  BlockIlu          factors(no_diagonal, 1, 0);
  factors.factor(no_diagonal, std::vector<double>{4., 1., 2.});
  std::vector<double> z = {6., 2.};
  factors.solve(z);
  CHECK(z[0] == Approx(1.).epsilon(1e-6));
  CHECK(z[1] == Approx(2.).epsilon(1e-6));
}

TEST_CASE("Values may come in two pieces")
{
  const int  block_size = 2;
  const auto graph      = tridiagonal(12);
  const auto values     = random_values(graph, block_size);
  const auto split      = static_cast<std::ptrdiff_t>(graph.offsets[7]) * block_size * block_size;

  BlockIlu whole(graph, block_size, 1), pieces(graph, block_size, 1);
  whole.factor(graph, values);
  pieces.factor(graph, std::span(values).first(split), std::span(values).subspan(split));

  std::vector<double> x(24, 1.), y(24, 1.);
  whole.solve(x);
  pieces.solve(y);
  CHECK(x == y);
}

TEST_CASE("Incomplete factors refuse what they cannot do")
{
  const auto graph = tridiagonal(3);
  CHECK_THROWS_AS(BlockIlu(graph, 5, 0), InvalidParameter);
  CHECK_THROWS_AS(BlockIlu(graph, 0, 0), InvalidParameter);
  CHECK_THROWS_AS(BlockIlu(graph, 3, -1), InvalidParameter);
  CHECK_THROWS_AS(BlockIlu(graph, 3, 0, 0), InvalidParameter);

  BlockIlu factors(graph, 1, 0);
  CHECK_THROWS_AS(factors.factor(graph, std::vector<double>(6, 1.)), DimensionMismatch);
  std::vector<double> x(4, 1.);
  CHECK_THROWS_AS(factors.solve(x), DimensionMismatch);
  // Elimination makes the second pivot zero.
  CHECK_THROWS_AS(factors.factor(graph, std::vector<double>{1., 1., 1., 1., 1., 1., 1.}), NoConvergence);
}
