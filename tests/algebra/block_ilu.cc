// label: unit
#include <algorithm>
#include <random>
#include <set>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

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
Dense product(const BlockIlu &factors)
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
          CHECK(std::vector<int>(row.begin(), row.end()) == expected);
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

  BlockIlu factors(graph, 1, 0);
  CHECK_THROWS_AS(factors.factor(graph, std::vector<double>(6, 1.)), DimensionMismatch);
  std::vector<double> x(4, 1.);
  CHECK_THROWS_AS(factors.solve(x), DimensionMismatch);
  // Elimination makes the second pivot zero.
  CHECK_THROWS_AS(factors.factor(graph, std::vector<double>{1., 1., 1., 1., 1., 1., 1.}), NoConvergence);
}
