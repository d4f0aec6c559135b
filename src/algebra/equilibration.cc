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

/// Largest magnitude; tells by @p zero whether a value is not finite. Values that are not numbers are passed over.
double largest_magnitude(std::span<const double> values, double &zero)
{
  constexpr std::size_t n_lanes          = 8;
  double                largest[n_lanes] = {}, zeros[n_lanes] = {};
  const auto            take = [&](std::size_t lane, double value) {
    const double magnitude = std::abs(value);
    largest[lane]          = magnitude > largest[lane] ? magnitude : largest[lane];
    zeros[lane] += value * 0.;
  };
  const auto n_whole = values.size() / n_lanes * n_lanes;
  for (std::size_t m = 0; m < n_whole; m += n_lanes)
    for (std::size_t lane = 0; lane < n_lanes; ++lane)
      take(lane, values[m + lane]);
  for (std::size_t m = n_whole; m < values.size(); ++m)
    take(m - n_whole, values[m]);
  for (const double lane : zeros)
    zero += lane;
  return *std::max_element(largest, largest + n_lanes);
}

RowExtent extent(std::span<const double> values, std::size_t diagonal)
{
  RowExtent    result;
  double       zero           = values[diagonal] * 0.;
  const double before         = largest_magnitude(values.first(diagonal), zero);
  const double after          = largest_magnitude(values.subspan(diagonal + 1), zero);
  result.largest_off_diagonal = std::max(before, after);
  result.finite               = zero == 0.;
  result.diagonal             = std::abs(values[diagonal]);
  result.largest              = std::max(result.diagonal, result.largest_off_diagonal);
  return result;
}

/// What is known of a scalar row after a first look.
enum class RowKind : unsigned char
{
  ordinary,
  known,    ///< the diagonal alone
  negative, ///< a negative diagonal, as that of a multiplier, which may be next to nothing
  without_diagonal,
  zero,
  not_finite
};

/// Calls visit(A) for each block row, on all threads.
template <class Visitor>
void for_each_block_row(const Matrix &matrix, const Visitor &visit)
{
  const int n_rows = matrix.graph().n_rows();
#pragma omp parallel for schedule(static) if (n_rows > 1000)
  for (int A = 0; A < n_rows; ++A)
    visit(A);
}

/// First row of a kind in the numbering of all ranks, or nowhere.
std::int64_t first_of(RowKind kind, std::span<const RowKind> kinds, const Distribution &distribution, int block_size)
{
  auto result = nowhere;
  for (std::size_t row = 0; row < kinds.size(); ++row)
    if (kinds[row] == kind)
      result = std::min(result, global_row(distribution, row, block_size));
  return result;
}

/// Sets the scaling of rows that have a diagonal.
std::vector<RowKind> classify(const Matrix &matrix, std::span<double> scaling)
{
  constexpr double     negligible = 1e-14;
  const int            block_size = matrix.block_size();
  std::vector<RowKind> kinds(static_cast<std::size_t>(matrix.graph().n_rows()) * block_size, RowKind::ordinary);
  for_each_block_row(matrix, [&](int A) {
    const auto columns  = matrix.graph().row(A);
    const auto place    = std::lower_bound(columns.begin(), columns.end(), A) - columns.begin();
    const auto length   = static_cast<std::size_t>(matrix.row_length(A));
    const auto diagonal = static_cast<std::size_t>(place) * block_size;
    for (int c = 0; c < block_size; ++c)
      {
        const auto row   = static_cast<std::size_t>(A) * block_size + c;
        const auto found = extent(matrix.values().subspan(matrix.row_start(A) + c * length, length), diagonal + c);
        if (!found.finite)
          kinds[row] = RowKind::not_finite;
        else if (found.largest == 0.)
          kinds[row] = RowKind::zero;
        else if (found.diagonal <= negligible * found.largest)
          kinds[row] = RowKind::without_diagonal;
        else
          {
            scaling[row] = 1. / std::sqrt(found.diagonal);
            if (found.largest_off_diagonal == 0.)
              kinds[row] = RowKind::known;
            else if (matrix.diagonal(A, c) < 0.)
              kinds[row] = RowKind::negative;
          }
      }
  });
  return kinds;
}

/// Scales rows without diagonal by their largest entry after the columns are scaled; those of a negative one too, if
/// that is more than it asks for.
void scale_by_largest(const Matrix &matrix, std::span<const RowKind> kinds, std::vector<double> &scaling)
{
  const int block_size = matrix.block_size();
  auto      scaled     = scaling;
  for_each_block_row(matrix, [&](int A) {
    const auto columns = matrix.graph().row(A);
    const auto length  = static_cast<std::size_t>(matrix.row_length(A));
    for (int c = 0; c < block_size; ++c)
      {
        const auto row = static_cast<std::size_t>(A) * block_size + c;
        if (kinds[row] != RowKind::without_diagonal && kinds[row] != RowKind::negative)
          continue;
        const auto values  = matrix.values().subspan(matrix.row_start(A) + c * length, length);
        double     largest = 0.;
        for (std::size_t m = 0; m < length; ++m)
          if (const auto column = static_cast<std::size_t>(columns[m / block_size]) * block_size + m % block_size;
              column != row)
            largest = std::max(largest, std::abs(values[m]) * scaling[column]);
        scaled[row] = kinds[row] == RowKind::negative ? std::min(scaling[row], 1. / largest) : 1. / largest;
      }
  });
  scaling = std::move(scaled);
}

void scale_rows_and_columns(Matrix &matrix, std::span<const double> scaling)
{
  const int block_size = matrix.block_size();
  for_each_block_row(matrix, [&](int A) {
    const auto    columns = matrix.graph().row(A);
    const auto    length  = static_cast<std::size_t>(matrix.row_length(A));
    double *const values  = matrix.values().data() + matrix.row_start(A);
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (int c = 0; c < block_size; ++c)
        for (int d = 0; d < block_size; ++d)
          values[c * length + k * block_size + d] *= scaling[static_cast<std::size_t>(A) * block_size + c] *
                                                     scaling[static_cast<std::size_t>(columns[k]) * block_size + d];
  });
}

} // namespace

Equilibration equilibrate(Matrix &matrix)
{
  const auto &distribution = matrix.distribution();
  const int   block_size   = matrix.block_size();

  Equilibration result;
  auto         &scaling = result.scaling;
  scaling.assign(static_cast<std::size_t>(distribution.n_local()) * block_size, 1.);
  const auto kinds = classify(matrix, scaling);
  throw_if_any(
      distribution.comm(), first_of(RowKind::not_finite, kinds, distribution, block_size), block_size,
      "linear system: the matrix row",
      " holds a value that is not finite; the state it was assembled at has left the range of the model, try a "
      "smaller step");
  throw_if_any(distribution.comm(), first_of(RowKind::zero, kinds, distribution, block_size), block_size,
               "linear system: the matrix row", " is zero; no element, support or constraint acts on this unknown");
  for (std::size_t row = 0; row < kinds.size(); ++row)
    if (kinds[row] == RowKind::known)
      result.known.push_back(
          {static_cast<int>(row),
           std::copysign(1., matrix.diagonal(static_cast<int>(row) / block_size, static_cast<int>(row) % block_size))});
  update_ghost_values(distribution, scaling, block_size);
  if (std::any_of(kinds.begin(), kinds.end(),
                  [](RowKind kind) { return kind == RowKind::without_diagonal || kind == RowKind::negative; }))
    scale_by_largest(matrix, kinds, scaling);
  update_ghost_values(distribution, scaling, block_size);
  scale_rows_and_columns(matrix, scaling);
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
