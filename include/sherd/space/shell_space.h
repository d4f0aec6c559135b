#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <sherd/base/environment.h>
#include <sherd/base/sparse_graph.h>
#include <sherd/geometry/interface_geometry.h>
#include <sherd/space/continuity.h>
#include <sherd/space/partition.h>

namespace sherd
{

/// Adjacency of the control points of a surface and its distribution over ranks, without degree or dimension.
///
/// Cells couple points: first the elements, then the pieces of interfaces. Behind the control points come the points of
/// multipliers, one for each piece if there are any.
struct SpaceTopology
{
  std::vector<int> offsets = {0}; ///< of points, shape=(n_cells + 1)
  std::vector<int> points; ///< of each cell: the control points of an element, in the order of its functions; those of
                           ///< the elements on both sides of a piece, then its multiplier
  int n_points      = 0;   ///< control points and multipliers
  int n_interfaces  = 0;   ///< pieces: the last cells
  int n_multipliers = 0;   ///< 0 or n_interfaces: the last points

  int n_cells() const { return static_cast<int>(offsets.size()) - 1; }
  int n_elements() const { return n_cells() - n_interfaces; }
  int n_control_points() const { return n_points - n_multipliers; }
};

/// What one rank works on.
///
/// Every rank knows the whole topology; what carries unknowns is distributed. A rank owns some points and integrates
/// every element and every piece of an interface on which one of them acts ("active"), so that it fills all of its
/// matrix rows and its part of the residual alone, without exchanging contributions. A cell on the border between ranks
/// is active on each of them; exactly one of them, its owner, counts its energy and keeps its history when these are
/// gathered.
///
/// Local numbering of points: the owned ones in reverse Cuthill-McKee order, a multiplier directly behind the last of
/// its control points, then the ghosts ascending. A multiplier belongs to the rank with most of its control points.
/// Active elements are ordered by their first local point, so that neighbours in memory are neighbours in space, and so
/// are active pieces.
struct SpaceDistribution
{
  std::vector<std::int64_t> owned;             ///< surface ids of the owned points, local 0, 1, ...
  std::vector<std::int64_t> ghosts;            ///< surface ids of the others needed, local n_owned, ...
  std::vector<int>          elements;          ///< active elements, surface ids
  std::vector<char>         owns;              ///< 1 if this rank owns the active element, shape=(n_active)
  std::vector<int>          element_offsets;   ///< of element_points, shape=(n_active + 1)
  std::vector<int>          element_points;    ///< local points, in the order of SpaceTopology::points
  std::vector<int>          interfaces;        ///< active pieces, indices into those of the space
  std::vector<char>         owns_interface;    ///< 1 if this rank owns the active piece, shape=(n_active pieces)
  std::vector<int>          interface_offsets; ///< of interface_points, shape=(n_active pieces + 1)
  std::vector<int>          interface_points;  ///< local points, in the order of SpaceTopology::points
  SparseGraph               graph;             ///< rows: owned, columns: local points, ascending
  std::vector<int>          local;             ///< local number of a surface id, or -1, shape=(n_points)
  std::vector<int>          element_owner;     ///< rank of every element of the surface, shape=(n_elements)
};

/// Part of each vertex of a graph, in [0, n_parts), as partition() gives it or by a rule of the caller: the same on all
/// ranks for the same arguments. Parts may be empty.
using Partitioner =
    std::function<std::vector<int>(const SparseGraph &graph, std::span<const int> weights, int n_parts)>;

/// Partitions the control points by what they cost (share of the cells, row of the matrix), orders those of rank
/// @p rank and lists its cells. Deterministic, the same on all ranks up to @p rank. Not collective: every rank computes
/// the partition itself.
/// @param partitioner   sees the control points alone; multipliers follow them
/// @throws InvalidParameter, DimensionMismatch   a @p partitioner that names a rank there is not, or not for all points
SpaceDistribution distribute(const SpaceTopology &topology, int n_ranks, int rank,
                             const Partitioner &partitioner = partition);

/// Numbering of the unknowns of a shell: spacedim displacements and one phase value a control point, and those of the
/// continuity across interfaces.
///
/// Points 0 ... n_control_points - 1 are the control points of the surface; behind them comes, with
/// continuity::LagrangeMultiplier, one point for each piece of an interface. Such a point has a block of n_fields
/// entries as well: entry 0 is the multiplier q of the angle (in the plane there is none), entry spacedim that of the
/// phase, the others are not used.
template <int degree, int spacedim>
class ShellSpace
{
public:
  static constexpr int n_fields = fields_per_point<spacedim>;

