#pragma once

#include <set>

#include <sherd/output/probes.h>

namespace sherd
{
namespace internal
{

template <int spacedim>
std::vector<std::string> probe_columns(const std::vector<PointProbe<spacedim>> &points,
                                       const std::vector<std::string>          &edges)
{
  const std::string        axes = "xyz";
  std::set<std::string>    names;
  std::vector<std::string> columns{"time"};
  const auto               check = [&](const std::string &name) {
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos || !names.insert(name).second)
      throw InvalidParameter("probe '" + name +
                                           "': expected a name that no other probe has, without comma, quote or "
                                                         "line end");
  };
  for (const auto &point : points)
    {
      check(point.name);
      for (int d = 0; d < spacedim; ++d)
        columns.push_back(point.name + ".u" + axes[d]);
      columns.push_back(point.name + ".phi");
    }
  for (const auto &edge : edges)
    {
      check(edge);
      for (int d = 0; d < spacedim; ++d)
        columns.push_back(edge + ".r" + axes[d]);
    }
  return columns;
}

template <int degree, int spacedim>
std::vector<SurfacePlace> probe_places(const Surface<degree, spacedim>         &surface,
                                       const std::vector<PointProbe<spacedim>> &points)
{
  const auto                X    = surface.control_points();
  const double              size = (X.colwise().maxCoeff() - X.colwise().minCoeff()).norm();
  std::vector<SurfacePlace> places;
  for (const auto &point : points)
    {
      const auto   place    = closest_place(surface, point.X);
      const double distance = (position(surface, place) - point.X).norm();
      if (!(distance <= 0.01 * size))
        throw InvalidParameter("probe '" + point.name + "' lies " + std::to_string(distance) +
                               " away from the reference surface, whose size is " + std::to_string(size) +
                               "; expected a point on it");
      places.push_back(place);
    }
  return places;
}

} // namespace internal

// Braces: all places are found before the file is touched.
template <int spacedim>
template <int degree>
Probes<spacedim>::Probes(const std::filesystem::path &directory, const Surface<degree, spacedim> &surface,
                         const std::vector<PointProbe<spacedim>> &points, const std::vector<std::string> &edges)
    : Probes{internal::probe_places(surface, points),
             CsvTable(directory / "probes.csv", internal::probe_columns(points, edges))}
{
}

template <int spacedim>
template <int degree>
Probes<spacedim> Probes<spacedim>::resume(const std::filesystem::path             &directory,
                                          const Surface<degree, spacedim>         &surface,
                                          const std::vector<PointProbe<spacedim>> &points,
                                          const std::vector<std::string> &edges, double time)
{
  return Probes{internal::probe_places(surface, points),
                CsvTable::resume(directory / "probes.csv", internal::probe_columns(points, edges), time)};
}

template <int spacedim>
template <int degree>
void Probes<spacedim>::append(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot,
                              const std::vector<Point<spacedim>> &reactions)
{
  CsvRow row;
  row << snapshot.time;
  for (const auto &place : places_)
    {
      const auto      shape = evaluate(surface, place);
      Point<spacedim> u     = -position(surface, place);
      double          phi   = 0.;
      for (std::size_t k = 0; k < shape.points.size(); ++k)
        {
          u += shape.value[k] * snapshot.position.row(shape.points[k]).transpose();
          phi += shape.value[k] * snapshot.phase[shape.points[k]];
        }
      for (int d = 0; d < spacedim; ++d)
        row << u[d];
      row << phi;
    }
  for (const auto &reaction : reactions)
    for (int d = 0; d < spacedim; ++d)
      row << reaction[d];
  table_.append(row);
}

} // namespace sherd
