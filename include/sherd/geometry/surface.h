#pragma once

#include <map>
#include <string>
#include <vector>

#include <sherd/geometry/patch.h>

namespace sherd
{

/// One side of one patch.
struct Edge
{
  int  patch;
  Side side;
};

/// What a refinement of a surface did, in the surface's own numbering.
struct SurfaceRefinement
{
  SparseTransfer   transfer; ///< control values: c_new = T c_old
  std::vector<int> parent;   ///< parent[e_new] = old element that contains it
};

/// Reference surface: patches, and names for some of their sides.
///
/// Numbering: control point id = offset of its patch + index of its function, element id alike, patches in order.
template <int degree, int spacedim>
class Surface
{
public:
  using PatchType = Patch<degree, spacedim>;

  /// @throws DimensionMismatch, InvalidParameter   from validate(patch)
  /// @throws InvalidParameter                      a named edge on a patch that does not exist
  Surface(std::vector<PatchType> patches, std::map<std::string, std::vector<Edge>> edges);

  int              n_patches() const { return static_cast<int>(patches_.size()); }
  const PatchType &patch(int p) const { return patches_[p]; }
  int              n_control_points() const { return point_offset_.back(); }
  int              n_elements() const { return element_offset_.back(); }
  int              point_offset(int p) const { return point_offset_[p]; }
  int              element_offset(int p) const { return element_offset_[p]; }

  struct Location
  {
    int patch, local;
  };

  /// Patch and local number of an element.
  Location locate_element(int element) const { return locate(element_offset_, element); }

  /// Patch and local number of a control point.
  Location locate_point(int point) const { return locate(point_offset_, point); }

  const std::map<std::string, std::vector<Edge>> &edges() const { return edges_; }

  /// Sides that carry this name. @throws InvalidParameter with the names there are
  const std::vector<Edge> &edge(const std::string &name) const;

  /// All control points X, shape=(n_control_points, spacedim), and their weights.
  ControlValues<spacedim> control_points() const;
  Eigen::VectorXd         weights() const;

  /// Refines around the marked control points down to @p target, by the structured mesh strategy (theory H.4).
  /// Exact: the surface and every field on it stay the same functions.
  /// @throws Error   if the refined functions are linearly dependent, which structured refinement has not been seen to
  /// do
  /// @throws InvalidParameter   a control point that does not exist, a target that is not positive
  SurfaceRefinement refine(const std::vector<int> &points, const SpanTarget &target);

private:
  static Location locate(const std::vector<int> &offsets, int i);
  void            number();

  std::vector<PatchType>                   patches_;
  std::map<std::string, std::vector<Edge>> edges_;
  std::vector<int>                         point_offset_, element_offset_;
};

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
  extern template std::vector<int> elements_along(const Surface<degree, spacedim> &, const Edge &);                    \
  extern template std::vector<int> points_along(const Surface<degree, spacedim> &, const Edge &);
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
