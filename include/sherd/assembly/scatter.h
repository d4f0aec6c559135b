#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/space/shell_space.h>

namespace sherd
{

/// A run of owned block rows and the active elements that reach them. One thread fills one range and no other writes to
/// its rows, so the sums do not depend on the number of threads; elements on the border are integrated twice.
struct RowRange
{
  int              begin, end; ///< owned block rows [begin, end)
  std::vector<int> elements;   ///< active elements with a control point among them, ascending
};

/// Splits the owned rows into @p n_ranges runs of about equal work.
std::vector<RowRange> row_ranges(const SpaceDistribution &space, int n_ranges);

/// Where the blocks of every active element lie in the matrix rows, computed once a mesh.
class ScatterMap
{
public:
  explicit ScatterMap(const SpaceDistribution &space);

  /// Position, in units of blocks, of the block (A, B) of an element in the row of its control point A; row-major,
  /// shape=(n, n) with n control points. Rows of ghosts are not set.
  std::span<const int> positions(int active) const
  {
    return {positions_.data() + offsets_[active], positions_.data() + offsets_[active + 1]};
  }

private:
  std::vector<std::size_t> offsets_;
  std::vector<int>         positions_;
};

} // namespace sherd
