#include "equilibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "exchange.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

constexpr std::int64_t nowhere = std::numeric_limits<std::int64_t>::max();

/// Row @p a * block_size + c of this rank in the numbering of all ranks.
std::int64_t global_row(const Distribution &distribution, std::size_t row, int block_size)
{
  return distribution.global(static_cast<int>(row / block_size)) * block_size + static_cast<int>(row % block_size);
}

/// Throws on all ranks if any of them names a row.
void throw_if_any(MPI_Comm comm, std::int64_t row, int block_size, const std::string &before, const std::string &after)
{
  MPI_Allreduce(MPI_IN_PLACE, &row, 1, MPI_INT64_T, MPI_MIN, comm);
  if (row != nowhere)
    throw NoConvergence(before + " of control point " + std::to_string(row / block_size) + ", component " +
                        std::to_string(row % block_size) + after);
}

/// What the scaling needs to know of one scalar row.
struct RowExtent
{
  double diagonal = 0., largest = 0., largest_off_diagonal = 0.;
  bool   finite = true;
};

/// Calls visit(row, values of the scalar row, columns of its blocks, position of its diagonal entry).
template <class Visitor>
void for_each_row(Matrix &matrix, const Visitor &visit)
{
  const auto &graph      = matrix.graph();
  const int   block_size = matrix.block_size();
  for (int A = 0; A < graph.n_rows(); ++A)
    {
      const auto columns  = graph.row(A);
      const auto place    = std::lower_bound(columns.begin(), columns.end(), A) - columns.begin();
      const auto length   = static_cast<std::size_t>(matrix.row_length(A));
      const auto diagonal = static_cast<std::size_t>(place) * block_size;
      for (int c = 0; c < block_size; ++c)
        visit(static_cast<std::size_t>(A) * block_size + c,
              matrix.values().subspan(matrix.row_start(A) + c * length, length), columns, diagonal + c);
    }
}

RowExtent extent(std::span<const double> values, std::size_t diagonal)
{
  RowExtent result;
  double    zero = 0.;
  for (std::size_t m = 0; m < values.size(); ++m)
    {
      zero += values[m] * 0.;
      if (m != diagonal)
        result.largest_off_diagonal = std::max(result.largest_off_diagonal, std::abs(values[m]));
    }
  result.finite   = zero == 0.;
  result.diagonal = std::abs(values[diagonal]);
  result.largest  = std::max(result.diagonal, result.largest_off_diagonal);
  return result;
}

} // namespace

Equilibration equilibrate(Matrix &matrix)
{
  constexpr double negligible   = 1e-14;
  const auto      &distribution = matrix.distribution();
  const int        block_size   = matrix.block_size();

  Equilibration            result;
  auto                    &scaling = result.scaling;
  std::vector<std::size_t> without_diagonal;
  std::int64_t             not_finite = nowhere, zero = nowhere;
  scaling.assign(static_cast<std::size_t>(distribution.n_local()) * block_size, 1.);
  for_each_row(matrix,
               [&](std::size_t row, std::span<const double> values, std::span<const int>, std::size_t diagonal) {
                 const auto found = extent(values, diagonal);
                 if (!found.finite)
                   not_finite = std::min(not_finite, global_row(distribution, row, block_size));
                 else if (found.largest == 0.)
                   zero = std::min(zero, global_row(distribution, row, block_size));
                 else if (found.diagonal <= negligible * found.largest)
                   without_diagonal.push_back(row);
                 else
                   {
                     scaling[row] = 1. / std::sqrt(found.diagonal);
                     if (found.largest_off_diagonal == 0.)
                       result.known.push_back({static_cast<int>(row), std::copysign(1., values[diagonal])});
                   }
               });
  throw_if_any(
      distribution.comm(), not_finite, block_size, "linear system: the matrix row",
      " holds a value that is not finite; the state it was assembled at has left the range of the model, try a "
      "smaller step");
  throw_if_any(distribution.comm(), zero, block_size, "linear system: the matrix row",
               " is zero; no element, support or constraint acts on this unknown");
  update_ghost_values(distribution, scaling, block_size);

  if (!without_diagonal.empty())
    {
      auto scaled = scaling;
      auto next   = without_diagonal.begin();
      for_each_row(matrix, [&](std::size_t row, std::span<const double> values, std::span<const int> columns,
                               std::size_t) {
        if (next == without_diagonal.end() || *next != row)
          return;
        ++next;
        double largest = 0.;
        for (std::size_t m = 0; m < values.size(); ++m)
          largest = std::max(
              largest, std::abs(values[m]) *
                           scaling[static_cast<std::size_t>(columns[m / block_size]) * block_size + m % block_size]);
        scaled[row] = 1. / largest;
      });
      scaling = std::move(scaled);
    }
  update_ghost_values(distribution, scaling, block_size);

  for_each_row(matrix, [&](std::size_t row, std::span<double> values, std::span<const int> columns, std::size_t) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (int d = 0; d < block_size; ++d)
        values[k * block_size + d] *= scaling[row] * scaling[static_cast<std::size_t>(columns[k]) * block_size + d];
  });
  return result;
}

void check_finite(const Vector &rhs)
{
  std::int64_t not_finite = nowhere;
  for (std::size_t row = 0; row < rhs.owned().size(); ++row)
    if (!std::isfinite(rhs.owned()[row]))
      not_finite = std::min(not_finite, global_row(rhs.distribution(), row, rhs.block_size()));
  throw_if_any(rhs.distribution().comm(), not_finite, rhs.block_size(), "linear system: the right-hand side",
               " is not finite; the state it was assembled at has left the range of the model, try a smaller step");
}

} // namespace sherd