  /// @p surface has to outlive the space. Rebuild after each refinement.
  ShellSpace(const Environment &env, const Surface<degree, spacedim> &surface,
             Continuity continuity = continuity::Penalty(), Partitioner partitioner = partition)
      : env_(env), surface_(&surface), continuity_(continuity), partitioner_(std::move(partitioner))
  {
    rebuild();
  }

  /// Numbers anew: the surface has changed.
  void rebuild()
  {
    pieces_.clear();
    if (!std::holds_alternative<continuity::None>(continuity_))
      pieces_ = sherd::interface_pieces(*surface_);
    distribution_ = distribute(topology(), env_.n_ranks(), env_.rank(), partitioner_);
  }

  const Environment               &environment() const { return env_; }
  const Surface<degree, spacedim> &surface() const { return *surface_; }
  const Continuity                &continuity() const { return continuity_; }
  const SpaceDistribution         &distribution() const { return distribution_; }

  /// The pieces of all interfaces along which the continuity is kept, none with continuity::None.
  const std::vector<InterfacePiece> &interface_pieces() const { return pieces_; }

  int n_control_points() const { return surface_->n_control_points(); }
  int n_multipliers() const { return has_multipliers() ? static_cast<int>(pieces_.size()) : 0; }
  int n_points() const { return n_control_points() + n_multipliers(); }

  bool has_multipliers() const { return std::holds_alternative<continuity::LagrangeMultiplier>(continuity_); }
  bool is_multiplier(std::int64_t point) const { return point >= n_control_points(); }

  /// Unknowns of control points and multipliers.
  int n_unknowns() const { return n_fields * n_control_points() + (spacedim == 2 ? 1 : 2) * n_multipliers(); }

  int n_active_elements() const { return static_cast<int>(distribution_.elements.size()); }
  int n_active_interfaces() const { return static_cast<int>(distribution_.interfaces.size()); }

  /// Local control points of an active element.
  std::span<const int> points_of(int active) const
  {
    const auto &d = distribution_;
    return {d.element_points.data() + d.element_offsets[active],
            d.element_points.data() + d.element_offsets[active + 1]};
  }

  /// Local points of an active piece of an interface: the control points of the element on its first side, of that on
  /// its second side (InterfaceGeometry::sides; shared ones in both), its multiplier if there are any.
  std::span<const int> points_of_interface(int active) const
  {
    const auto &d = distribution_;
    return {d.interface_points.data() + d.interface_offsets[active],
            d.interface_points.data() + d.interface_offsets[active + 1]};
  }

  /// The cells that couple the points.
  SpaceTopology topology() const
  {
    SpaceTopology topology;
    topology.n_points      = n_points();
    topology.n_interfaces  = static_cast<int>(pieces_.size());
    topology.n_multipliers = n_multipliers();
    const auto add_points  = [&](int element) {
      const auto [p, local] = surface_->locate_element(element);
      for (const int i : surface_->patch(p).basis.functions_of(local))
        topology.points.push_back(surface_->point(p, i));
    };
    for (int e = 0; e < surface_->n_elements(); ++e)
      {
        add_points(e);
        topology.offsets.push_back(static_cast<int>(topology.points.size()));
      }
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      {
        add_points(pieces_[k].elements[0]);
        add_points(pieces_[k].elements[1]);
        if (has_multipliers())
          topology.points.push_back(n_control_points() + static_cast<int>(k));
        topology.offsets.push_back(static_cast<int>(topology.points.size()));
      }
    return topology;
  }

private:
  Environment                      env_;
  const Surface<degree, spacedim> *surface_;
  Continuity                       continuity_;
  Partitioner                      partitioner_;
  std::vector<InterfacePiece>      pieces_;
  SpaceDistribution                distribution_;
};

} // namespace sherd
