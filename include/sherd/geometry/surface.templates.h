#pragma once

#include <algorithm>
#include <limits>
#include <numeric>

#include <sherd/geometry/surface.h>
#include <sherd/spline/independence.h>

namespace sherd
{

template <int degree, int spacedim>
Surface<degree, spacedim>::Surface(std::vector<PatchType> patches, std::map<std::string, std::vector<Edge>> edges)
    : patches_(std::move(patches)), edges_(std::move(edges))
{
  for (const auto &patch : patches_)
    validate(patch);
  for (const auto &[name, sides] : edges_)
    for (const auto &edge : sides)
      if (edge.patch < 0 || edge.patch >= n_patches())
        throw InvalidParameter("surface: edge \"" + name + "\" lies on patch " + std::to_string(edge.patch) +
                               ", but the surface has " + std::to_string(n_patches()) + " patches");
  number();
}

template <int degree, int spacedim>
void Surface<degree, spacedim>::number()
{
  point_offset_.assign(1, 0);
  element_offset_.assign(1, 0);
  for (const auto &patch : patches_)
    {
      point_offset_.push_back(point_offset_.back() + patch.basis.n_functions());
      element_offset_.push_back(element_offset_.back() + patch.basis.n_elements());
    }
}

template <int degree, int spacedim>
typename Surface<degree, spacedim>::Location Surface<degree, spacedim>::locate(const std::vector<int> &offsets, int i)
{
  const int p = static_cast<int>(std::upper_bound(offsets.begin(), offsets.end(), i) - offsets.begin()) - 1;
  return {p, i - offsets[p]};
}

template <int degree, int spacedim>
const std::vector<Edge> &Surface<degree, spacedim>::edge(const std::string &name) const
{
  const auto found = edges_.find(name);
  if (found == edges_.end())
    {
      std::string names;
      for (const auto &entry : edges_)
        names += (names.empty() ? "" : ", ") + entry.first;
      throw InvalidParameter("surface: there is no edge \"" + name + "\"; its edges are " + names);
    }
  return found->second;
}

template <int degree, int spacedim>
ControlValues<spacedim> Surface<degree, spacedim>::control_points() const
{
  ControlValues<spacedim> all(n_control_points(), spacedim);
  for (int p = 0; p < n_patches(); ++p)
    all.middleRows(point_offset_[p], patches_[p].control_points.rows()) = patches_[p].control_points;
  return all;
}

template <int degree, int spacedim>
Eigen::VectorXd Surface<degree, spacedim>::weights() const
{
  Eigen::VectorXd all(n_control_points());
  for (int p = 0; p < n_patches(); ++p)
    all.segment(point_offset_[p], patches_[p].weights.size()) = patches_[p].weights;
  return all;
}

template <int degree, int spacedim>
SurfaceRefinement Surface<degree, spacedim>::refine(const std::vector<int> &points, const SpanTarget &target)
{
  std::vector<std::vector<int>> marked(patches_.size());
  for (const int point : points)
    {
      if (point < 0 || point >= n_control_points())
        throw InvalidParameter("surface: control point " + std::to_string(point) +
                               " was marked for refinement, expected 0 to " + std::to_string(n_control_points() - 1));
      const auto [p, local] = locate_point(point);
      marked[p].push_back(local);
    }
  SurfaceRefinement result;
  result.transfer.offsets.assign(1, 0);
  for (int p = 0; p < n_patches(); ++p)
    {
      auto      &patch     = patches_[p];
      auto       refined   = patch.basis.refine(marked[p], target);
      const auto transfer  = rational_transfer(std::move(refined.transfer), patch.weights);
      patch.control_points = transfer.apply(patch.control_points);
      for (int i = 0; i < transfer.n_rows(); ++i)
        {
          for (int k = transfer.offsets[i]; k < transfer.offsets[i + 1]; ++k)
            {
              result.transfer.columns.push_back(point_offset_[p] + transfer.columns[k]);
              result.transfer.values.push_back(transfer.values[k]);
            }
          result.transfer.offsets.push_back(static_cast<int>(result.transfer.columns.size()));
        }
      for (const int parent : refined.parent)
        result.parent.push_back(element_offset_[p] + parent);
    }
  for (int p = 0; p < n_patches(); ++p)
    if (const auto check = check_independence(patches_[p].basis); !check.independent())
      throw Error("surface: refinement made " + std::to_string(check.dependent.size()) + " functions of patch " +
                  std::to_string(p) + " linearly dependent; refine a wider neighbourhood (theory H.5)");
  number();
  return result;
}

namespace internal
{
inline int normal_direction(Side side)
{
  return side == Side::u_min || side == Side::u_max ? 0 : 1;
}
inline bool at_maximum(Side side)
{
  return side == Side::u_max || side == Side::v_max;
}
} // namespace internal

template <int degree, int spacedim>
std::vector<int> elements_along(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  const auto &basis   = surface.patch(edge.patch).basis;
  const int   normal  = internal::normal_direction(edge.side);
  const int   tangent = 1 - normal;
  double      border  = internal::at_maximum(edge.side) ? -std::numeric_limits<double>::infinity()
                                                        : std::numeric_limits<double>::infinity();
  const auto  outer   = [&](int e) {
    const auto &box = basis.element(e);
    return internal::at_maximum(edge.side) ? box.max[normal] : box.min[normal];
  };
  for (int e = 0; e < basis.n_elements(); ++e)
    border = internal::at_maximum(edge.side) ? std::max(border, outer(e)) : std::min(border, outer(e));

  std::vector<int> elements;
  for (int e = 0; e < basis.n_elements(); ++e)
    if (outer(e) == border)
      elements.push_back(e);
  std::sort(elements.begin(), elements.end(),
            [&](int a, int b) { return basis.element(a).min[tangent] < basis.element(b).min[tangent]; });
  for (int &e : elements)
    e += surface.element_offset(edge.patch);
  return elements;
}

namespace internal
{
/// Control points whose knots across a side repeat its value exactly @p multiplicity times, in the order of the
/// parameter along the side.
template <int degree, int spacedim>
std::vector<int> points_of_multiplicity(const Surface<degree, spacedim> &surface, const Edge &edge, int multiplicity)
{
  const auto  &basis   = surface.patch(edge.patch).basis;
  const int    normal  = normal_direction(edge.side);
  const int    tangent = 1 - normal;
  const double border  = at_maximum(edge.side) ? basis.domain().max[normal] : basis.domain().min[normal];

  std::vector<int> points;
  for (int i = 0; i < basis.n_functions(); ++i)
    {
      const auto &knots = basis.function(i).knots[normal];
      if (std::count(knots.begin(), knots.end(), border) == multiplicity)
        points.push_back(i);
    }
  const auto centre = [&](int i) {
    const auto &knots = basis.function(i).knots[tangent];
    return std::accumulate(knots.begin() + 1, knots.end() - 1, 0.);
  };
  std::sort(points.begin(), points.end(), [&](int a, int b) { return centre(a) < centre(b); });
  for (int &i : points)
    i += surface.point_offset(edge.patch);
  return points;
}
} // namespace internal

template <int degree, int spacedim>
std::vector<int> points_along(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  return internal::points_of_multiplicity(surface, edge, degree + 1);
}

template <int degree, int spacedim>
std::vector<int> second_row_along(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  return internal::points_of_multiplicity(surface, edge, degree);
}

} // namespace sherd
