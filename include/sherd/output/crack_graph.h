#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <sherd/output/sample_grid.h>

namespace sherd
{

/// What the geometry of cracks needs to know of one patch. A lattice point is (i, j), not necessarily integer; sample
/// (i, j) is its own lattice point.
struct LatticeField
{
  std::function<Eigen::Vector3d(const Eigen::Vector2d &)> position; ///< X on the reference surface (z = 0 in the plane)
  std::function<double(const Eigen::Vector2d &)>          phase;    ///< phi; 1 or more outside the patch
  double                                                  threshold; ///< broken where phi is below
};

/// A point of the centre line of a crack.
struct CrackPoint
{
  Eigen::Vector2d lattice;
  Eigen::Vector3d X;
};

/// The cracks as centre lines: a graph of ends, branch points and smooth arms on the reference surface.
///
/// Coordinates in the lattice belong to a patch. Everything after construction uses positions X, so graphs of several
/// patches are joined by append() and by identifying nodes.
struct CrackGraph
{
  struct Node
  {
    CrackPoint point;
    int        degree = 0; ///< 1: an end, 3 and more: a branch point
  };

  struct Arm
  {
    std::array<int, 2>           nodes;  ///< {-1, -1}: a closed loop without nodes
    std::vector<Eigen::Vector3d> points; ///< from node to node, both included; a loop repeats its first point
    double                       length; ///< arc length of points
  };

  std::vector<Node> nodes;
  std::vector<Arm>  arms;

  /// Sum of the lengths of all arms.
  double length() const;

  /// Adds the nodes and arms of another graph behind the own ones.
  void append(CrackGraph other);
};

/// Which arms are noise. Branch points that counted before keep counting down to a smaller limit, so that one does not
/// come and go with the rounding of a length. An arm that an interface cuts off is judged as a whole, when it is joined
/// (join_cracks); its piece in a patch has the smaller limit.
struct Pruning
{
  double limit;        ///< shorter side arms and loops are removed, shorter bridges contracted
  double known_limit;  ///< for side arms of a known branch point, and for pieces
  double known_radius; ///< how far from its old place a known branch point may be, and the end
                       ///< of a piece from the cut
  std::span<const Eigen::Vector3d> known_branch_points;
  std::span<const Eigen::Vector3d> cut_points; ///< on interfaces, broken

  /// Whether an arm that ends at @p X may go on behind an interface.
  bool is_cut(const Eigen::Vector3d &X) const { return is_near(X, cut_points); }

  /// Limit for a side arm of the branch point @p X.
  double side_arm_limit(const Eigen::Vector3d &X) const
  {
    return is_near(X, known_branch_points) ? known_limit : limit;
  }

private:
  bool is_near(const Eigen::Vector3d &X, std::span<const Eigen::Vector3d> points) const
  {
    return std::any_of(points.begin(), points.end(), [&](const auto &Y) { return (X - Y).norm() < known_radius; });
  }
};

/// Centre lines of a broken set.  theory L
///
/// 1. The set is thinned and traced.
/// 2. Every fourth sample of the skeleton is moved along the normal of the skeleton to the centre of the band, weighted
///    with the depth of the samples: no staircase, and mirror images have mirrored lines however the thinning broke the
///    tie.
/// 3. Side arms shorter than the limit are removed, the shortest first; where two arms are left of a branch point they
///    become one. Short loops are removed, bridges between branch points shorter than the limit contracted: lines that
///    cross at a small angle meet in one point. An arm with two ends is never removed, however short.
/// 4. A branch point is the point closest to the lines of its arms. An end lies where phi reaches the threshold on the
///    straight continuation of its arm, or where that leaves the patch. A spot without a skeleton of its own gets its
///    principal axis.
CrackGraph crack_graph(const SampleGrid &grid, const LatticeField &field, const Pruning &pruning);

/// Shortest ways along the arms from one node.
struct ShortestPaths
{
  std::vector<double> distance; ///< to each node; infinite where there is no way
  std::vector<int>    arm;      ///< the last arm of the way to each node; -1 at the start and where there is none
};
ShortestPaths shortest_paths(const CrackGraph &graph, int start);

} // namespace sherd
