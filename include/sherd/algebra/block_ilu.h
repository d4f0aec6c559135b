#pragma once

#include <cstddef>
#include <span>
#include <string>
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
/// its application costs. L and U are stored apart, each in the order in which its sweep reads it.
///
/// Threads. The rows are cut into n_threads contiguous chunks of about as many blocks. Where a block couples rows of
/// two chunks, the row of the later chunk goes to the separator of that chunk; the other rows of a chunk are its
/// interior. All interiors are eliminated before all separators; rows ascend in every other interior and descend in
/// those between, so that two neighbours are eliminated towards the separator between them: with two threads no
/// elimination starts at a separator, which would spread its rows' fill and cost iterations where that is dropped. A
/// kept block (i, j) stands for a path from i to j in the graph, of at most fill_level inner vertices, all eliminated
/// before both i and j. Before an interior row only interior rows are eliminated, and no edge leads from one interior
/// into another: so no path of any length does, and interiors do not know of each other at any level of fill. Each is
/// eliminated and substituted by a thread of its own. So are separators, unless a kept block couples two of them: they
/// lie as far apart as chunks are long. A sweep over L and U has two points of synchronisation.
///
/// Rows whose diagonal is zero or next to it before the elimination (multipliers) have to stand behind their
/// neighbours, which give them one. If the constructor is told which they are, they go behind the last of these in
/// interiors whose rows descend, and to the separator with any of them.
///
/// In an order with a small bandwidth (reverse Cuthill-McKee) a separator has about as many rows as the bandwidth. The
/// factors depend on n_threads, but not on how many threads really run, and not on their timing.
class BlockIlu
{
public:
  /// Symbolic phase. Columns of @p graph from n_rows on (unknowns of other ranks) are left out, missing diagonals are
  /// added. @param block_size 1 to 4. @param fill_level at least 0. @param n_threads at least 1; may exceed the number
  /// of rows. @param deferred 1 for rows with a diagonal next to zero, shape=(n_rows) or empty: none. Throws
  /// InvalidParameter, DimensionMismatch.
  BlockIlu(const SparseGraph &graph, int block_size, int fill_level, int n_threads = 1,
           std::span<const char> deferred = {});

  int         n_rows() const { return static_cast<int>(order_.size()); }
  int         block_size() const { return block_size_; }
  int         fill_level() const { return fill_level_; }
  int         n_threads() const { return n_threads_; }
  std::size_t n_blocks() const { return lower_.columns.size() + upper_.columns.size(); }

  /// Rows of the graph in the order of elimination; ascending for one thread.
  std::span<const int> order() const { return order_; }

  /// Number of rows in all separators, the last ones in order().
  int n_separator_rows() const { return n_rows() - parts_[n_threads_]; }

  /// Positions in order() of the blocks kept in the row at position @p i, ascending.
  std::vector<int> row(int i) const;

  /// Numeric phase. @param values in the layout of Matrix::values() for the first rows of @p graph (the same as in the
  /// constructor), @param more_values those of the remaining rows, in the same layout counted from their first row.
  /// Throws DimensionMismatch, and NoConvergence if a diagonal block is singular or a factor is not finite.
  void factor(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values = {});

  /// x = U^-1 L^-1 b, shape=(n_rows * block_size); @p b and @p x may be the same array. Throws DimensionMismatch.
  void solve(std::span<const double> b, std::span<double> x);

  /// x = U^-1 L^-1 x.
  void solve(std::span<double> x) { solve(x, x); }

private:
  /// Blocks of one factor by rows; rows and columns are positions in order_.
  struct Triangle
  {
    std::vector<std::size_t> offsets; ///< of rows in columns and, times block_size^2, in values
    std::vector<int>         columns; ///< ascending in each row
    std::vector<float>       values;  ///< by rows in each block, with zeros after the last one to fill a register
  };
  /// What a thread needs to compute rows.
  struct Workspace;

  void cut(const SparseGraph &graph, std::span<const char> deferred);
  void find_pattern(const SparseGraph &graph);

  template <int block_size>
  void factor_blocks(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values);
  template <int block_size>
  std::string factor_part(int part, const SparseGraph &graph, std::span<const double> values,
                          std::span<const double> more_values, std::span<const int> positions, Workspace &workspace);
  template <int block_size>
  void solve_blocks(const double *b, double *x);
  template <int block_size>
  void sweep_forward(int part, const double *b);
  template <int block_size>
  void sweep_backward(int part, double *x);

  int                 block_size_, fill_level_, n_threads_;
  std::vector<int>    order_;                      ///< row of the graph at each position
  std::vector<int>    parts_;                      ///< first positions of n_threads interiors and as many separators
  bool                separators_coupled_ = false; ///< whether a kept block couples two separators
  Triangle            lower_, upper_;              ///< each row of upper_ begins with its inverted diagonal block
  std::vector<double> work_;                       ///< solution by positions, blocks padded to whole registers
};

} // namespace sherd
