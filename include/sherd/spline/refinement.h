#pragma once

#include <array>
#include <vector>

#include <sherd/spline/sparse_transfer.h>

namespace sherd
{

/// Span lengths of the parameter domain above which refinement halves a knot span.
struct SpanTarget
{
  /// (u, v), positive. A span counts as longer only beyond a relative slack of 1e-10, so that a target computed as the
  /// length of a bisected span is met by that span.
  std::array<double, 2> length;
};

/// What a refinement did to the numbering and to control data.
struct Refinement
{
  SparseTransfer   transfer; ///< c_new = T c_old
  std::vector<int> parent;   ///< parent[new element] = old element that contains it; non-decreasing
};

/// The refinement @p first followed by @p second as one.
Refinement compose(const Refinement &second, const Refinement &first);

} // namespace sherd
