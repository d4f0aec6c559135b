#include <sherd/algebra/matrix.h>

#include <algorithm>
#include <string>

#include "registers.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

void check(const Distribution &distribution, const SparseGraph &graph, int block_size)
{
  if (block_size < 1 || block_size > 4)
    throw InvalidParameter("block size of a matrix = " + std::to_string(block_size) + ", expected 1 to 4");
  if (graph.n_rows() != distribution.n_owned())
    throw DimensionMismatch("matrix graph has " + std::to_string(graph.n_rows()) + " rows, expected one for each of " +
                            std::to_string(distribution.n_owned()) + " owned control points");
  for (int A = 0; A < graph.n_rows(); ++A)
    {
      const auto        row  = graph.row(A);
      const std::string name = "matrix graph, row of control point " + std::to_string(distribution.global(A));
      for (std::size_t k = 0; k < row.size(); ++k)
        {
          if (row[k] < 0 || row[k] >= distribution.n_local())
            throw DimensionMismatch(name + ": column " + std::to_string(row[k]) +
                                    ", expected a local control point in [0, " +
                                    std::to_string(distribution.n_local()) + ")");
          if (k > 0 && row[k] <= row[k - 1])
            throw InvalidParameter(name + ": column " + std::to_string(row[k]) + " after " +
                                   std::to_string(row[k - 1]) + ", expected ascending columns");
        }
      if (!std::binary_search(row.begin(), row.end(), A))
        throw InvalidParameter(name + " has no diagonal block");
    }
}

/// The scalar rows of a block row, one after the other in memory, times the same short vector.
template <int block_size>
void multiply_row(int length, const double *row, const double *in, double *out)
{
  using Doubles              = Registers<4>::Doubles;
  Doubles   sums[block_size] = {};
  const int n_whole          = length / 4 * 4;
  for (int m = 0; m < n_whole; m += 4)
    for (int c = 0; c < block_size; ++c)
      sums[c] += *reinterpret_cast<const Doubles *>(row + c * length + m) * *reinterpret_cast<const Doubles *>(in + m);
  for (int c = 0; c < block_size; ++c)
    {
      out[c] = (sums[c][0] + sums[c][1]) + (sums[c][2] + sums[c][3]);
      for (int m = n_whole; m < length; ++m)
        out[c] += row[c * length + m] * in[m];
    }
}

/// The order of summation depends on the row alone, so results do not depend on the number of threads.
template <int block_size>
void multiply_blocks(const SparseGraph &graph, const double *values, const double *x, double *y)
{
  const int n_rows     = graph.n_rows();
  int       max_blocks = 0;
  for (int A = 0; A < n_rows; ++A)
    max_blocks = std::max(max_blocks, graph.offsets[A + 1] - graph.offsets[A]);
#pragma omp parallel if (n_rows > 1000)
  {
    std::vector<double> gathered(static_cast<std::size_t>(max_blocks) * block_size);
#pragma omp for schedule(static)
    for (int A = 0; A < n_rows; ++A)
      {
        const int first = graph.offsets[A], n_blocks = graph.offsets[A + 1] - first;
        for (int k = 0; k < n_blocks; ++k)
          std::copy_n(x + static_cast<std::size_t>(graph.columns[first + k]) * block_size, block_size,
                      gathered.data() + k * block_size);
        multiply_row<block_size>(n_blocks * block_size,
                                 values + static_cast<std::size_t>(first) * block_size * block_size, gathered.data(),
                                 y + static_cast<std::size_t>(A) * block_size);
      }
  }
}

} // namespace

Matrix::Matrix(std::shared_ptr<const Distribution> distribution, SparseGraph graph, int block_size)
    : distribution_(std::move(distribution)), block_size_(block_size)
{
  check(*distribution_, graph, block_size);
  graph_ = std::make_shared<const SparseGraph>(std::move(graph));
  values_.assign(row_start(graph_->n_rows()), 0.);
}

std::size_t Matrix::diagonal_position(int A, int c) const
{
  const auto row   = graph_->row(A);
  const auto block = std::lower_bound(row.begin(), row.end(), A) - row.begin();
  return row_start(A) + static_cast<std::size_t>(c) * row_length(A) + block * block_size_ + c;
}

void Matrix::set_zero()
{
  std::fill(values_.begin(), values_.end(), 0.);
}

void Matrix::multiply(const Vector &x, Vector &y) const
{
  if (x.block_size() != block_size_ || y.block_size() != block_size_)
    throw DimensionMismatch("matrix of block size " + std::to_string(block_size_) + " times a vector of block size " +
                            std::to_string(x.block_size()) + " into one of " + std::to_string(y.block_size()));
  multiply(x.local(), y.owned());
}

void Matrix::multiply(std::span<const double> x, std::span<double> y) const
{
  const auto n_local = static_cast<std::size_t>(distribution_->n_local()) * block_size_;
  const auto n_owned = static_cast<std::size_t>(distribution_->n_owned()) * block_size_;
  if (x.size() != n_local || y.size() != n_owned)
    throw DimensionMismatch("matrix with " + std::to_string(n_owned) + " rows and " + std::to_string(n_local) +
                            " columns on this rank times " + std::to_string(x.size()) + " values into " +
                            std::to_string(y.size()));
  switch (block_size_)
    {
    case 1:
      return multiply_blocks<1>(*graph_, values_.data(), x.data(), y.data());
    case 2:
      return multiply_blocks<2>(*graph_, values_.data(), x.data(), y.data());
    case 3:
      return multiply_blocks<3>(*graph_, values_.data(), x.data(), y.data());
    default:
      return multiply_blocks<4>(*graph_, values_.data(), x.data(), y.data());
    }
}

} // namespace sherd
