#include <sherd/algebra/vector.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "exchange.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

Vector::Vector(std::shared_ptr<const Distribution> distribution, int block_size)
    : distribution_(std::move(distribution)), block_size_(block_size)
{
  if (block_size < 1)
    throw InvalidParameter("block size of a vector = " + std::to_string(block_size) + ", expected at least 1");
  values_.assign(static_cast<std::size_t>(distribution_->n_local()) * block_size, 0.);
}

void Vector::update_ghosts()
{
  update_ghost_values(*distribution_, values_, block_size_);
}

void Vector::fill(double value)
{
  std::fill(values_.begin(), values_.end(), value);
}

double dot(const Vector &x, const Vector &y)
{
  assert(x.owned().size() == y.owned().size());
  const auto a = x.owned(), b = y.owned();
  double     sum = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, x.distribution().comm());
  return sum;
}

double norm(const Vector &x)
{
  return std::sqrt(dot(x, x));
}

void axpy(double alpha, const Vector &x, Vector &y)
{
  assert(x.local().size() == y.local().size());
  const auto a = x.local();
  const auto b = y.local();
  for (std::size_t i = 0; i < a.size(); ++i)
    b[i] += alpha * a[i];
}

void scale(double alpha, Vector &x)
{
  for (double &value : x.local())
    value *= alpha;
}

std::vector<double> gather(const Vector &x)
{
  const auto      &distribution = x.distribution();
  const int        n_ranks = distribution.n_ranks(), block_size = x.block_size(), n_owned = distribution.n_owned();
  std::vector<int> counts(n_ranks), offsets(n_ranks + 1, 0);
  MPI_Allgather(&n_owned, 1, MPI_INT, counts.data(), 1, MPI_INT, distribution.comm());
  for (int r = 0; r < n_ranks; ++r)
    offsets[r + 1] = offsets[r] + counts[r];
  std::vector<std::int64_t> ids(distribution.n_global());
  MPI_Allgatherv(distribution.ids().data(), n_owned, MPI_INT64_T, ids.data(), counts.data(), offsets.data(),
                 MPI_INT64_T, distribution.comm());

  MPI_Datatype block;
  MPI_Type_contiguous(block_size, MPI_DOUBLE, &block);
  MPI_Type_commit(&block);
  std::vector<double> by_rank(ids.size() * block_size), result(by_rank.size());
  MPI_Allgatherv(x.local().data(), n_owned, block, by_rank.data(), counts.data(), offsets.data(), block,
                 distribution.comm());
  MPI_Type_free(&block);
  for (std::size_t k = 0; k < ids.size(); ++k)
    std::copy_n(by_rank.data() + k * block_size, block_size, result.data() + ids[k] * block_size);
  return result;
}

void scatter(std::span<const double> values, Vector &x)
{
  const auto &distribution = x.distribution();
  const int   block_size   = x.block_size();
  if (values.size() != static_cast<std::size_t>(distribution.n_global()) * block_size)
    throw DimensionMismatch("scatter: " + std::to_string(values.size()) + " values given, expected " +
                            std::to_string(block_size) + " for each of " + std::to_string(distribution.n_global()) +
                            " control points");
  for (int a = 0; a < distribution.n_local(); ++a)
    std::copy_n(values.data() + distribution.global(a) * block_size, block_size,
                x.local().data() + static_cast<std::size_t>(a) * block_size);
}

} // namespace sherd
