#pragma once

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include <sherd/space/region.h>

namespace sherd
{

namespace internal
{

/// @p points, each where it comes first.
inline std::vector<int> first_of_each(std::span<const int> points, int n_control_points)
{
  std::vector<int>  result;
  std::vector<char> found(n_control_points, 0);
  for (const int point : points)
    if (!std::exchange(found[point], 1))
      result.push_back(point);
  return result;
}

/// Control points in which sides of two lists meet; two sides of one patch meet if they run in different directions.
template <int degree, int spacedim>
std::set<int> corner_points(const Surface<degree, spacedim> &surface, const std::vector<Edge> &first,
                            const std::vector<Edge> &second)
{
  std::set<int> corners;
  for (const auto &a : first)
    for (const auto &b : second)
      if (a.patch != b.patch || normal_direction(a.side) != normal_direction(b.side))
        {
          auto on_a = points_along(surface, a), on_b = points_along(surface, b);
          std::sort(on_a.begin(), on_a.end());
          std::sort(on_b.begin(), on_b.end());
          std::set_intersection(on_a.begin(), on_a.end(), on_b.begin(), on_b.end(),
                                std::inserter(corners, corners.end()));
        }
  return corners;
}

template <int degree, int spacedim>
int corner_point(const Corner &corner, const Surface<degree, spacedim> &surface)
{
  const auto &first   = surface.edge(corner.first);
  const auto  corners = corner_points(surface, first, surface.edge(corner.second));
  if (corners.size() == 1)
    return *corners.begin();
  std::string partners;
  for (const auto &[name, sides] : surface.edges())
    if (name != corner.first && corner_points(surface, first, sides).size() == 1)
      partners += (partners.empty() ? "\"" : ", \"") + name + "\"";
  throw InvalidParameter("support: edges \"" + corner.first + "\" and \"" + corner.second + "\" meet in " +
                         std::to_string(corners.size()) + " corners, expected one; \"" + corner.first +
                         "\" has a single corner with " + (partners.empty() ? "no edge" : partners));
}

} // namespace internal

template <int degree, int spacedim>
std::vector<int> points_of(const Region &region, const Surface<degree, spacedim> &surface)
{
  if (const auto *edge = std::get_if<std::string>(&region.part))
    {
      std::vector<int> points;
      for (const auto &side : surface.edge(*edge))
        for (const int point : points_along(surface, side))
          points.push_back(point);
      return internal::first_of_each(points, surface.n_control_points());
    }
  if (const auto *corner = std::get_if<Corner>(&region.part))
    return {internal::corner_point(*corner, surface)};

  if (const auto *patch = std::get_if<PatchRegion>(&region.part))
    {
      if (patch->patch < 0 || patch->patch >= surface.n_patches())
        throw InvalidParameter("support: there is no patch " + std::to_string(patch->patch) + ", expected 0 to " +
                               std::to_string(surface.n_patches() - 1));
      const auto points = surface.points_of_patch(patch->patch);
      return internal::first_of_each(points, surface.n_control_points());
    }
  std::vector<int> points(surface.n_control_points());
  std::iota(points.begin(), points.end(), 0);
  return points;
}

} // namespace sherd
