#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <sherd/base/sparse_graph.h>

namespace sherd
{

/// Incomplete factors A ~ L U of a matrix of small dense blocks, ILU(k) by level of fill on the graph of blocks.
///
/// A fill block (i, j) has the level min over p < min(i, j) of level(i, p) + level(p, j) + 1, blocks of the matrix
/// have level 0, and blocks of level up to fill_level are kept. With a fill_level of the number of rows the factors are
/// complete. L has unit diagonal blocks; the diagonal blocks of U are stored inverted. Rows are computed in double and
/// stored in float, substitution runs in double: a preconditioner does not need more, and memory traffic is what
/// its application costs.
class BlockIlu
{
public:
  /// Symbolic phase. Columns of @p graph from n_rows on (unknowns of other ranks) are left out, missing diagonals are
  /// added. @param block_size 1 to 4. @param fill_level at least 0. Throws InvalidParameter.
  BlockIlu(const SparseGraph &graph, int block_size, int fill_level);

  int         n_rows() const { return n_rows_; }
  int         block_size() const { return block_size_; }
  int         fill_level() const { return fill_level_; }
  std::size_t n_blocks() const { return columns_.size(); }

  /// Blocks of row @p i that are kept, ascending.
  std::span<const int> row(int i) const { return {columns_.data() + offsets_[i], columns_.data() + offsets_[i + 1]}; }

  /// Numeric phase. @param values in the layout of Matrix::values() for the first rows of @p graph (the same as in the
  /// constructor), @param more_values those of the remaining rows, in the same layout counted from their first row.
  /// Throws DimensionMismatch, and NoConvergence if a diagonal block is singular or a factor is not finite.
  void factor(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values = {});

  /// x = U^-1 L^-1 x, shape=(n_rows * block_size).
  void solve(std::span<double> x) const;

private:
  template <int block_size>
  void factor_blocks(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values);
  template <int block_size>
  void solve_blocks(double *x) const;

  int                      n_rows_, block_size_, fill_level_;
  std::vector<std::size_t> offsets_;  ///< of rows in columns_ and, times block_size^2, in factors_
  std::vector<std::size_t> diagonal_; ///< position of the diagonal block of each row
  std::vector<int>         columns_;
  std::vector<float>       factors_;
};

} // namespace sherd
