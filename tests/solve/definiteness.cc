// ranks: 1 2 3
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <sherd/solve/definiteness.h>

using namespace sherd;

namespace
{

/// Field 1 of the blocks is the matrix of a chain of n springs, stencil (-1, diagonal, -1), with the eigenvalues
/// diagonal - 2 cos(k pi / (n + 1)), k = 1 ... n; the other entries are noise. Ids go round the ranks.
Matrix chain(int n, double diagonal)
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  std::vector<std::int64_t> owned, ghosts;
  const auto                owner = [&](int i) { return (i / 3) % n_ranks; };
  for (int i = 0; i < n; ++i)
    if (owner(i) == rank)
      owned.push_back(i);
  for (int i = 0; i < n; ++i)
    if (owner(i) != rank && ((i > 0 && owner(i - 1) == rank) || (i + 1 < n && owner(i + 1) == rank)))
      ghosts.push_back(i);
  const auto d = std::make_shared<const Distribution>(MPI_COMM_WORLD, owned, ghosts);

  SparseGraph graph;
  graph.offsets = {0};
  for (const auto i : owned)
    {
      std::vector<int> row;
      for (auto j = std::max<std::int64_t>(i - 1, 0); j <= std::min<std::int64_t>(i + 1, n - 1); ++j)
        row.push_back(d->local(j));
      std::sort(row.begin(), row.end());
      graph.columns.insert(graph.columns.end(), row.begin(), row.end());
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
    }

  Matrix                                 matrix(d, graph, 3);
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> noise(-5., 5.);
  for (auto &value : matrix.values())
    value = noise(random);
  for (int a = 0; a < d->n_owned(); ++a)
    for (std::size_t k = 0; k < graph.row(a).size(); ++k)
      matrix.values()[matrix.row_start(a) + 1 * matrix.row_length(a) + k * 3 + 1] =
          graph.row(a)[k] == a ? diagonal : -1.;
  return matrix;
}

/// Local numbers of the ids in [begin, end): those this rank owns.
std::vector<int> points(const Matrix &matrix, int begin, int end)
{
  std::vector<int> result;
  for (int a = 0; a < matrix.distribution().n_owned(); ++a)
    if (matrix.distribution().global(a) >= begin && matrix.distribution().global(a) < end)
      result.push_back(a);
  return result;
}

double critical(int n)
{
  return 2. * std::cos(M_PI / (n + 1));
}

} // namespace

TEST_CASE("A block is positive definite exactly when its lowest eigenvalue is positive")
{
  const int  n     = 20;
  const auto above = chain(n, critical(n) + 1e-9);
  const auto below = chain(n, critical(n) - 1e-9);
  CHECK(positive_definite(above, 1, points(above, 0, n)));
  CHECK_FALSE(positive_definite(below, 1, points(below, 0, n)));
}

TEST_CASE("Only the given points count")
{
  // Indefinite over 8 neighbours and more, definite over 7.
  const int  n      = 20;
  const auto matrix = chain(n, .5 * (critical(7) + critical(8)));
  CHECK_FALSE(positive_definite(matrix, 1, points(matrix, 0, n)));
  CHECK_FALSE(positive_definite(matrix, 1, points(matrix, 5, 13)));
  CHECK(positive_definite(matrix, 1, points(matrix, 5, 12)));
  CHECK(positive_definite(matrix, 1, points(matrix, 13, n)));
}

TEST_CASE("Points that only a copy names are found, and naming one twice does no harm")
{
  const int        n     = 20;
  const auto       below = chain(n, critical(n) - 1e-9);
  const auto       above = chain(n, critical(n) + 1e-9);
  std::vector<int> local(below.distribution().n_local());
  for (std::size_t a = 0; a < local.size(); ++a)
    local[a] = static_cast<int>(a);
  CHECK_FALSE(positive_definite(below, 1, local));
  CHECK(positive_definite(above, 1, local));

  // The whole question is asked by the last rank alone.
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (rank != n_ranks - 1)
    local.clear();
  CHECK(positive_definite(above, 1, local));
}

TEST_CASE("No points are positive definite, a value that is no number is not")
{
  const int n      = 20;
  auto      matrix = chain(n, 3.);
  CHECK(positive_definite(matrix, 1, {}));
  for (int a = 0; a < matrix.distribution().n_owned(); ++a)
    if (matrix.distribution().global(a) == 7)
      {
        const auto row  = matrix.graph().row(a);
        const auto self = std::find(row.begin(), row.end(), a) - row.begin();
        matrix.values()[matrix.row_start(a) + matrix.row_length(a) + self * 3 + 1] =
            std::numeric_limits<double>::quiet_NaN();
      }
  CHECK_FALSE(positive_definite(matrix, 1, points(matrix, 0, n)));
  CHECK(positive_definite(matrix, 1, points(matrix, 9, n)));
}
