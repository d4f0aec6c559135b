#pragma once

#include <array>
#include <cmath>

#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/surface.h>
#include <sherd/output/crack_tree.h>
#include <sherd/output/join_cracks.h>
#include <sherd/output/merge_bands.h>

namespace sherd
{

/// Sample lattice of one patch: n[0] x n[1] points at the centres of equal cells of its parameter rectangle.
struct SampleLattice
{
  std::array<int, 2>    n;
  std::array<double, 2> origin, spacing; ///< sample (i, j) has the parameters origin + ((i, j) + 1/2) spacing

  /// Parameters of a lattice point.
  std::array<double, 2> parameters(const Eigen::Vector2d &p) const
  {
    return {origin[0] + (p[0] + 0.5) * spacing[0], origin[1] + (p[1] + 0.5) * spacing[1]};
  }

  /// Index of the first sample at or behind a parameter value.
  int first_behind(int direction, double value) const
  {
    return static_cast<int>(std::ceil((value - origin[direction]) / spacing[direction] - 0.5));
  }
};

/// Lattice whose spacing on the reference surface is at most @p spacing everywhere. Each initial knot span, if these
/// are equal, is divided by a power of two, so that samples never lie on element edges.
template <int degree, int spacedim>
SampleLattice sample_lattice(const Patch<degree, spacedim> &patch, double spacing);

/// Samples of a patch where phi is below the threshold. Only elements with a control value below it are sampled.
/// @param phase   shape=(n_functions of the patch)
template <int degree, int spacedim, class Derived>
SampleGrid sample_broken_set(const Patch<degree, spacedim> &patch, const Eigen::MatrixBase<Derived> &phase,
                             const SampleLattice &lattice, double threshold);

/// Follows the cracks of a run: where they are, how long, how fast their tips.  theory L
///
/// The lattices are chosen once, four samples along the finest elements there will be, and do not change with the mesh;
/// so two steps differ by what the cracks did, not by how they were looked at. Feed every accepted step and none
/// that was rejected. Where a band ends is where phi = threshold on its axis: the tip is that point, and the length
/// includes the way to it. Sides of patches that no interface joins are edges of the body; cracks are joined across
/// interfaces (join_cracks), and along those that cut a band lengthwise (merge_bands).
/// A plain value: copy it to keep or restore it. Serial: runs where a complete phase field is.
class CrackTracker
{
public:
  /// @throws InvalidParameter   from validate(options)
  template <int degree, int spacedim>
  CrackTracker(const Surface<degree, spacedim> &surface, const CrackOptions &options);

  /// Takes an accepted step. @param phase   shape=(n_control_points)
  /// @throws DimensionMismatch   if the surface is not the one it was made for, or the phase does not fit it
  template <int degree, int spacedim>
  void update(const Surface<degree, spacedim> &surface, const Eigen::VectorXd &phase, double time);

  /// Goes on from a checkpoint: the next update() follows the step whose tree().state() this is.
  void restore(CrackTree::State state) { tree_ = CrackTree(options_, std::move(state)); }

  /// The cracks of the last step.
  const CrackGraph &cracks() const { return cracks_; }

  /// Length of all cracks of the last step [length].
  double length() const { return cracks_.length(); }

  /// Tips and branch points so far.
  const CrackTree &tree() const { return tree_; }

  const CrackOptions &options() const { return options_; }

private:
  std::vector<Eigen::Vector3d> branch_points() const;
  std::vector<int>             ends_inside() const;
  void join(PatchedCracks cracks, const std::vector<char> &self_joined, const std::vector<BrokenRun> &runs,
            const Pruning &pruning);

  CrackOptions                 options_;
  std::vector<SampleLattice>   lattices_;
  std::vector<Eigen::Vector3d> body_edge_; ///< points along the edge of the body, a sample apart
  CrackGraph                   cracks_;
  CrackTree                    tree_;
};

} // namespace sherd
