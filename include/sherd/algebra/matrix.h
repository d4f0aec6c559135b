#pragma once

#include <memory>
#include <span>
#include <vector>

#include <sherd/algebra/distribution.h>
#include <sherd/algebra/vector.h>
#include <sherd/base/sparse_graph.h>

namespace sherd
{

/// Distributed sparse matrix of square blocks. A rank holds the rows of its owned control points and fills them alone:
/// elements at the border between ranks are integrated by each rank that owns one of their rows.
///
/// values() are the compressed rows of the scalar matrix: entry (c, d) of the k-th block of block row A is
/// values()[row_start(A) + c * row_length(A) + k * block_size + d]; the block's column is graph().row(A)[k]. So a
/// table of positions computed once serves every assembly. Different rows may be written by different threads.
class Matrix
{
public:
  /// @param graph       rows: owned control points, columns: local control points, ascending, the diagonal among them
  /// @param block_size  1 to 4
  ///
  /// Throws InvalidParameter (block size, columns not ascending, no diagonal) and DimensionMismatch (rows, columns out
  /// of range). Local: a rank that throws does so alone.
  Matrix(std::shared_ptr<const Distribution> distribution, SparseGraph graph, int block_size);

  const Distribution                        &distribution() const { return *distribution_; }
  const std::shared_ptr<const Distribution> &shared_distribution() const { return distribution_; }
  const SparseGraph                         &graph() const { return *graph_; }
  /// Copies of a matrix share their graph; what depends on the graph alone may be kept while this pointer stays.
  const std::shared_ptr<const SparseGraph> &shared_graph() const { return graph_; }
  int                                       block_size() const { return block_size_; }

  std::span<double>       values() { return values_; }
  std::span<const double> values() const { return values_; }

  /// Position of the first value of block row @p A.
  std::size_t row_start(int A) const
  {
    return static_cast<std::size_t>(graph_->offsets[A]) * block_size_ * block_size_;
  }

  /// Number of values in one scalar row of block row @p A.
  int row_length(int A) const { return block_size_ * (graph_->offsets[A + 1] - graph_->offsets[A]); }

  /// Entry (c, c) of the diagonal block of block row @p A.
  double  diagonal(int A, int c) const { return values_[diagonal_position(A, c)]; }
  double &diagonal(int A, int c) { return values_[diagonal_position(A, c)]; }

  void set_zero();

  /// y = A x on the owned control points; the ghosts of x have to be up to date, those of y are left as they are.
  /// Local. Throws DimensionMismatch.
  void multiply(const Vector &x, Vector &y) const;

  /// The same on raw values: @p x shape=(n_local * block_size), @p y shape=(n_owned * block_size).
  void multiply(std::span<const double> x, std::span<double> y) const;

private:
  std::size_t diagonal_position(int A, int c) const;

  std::shared_ptr<const Distribution> distribution_;
  std::shared_ptr<const SparseGraph>  graph_;
  int                                 block_size_;
  std::vector<double>                 values_;
};

} // namespace sherd
