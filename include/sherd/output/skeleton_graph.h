#pragma once

#include <array>
#include <span>
#include <vector>

#include <sherd/output/sample_grid.h>

namespace sherd
{

/// A thinned set of samples as nodes and the arms between them.
struct SkeletonGraph
{
  /// Nodes: an end is one sample of degree 1, a branch point the connected samples of degree 3 and more, a dot one
  /// sample without neighbours.
  std::vector<std::vector<Sample>> nodes;

  struct Arm
  {
    std::array<int, 2>  nodes;   ///< {-1, -1}: a closed loop without nodes
    std::vector<Sample> samples; ///< from the first node to the second, those of nodes excluded
  };
  std::vector<Arm> arms;
};

/// Nodes and arms of what thin() returns. Deterministic: nodes and arms in the order of their first sample.
SkeletonGraph skeleton_graph(std::span<const Sample> skeleton);

} // namespace sherd
