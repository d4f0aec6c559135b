#pragma once

#include <sherd/output/crack_graph.h>
#include <sherd/output/skeleton_graph.h>

namespace sherd
{

/// A centre line as it comes from the skeleton: right between nodes, not yet at them.
struct RawCracks
{
  struct Node
  {
    CrackPoint point;
    int        degree = 0; ///< 0: a dot, or a node that is no longer in use
    bool       in_use = true;
  };

  struct CentrePoint
  {
    CrackPoint point;
    double     half_width; ///< of the band, in samples
  };

  struct Arm
  {
    std::array<int, 2>       nodes;
    std::vector<CentrePoint> points; ///< from the first node to the second, without them

    bool is_loop() const { return nodes[0] < 0; }
    int  other(int node) const { return nodes[0] == node ? nodes[1] : nodes[0]; }
  };

  std::vector<Node> nodes;
  std::vector<Arm>  arms;

  /// Positions from node to node.
  std::vector<CrackPoint> path(const Arm &arm) const;

  /// Arc length from node to node; at an end the half width of the band is added, by which the skeleton is short.
  double length(const Arm &arm) const;
};

/// Steps 1 and 2 of crack_graph().
RawCracks raw_cracks(const SampleGrid &grid, const LatticeField &field);

/// Step 3 of crack_graph().
void prune(RawCracks &cracks, const LatticeField &field, const Pruning &pruning);

} // namespace sherd
