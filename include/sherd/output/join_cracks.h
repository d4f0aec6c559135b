#pragma once

#include <vector>

#include <sherd/output/crack_graph.h>

namespace sherd
{

/// An end of the cracks of one patch where an interface cuts them off.
struct CutEnd
{
  int node;     ///< of the graph
  int patch;    ///< that it comes from; -1: it lies on an interface
  int crossing; ///< connected part of the broken set on the interfaces at which it ends
};

/// Distances that decide what belongs together across interfaces [length].
struct JoinDistances
{
  double reach; ///< ends of one crossing this close are one crack; an end that finds no other belongs to an arm of
                ///< another patch this close
  double trim;  ///< so far from an interface a band is cut obliquely and its centre line is not reliable
};

/// Numbers the connected parts of a set of points: those closer than @p distance to each other belong together.
std::vector<int> connected_parts(const std::vector<Eigen::Vector3d> &points, double distance);

/// Joins cracks that interfaces cut.  theory L
///
/// Pairs of ends of one crossing and different patches are joined, the closest first: both arms are cut back by the
/// trim, at most by half their length, and continue each other in a straight line. A piece that is not joined at a
/// crossing branches there from the closest arm of another patch, as where side arms too short to count in their patch go
/// on in the next. All other ends stay ends: those on an interface, and the tips of pieces so short that both of their
/// ends are at one crossing. Then side arms and bridges between branch points
/// that were cut by interfaces are noise, by the same limits as those inside of a patch.
/// @param patch_of_arm   shape=(n_arms); -1: at least in part on an interface
/// @param self_joined    1 for each patch that is joined to itself; its ends may be joined with each other
void join_cracks(CrackGraph &graph, const std::vector<int> &patch_of_arm, const std::vector<CutEnd> &ends,
                 const std::vector<char> &self_joined, const JoinDistances &distances, const Pruning &pruning);

} // namespace sherd
