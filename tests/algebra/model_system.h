#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>

namespace sherd::test
{

/// A plate of n x n control points of uniform quadratic B-splines with spacing 1, each with two displacements and a
/// phase: inertia and in-plane stiffness for the displacements, a fourth-order equation for the phase, a weak
/// non-symmetric coupling between them. Every 3x3 block of the 5x5 stencil follows from the tables below.
struct ModelSystem
{
  int    n;
  double inertia      = 1.;  ///< weight of the mass of the displacements
  double bending      = 0.;  ///< weight of a bilaplacian on the displacements
  double displacement = 1e4; ///< factor on rows and columns of the displacements: 1e8 on their diagonal

  static constexpr int block_size = 3;

  /// Block between two control points, row-major; zero outside the stencil.
  std::array<double, 9> block(std::int64_t row, std::int64_t column) const
  {
    static constexpr double mass[]      = {66. / 120, 26. / 120, 1. / 120};
    static constexpr double stiffness[] = {6. / 6, -2. / 6, -1. / 6};
    static constexpr double second[]    = {6., -4., 1.};
    static constexpr double first[]     = {0., 10. / 24, 1. / 24};
    const auto              dx = column % n - row % n, dy = column / n - row / n;
    const auto              ax = std::abs(dx), ay = std::abs(dy);
    if (ax > 2 || ay > 2)
      return {};
    const double sx = dx < 0 ? -1. : 1., sy = dy < 0 ? -1. : 1.;
    const double m = mass[ax] * mass[ay], kx = stiffness[ax] * mass[ay], ky = mass[ax] * stiffness[ay];
    const double cross       = -0.3 * sx * first[ax] * sy * first[ay];
    const double bilaplacian = second[ax] * mass[ay] + 2. * stiffness[ax] * stiffness[ay] + mass[ax] * second[ay];
    const double in_plane = inertia * m + bending * bilaplacian, s = displacement;
    return {s * s * (in_plane + kx + 0.35 * ky),
            s * s * cross,
            0.1 * s * sx * first[ax] * mass[ay],
            s * s * cross,
            s * s * (in_plane + 0.35 * kx + ky),
            0.1 * s * mass[ax] * sy * first[ay],
            0.2 * s * sx * first[ax] * mass[ay],
            0.,
            m + kx + ky + bilaplacian};
  }

  std::vector<std::int64_t> neighbours(std::int64_t point) const
  {
    std::vector<std::int64_t> result;
    for (auto y = std::max<std::int64_t>(point / n - 2, 0); y <= std::min<std::int64_t>(point / n + 2, n - 1); ++y)
      for (auto x = std::max<std::int64_t>(point % n - 2, 0); x <= std::min<std::int64_t>(point % n + 2, n - 1); ++x)
        result.push_back(y * n + x);
    return result;
  }

  /// Horizontal strips of control points, one for each of the first n_parts ranks; later ranks are empty.
  std::shared_ptr<const Distribution> distribute(MPI_Comm comm, int n_parts) const
  {
    int rank;
    MPI_Comm_rank(comm, &rank);
    std::vector<std::int64_t> owned;
    std::set<std::int64_t>    ghosts;
    for (std::int64_t point = 0; point < n * n; ++point)
      if (point / n * n_parts / n == rank)
        owned.push_back(point);
    for (const auto point : owned)
      for (const auto neighbour : neighbours(point))
        if (neighbour / n * n_parts / n != rank)
          ghosts.insert(neighbour);
    return std::make_shared<const Distribution>(comm, owned, std::vector<std::int64_t>(ghosts.begin(), ghosts.end()));
  }

  std::shared_ptr<const Distribution> distribute(MPI_Comm comm) const
  {
    int n_ranks;
    MPI_Comm_size(comm, &n_ranks);
    return distribute(comm, n_ranks);
  }

  Matrix matrix(const std::shared_ptr<const Distribution> &distribution) const
  {
    SparseGraph graph;
    for (int A = 0; A < distribution->n_owned(); ++A)
      {
        std::vector<int> row;
        for (const auto neighbour : neighbours(distribution->global(A)))
          row.push_back(distribution->local(neighbour));
        std::sort(row.begin(), row.end());
        graph.columns.insert(graph.columns.end(), row.begin(), row.end());
        graph.offsets.push_back(static_cast<int>(graph.columns.size()));
      }
    Matrix result(distribution, std::move(graph), block_size);
    fill(result);
    return result;
  }

  void fill(Matrix &matrix) const
  {
    const auto &distribution = matrix.distribution();
    for (int A = 0; A < distribution.n_owned(); ++A)
      {
        const auto row = matrix.graph().row(A);
        for (std::size_t k = 0; k < row.size(); ++k)
          {
            const auto values = block(distribution.global(A), distribution.global(row[k]));
            for (int c = 0; c < block_size; ++c)
              for (int d = 0; d < block_size; ++d)
                matrix.values()[matrix.row_start(A) + c * matrix.row_length(A) + k * block_size + d] =
                    values[c * block_size + d];
          }
      }
  }
};

/// Turns the scalar row of component @p c of an owned control point into a row of the identity.
inline void make_identity_row(Matrix &matrix, int A, int c)
{
  const auto row = matrix.graph().row(A);
  for (std::size_t k = 0; k < row.size(); ++k)
    for (int d = 0; d < matrix.block_size(); ++d)
      matrix.values()[matrix.row_start(A) + c * matrix.row_length(A) + k * matrix.block_size() + d] =
          row[k] == A && d == c ? 1. : 0.;
}

/// Values between -1 and 1 that depend on the global numbering alone; displacements are divided by @p displacement, so
/// that all equilibrated unknowns are of order 1.
inline Vector random_vector(const std::shared_ptr<const Distribution> &distribution, int block_size,
                            double displacement = 1.)
{
  std::mt19937                           engine(1);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::vector<double>                    values(distribution->n_global() * block_size);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = uniform(engine) / (static_cast<int>(i % block_size) < block_size - 1 ? displacement : 1.);
  Vector result(distribution, block_size);
  scatter(values, result);
  return result;
}

/// Largest difference over all ranks, displacements multiplied by @p displacement.
inline double distance(const Vector &x, const Vector &y, double displacement = 1.)
{
  double    result     = 0.;
  const int block_size = x.block_size();
  for (std::size_t i = 0; i < x.owned().size(); ++i)
    result = std::max(result, std::abs(x.owned()[i] - y.owned()[i]) *
                                  (static_cast<int>(i % block_size) < block_size - 1 ? displacement : 1.));
  MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_DOUBLE, MPI_MAX, x.distribution().comm());
  return result;
}

inline int rank_of_world()
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int ranks_of_world()
{
  int n_ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  return n_ranks;
}

} // namespace sherd::test
