#pragma once

#include <sherd/output/frames.h>

namespace sherd
{
namespace internal
{

/// Where a Bezier control point sits: the patch, the rectangle of the side or corner it belongs to, its place in it.
/// Equal places have equal control points, as the surface and its fields are continuous.
struct ControlPlace
{
  int                patch;
  Box                box;
  std::array<int, 2> index;

  auto operator<=>(const ControlPlace &other) const
  {
    return std::tie(patch, box.min, box.max, index) <=>
           std::tie(other.patch, other.box.min, other.box.max, other.index);
  }
};

template <int degree>
ControlPlace control_place(int patch, const Box &element, int i, int j)
{
  ControlPlace place{patch, element, {i, j}};
  for (int d = 0; d < 2; ++d)
    if (place.index[d] == 0)
      place.box.max[d] = place.box.min[d];
    else if (place.index[d] == degree)
      {
        place.box.min[d] = place.box.max[d];
        place.index[d]   = 0;
      }
  return place;
}

inline void check_rows(const char *name, Eigen::Index rows, int expected)
{
  if (rows != expected)
    throw DimensionMismatch(std::string("frame: ") + name + " has " + std::to_string(rows) + " rows, expected " +
                            std::to_string(expected));
}

} // namespace internal

template <int degree, int spacedim>
BezierGrid bezier_grid(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot,
                       const std::vector<ElementField> &fields)
{
  constexpr int n      = 2 * spacedim + 1; // x, v, phi
  const int     points = surface.n_control_points();
  internal::check_rows("position", snapshot.position.rows(), points);
  internal::check_rows("velocity", snapshot.velocity.rows(), points);
  internal::check_rows("phase", snapshot.phase.size(), points);

  BezierGrid grid{
      degree, {}, {}, {}, {{"phi", 1, {}}, {"displacement", 3, {}}, {"velocity", 3, {}}}, {{"level", 1, {}}}};
  auto      &phi          = grid.point_data[0].values;
  auto      &displacement = grid.point_data[1].values;
  auto      &velocity     = grid.point_data[2].values;
  const auto order        = vtk_bezier_order(degree);

  std::map<internal::ControlPlace, int> shared;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      const auto &patch           = surface.patch(p);
      const auto  points_of_patch = surface.points_of_patch(p);

      ControlValues<n + spacedim> control(points_of_patch.size(), n + spacedim);
      for (std::size_t i = 0; i < points_of_patch.size(); ++i)
        control.row(i) << snapshot.position.row(points_of_patch[i]), snapshot.velocity.row(points_of_patch[i]),
            snapshot.phase[points_of_patch[i]], patch.control_points.row(i);

      std::array<double, 2> largest{0., 0.};
      for (int e = 0; e < patch.basis.n_elements(); ++e)
        for (int d = 0; d < 2; ++d)
          largest[d] = std::max(largest[d], patch.basis.element(e).size()[d]);

      for (int e = 0; e < patch.basis.n_elements(); ++e)
        {
          const auto element = bezier_element<n + spacedim>(patch, e, control);
          for (const int b : order)
            {
              const int  i = b % (degree + 1), j = b / (degree + 1);
              const bool inside = i > 0 && i < degree && j > 0 && j < degree;
              const int  next   = static_cast<int>(grid.points.size());
              const int  point =
                  inside
                       ? next
                       : shared.try_emplace(internal::control_place<degree>(p, element.box, i, j), next).first->second;
              grid.cells.push_back(point);
              if (point < next)
                continue;
              const auto            values = element.values.row(b);
              std::array<double, 3> x{};
              for (int d = 0; d < 3; ++d)
                {
                  x[d] = d < spacedim ? values[d] : 0.;
                  displacement.push_back(d < spacedim ? static_cast<float>(values[d] - values[n + d]) : 0.f);
                  velocity.push_back(d < spacedim ? static_cast<float>(values[spacedim + d]) : 0.f);
                }
              grid.points.push_back(x);
              grid.weights.push_back(element.weights[b]);
              phi.push_back(static_cast<float>(values[2 * spacedim]));
            }
          const auto   size  = element.box.size();
          const double level = std::max(std::log2(largest[0] / size[0]), std::log2(largest[1] / size[1]));
          grid.cell_data[0].values.push_back(static_cast<float>(std::round(level)));
        }
    }
  if (surface.n_patches() > 1)
    {
      std::vector<float> patches;
      for (int e = 0; e < surface.n_elements(); ++e)
        patches.push_back(static_cast<float>(surface.locate_element(e).patch));
      grid.cell_data.push_back({"patch", 1, std::move(patches)});
    }
  for (const auto &field : fields)
    {
      internal::check_rows(field.name.c_str(), static_cast<Eigen::Index>(field.values.size()), surface.n_elements());
      grid.cell_data.push_back({field.name, 1, {field.values.begin(), field.values.end()}});
    }
  return grid;
}

} // namespace sherd
