#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <sherd/base/environment.h>
#include <sherd/base/sparse_graph.h>
#include <sherd/geometry/surface.h>
#include <sherd/space/partition.h>

namespace sherd
{

/// Adjacency of the control points of a surface and its distribution over ranks, without degree or dimension.
struct SpaceTopology
{
  std::vector<int> offsets = {0}; ///< of points, shape=(n_elements + 1)
  std::vector<int> points;        ///< control points of each element, ascending
  int              n_points = 0;
};

/// What one rank works on.
///
/// Every rank knows the whole topology; what carries unknowns is distributed. A rank owns some control points and
/// integrates every element on which one of them acts ("active"), so that it fills all of its matrix rows and its part
/// of the residual alone, without exchanging contributions. An element on the border between ranks is active on each
/// of them; exactly one of them, its owner, counts its energy and keeps its history when these are gathered.
///
/// Local numbering of control points: the owned ones in reverse Cuthill-McKee order, then the ghosts ascending.
/// Active elements are ordered by their first local control point, so that neighbours in memory are neighbours in
/// space.
struct SpaceDistribution
{
  std::vector<std::int64_t> owned;           ///< surface ids of the owned control points, local 0, 1, ...
  std::vector<std::int64_t> ghosts;          ///< surface ids of the others needed, local n_owned, ...
  std::vector<int>          elements;        ///< active elements, surface ids
  std::vector<char>         owns;            ///< 1 if this rank owns the active element, shape=(n_active)
  std::vector<int>          element_offsets; ///< of element_points, shape=(n_active + 1)
  std::vector<int>          element_points;  ///< local control points, in the order of SpaceTopology::points
  SparseGraph               graph;           ///< rows: owned, columns: local control points, ascending
  std::vector<int>          local;           ///< local number of a surface id, or -1, shape=(n_points)
  std::vector<int>          element_owner;   ///< rank of every element of the surface, shape=(n_elements)
};

/// Part of each vertex of a graph, in [0, n_parts), as partition() gives it or by a rule of the caller: the same on all
/// ranks for the same arguments. Parts may be empty.
using Partitioner =
    std::function<std::vector<int>(const SparseGraph &graph, std::span<const int> weights, int n_parts)>;

/// Partitions the control points by what they cost (share of the elements, row of the matrix), orders those of rank
/// @p rank and lists its elements. Deterministic, the same on all ranks up to @p rank. Not collective: every rank
/// computes the partition itself.
/// @throws InvalidParameter, DimensionMismatch   a @p partitioner that names a rank there is not, or not for all points
SpaceDistribution distribute(const SpaceTopology &topology, int n_ranks, int rank,
                             const Partitioner &partitioner = partition);

/// Numbering of the unknowns of a shell: spacedim displacements and one phase value a control point.
template <int degree, int spacedim>
class ShellSpace
{
public:
  static constexpr int n_fields = fields_per_point<spacedim>;

  /// @p surface has to outlive the space. Rebuild after each refinement.
  ShellSpace(const Environment &env, const Surface<degree, spacedim> &surface, Partitioner partitioner = partition)
      : env_(env), surface_(&surface), partitioner_(std::move(partitioner))
  {
    rebuild();
  }

  /// Numbers anew: the surface has changed.
  void rebuild()
  {
    SpaceTopology topology;
    topology.n_points = surface_->n_control_points();
    for (int p = 0; p < surface_->n_patches(); ++p)
      {
        const auto &basis = surface_->patch(p).basis;
        for (int e = 0; e < basis.n_elements(); ++e)
          {
            for (const int i : basis.functions_of(e))
              topology.points.push_back(surface_->point_offset(p) + i);
            topology.offsets.push_back(static_cast<int>(topology.points.size()));
          }
      }
    distribution_ = distribute(topology, env_.n_ranks(), env_.rank(), partitioner_);
  }

  const Environment               &environment() const { return env_; }
  const Surface<degree, spacedim> &surface() const { return *surface_; }
  const SpaceDistribution         &distribution() const { return distribution_; }

  int n_unknowns() const { return n_fields * surface_->n_control_points(); }
  int n_active_elements() const { return static_cast<int>(distribution_.elements.size()); }

  /// Local control points of an active element.
  std::span<const int> points_of(int active) const
  {
    const auto &d = distribution_;
    return {d.element_points.data() + d.element_offsets[active],
            d.element_points.data() + d.element_offsets[active + 1]};
  }

private:
  Environment                      env_;
  const Surface<degree, spacedim> *surface_;
  Partitioner                      partitioner_;
  SpaceDistribution                distribution_;
};

} // namespace sherd
