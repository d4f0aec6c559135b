#pragma once

#include <cassert>
#include <span>
#include <vector>

namespace sherd
{

/// Graph in compressed rows. The neighbours of vertex i, ascending and each named once, are
/// columns[offsets[i]], ..., columns[offsets[i + 1] - 1].
struct SparseGraph
{
  std::vector<int> offsets = {0}; ///< shape=(n_rows + 1), starts with 0, never decreases
  std::vector<int> columns;       ///< shape=(offsets.back())

  int n_rows() const { return static_cast<int>(offsets.size()) - 1; }

  /// Neighbours of vertex @p i, ascending.
  std::span<const int> row(int i) const
  {
    assert(i >= 0 && i < n_rows());
    return {columns.data() + offsets[i], columns.data() + offsets[i + 1]};
  }
};

} // namespace sherd
