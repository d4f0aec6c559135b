#pragma once

#include <array>
#include <vector>

#include <sherd/output/crack_graph.h>

namespace sherd
{

/// A stretch of an interface on which phi is below the threshold.
struct BrokenRun
{
  std::array<int, 2>           patches; ///< on its first and second side
  std::vector<Eigen::Vector3d> points;  ///< along the interface, a sample apart
  Eigen::Vector3d              across;  ///< from the first side to the second, at the middle of the run
};

/// The cracks of all patches, and where they come from.
struct PatchedCracks
{
  CrackGraph       graph;
  std::vector<int> patch_of_node; ///< -1: on an interface, of both patches
  std::vector<int> patch_of_arm;  ///< -1: at least in part on an interface

  /// Adds the cracks of one patch.
  void append(CrackGraph cracks, int patch)
  {
    graph.append(std::move(cracks));
    patch_of_node.resize(graph.nodes.size(), patch);
    patch_of_arm.resize(graph.arms.size(), patch);
  }
};

/// Makes one line of the two that the patches on both sides of an interface see where it cuts a band lengthwise.
/// theory L
///
/// An interface cuts a band lengthwise along a run longer than 3.5 l0 (which a straight crack crosses at less than
/// 18 degrees) as far as both sides have a centre line within l0 of it. With the distances c_1, c_2 of these two lines
/// from the interface, each in the middle of its part of the band, the middle of the band is c_1 - c_2 away, on the
/// side of the larger. That line takes the place of both; arms that leave it start there. Then side arms and loops that
/// start from it and are shorter than the limit are removed, and shorter bridges from it contracted, as in one patch:
/// in a corner of several patches the lines along its interfaces meet in one point.
void merge_bands(PatchedCracks &cracks, const std::vector<BrokenRun> &runs, double length_scale,
                 const Pruning &pruning);

} // namespace sherd
