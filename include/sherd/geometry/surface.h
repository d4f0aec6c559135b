#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <sherd/geometry/interface.h>

namespace sherd
{

/// What a refinement of a surface did, in the surface's own numbering.
struct SurfaceRefinement
{
  SparseTransfer   transfer; ///< control values: c_new = T c_old
  std::vector<int> parent;   ///< parent[e_new] = old element that contains it
};

/// Reference surface: patches, interfaces along which they are joined, and names for some of their sides.
///
/// Numbering: control points patch by patch in the order of their functions, those that patches share once, with the
/// first patch that has them; elements patch by patch. A corner in which any number of joined patches meet is one
/// control point. Shared control points are bitwise equal on all their patches.
/// Source: theory H.6.
template <int degree, int spacedim>
class Surface
{
public:
  using PatchType = Patch<degree, spacedim>;

  /// @throws DimensionMismatch, InvalidParameter   from validate(patch)
  /// @throws InvalidParameter   an edge on a patch that does not exist; an interface whose sides have not the same
  ///                            knots, weights and control points along it, or a side in more than one interface
  Surface(std::vector<PatchType> patches, std::map<std::string, std::vector<Edge>> edges,
          std::vector<Interface> interfaces = {});

  int              n_patches() const { return static_cast<int>(patches_.size()); }
  const PatchType &patch(int p) const { return patches_[p]; }
  int              n_control_points() const { return static_cast<int>(location_offsets_.size()) - 1; }
  int              n_elements() const { return element_offset_.back(); }
  int              element_offset(int p) const { return element_offset_[p]; }

  /// Control point of a function of patch @p p.
  int point(int p, int function) const { return points_[p][function]; }

  /// Control points of all functions of patch @p p, in their order; the two ends of a patch that is joined to itself
  /// name the same ones.
  std::span<const int> points_of_patch(int p) const { return points_[p]; }

  struct Location
  {
    int patch, local;
  };

  /// Patch and local number of an element.
  Location locate_element(int element) const;

  /// Patch and function of a control point: the first of locations_of(point).
  Location locate_point(int point) const { return locations_[location_offsets_[point]]; }

  /// All patches and functions of a control point, ascending.
  std::span<const Location> locations_of(int point) const
  {
    return {locations_.data() + location_offsets_[point], locations_.data() + location_offsets_[point + 1]};
  }

  const std::map<std::string, std::vector<Edge>> &edges() const { return edges_; }
  const std::vector<Interface>                   &interfaces() const { return interfaces_; }

  /// Sides that carry this name. @throws InvalidParameter with the names there are
  const std::vector<Edge> &edge(const std::string &name) const;

  /// All control points X, shape=(n_control_points, spacedim), and their weights.
  ControlValues<spacedim> control_points() const;
  Eigen::VectorXd         weights() const;

  /// Refines around the marked control points down to @p target, by the structured mesh strategy (theory H.4), a shared
  /// one in all of its patches, and goes on across interfaces until both sides of each carry the same functions
  /// (theory H.6). Exact: the surface and every field on it stay the same functions.
  /// @throws Error   if the refined functions are linearly dependent, which structured refinement has not been seen to
  ///                 do, or the sides of an interface do not come to agree
  /// @throws InvalidParameter   a control point that does not exist, a target that is not positive
  SurfaceRefinement refine(const std::vector<int> &points, const SpanTarget &target);

  /// The same with a target for each patch, shape=(n_patches).
  SurfaceRefinement refine_to(const std::vector<int> &points, const std::vector<SpanTarget> &targets);

private:
  void     number();
  void     equalise();
  Location source_of(int point) const; ///< whose values all patches of the control point get

  std::vector<PatchType>                   patches_;
  std::map<std::string, std::vector<Edge>> edges_;
  std::vector<Interface>                   interfaces_;
  std::vector<int>                         element_offset_;
  std::vector<char>             polynomial_; ///< patches whose weights are one number: they stay so, bit by bit
  std::vector<std::vector<int>> points_;     ///< by patch and function
  std::vector<int>              location_offsets_;
  std::vector<Location>         locations_;
};

/// Interfaces between all sides of @p patches that coincide: the same knots along them, weights and control points, to
/// rounding, in either direction. Sides that are one point, such as poles, are left out.
/// @throws InvalidParameter   more than two sides that coincide
template <int degree, int spacedim>
std::vector<Interface> find_interfaces(const std::vector<Patch<degree, spacedim>> &patches);

/// Elements that touch a side of a patch, as surface elements, in the order of the parameter along the side.
template <int degree, int spacedim>
std::vector<int> elements_along(const Surface<degree, spacedim> &surface, const Edge &edge);

/// Control points whose function does not vanish on a side, in the order of the parameter along the side.
template <int degree, int spacedim>
std::vector<int> points_along(const Surface<degree, spacedim> &surface, const Edge &edge);

/// Control points whose function vanishes on a side but whose derivative across it does not: the second row, in the
/// order of the parameter along the side. After local refinement it need not have as many as the first (points_along).
/// These two rows alone decide position and tangent plane of a surface along its side.
template <int degree, int spacedim>
std::vector<int> second_row_along(const Surface<degree, spacedim> &surface, const Edge &edge);

} // namespace sherd

#include <sherd/geometry/surface.templates.h>

#define SHERD_EXTERN(degree, spacedim)                                                                                 \
  extern template class Surface<degree, spacedim>;                                                                     \
  extern template std::vector<int>       elements_along(const Surface<degree, spacedim> &, const Edge &);              \
  extern template std::vector<int>       points_along(const Surface<degree, spacedim> &, const Edge &);                \
  extern template std::vector<Interface> find_interfaces(const std::vector<Patch<degree, spacedim>> &);
namespace sherd
{
SHERD_EXTERN(2, 2)
SHERD_EXTERN(3, 2)
SHERD_EXTERN(4, 2)
SHERD_EXTERN(2, 3)
SHERD_EXTERN(3, 3)
SHERD_EXTERN(4, 3)
} // namespace sherd
#undef SHERD_EXTERN
