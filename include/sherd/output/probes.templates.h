#pragma once

#include <algorithm>
#include <limits>
#include <set>

#include <Eigen/LU>

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

/// X and its derivatives by u and v at a point of an element.
template <int degree, int spacedim>
struct SurfacePoint
{
  Point<spacedim>                    X;
  Eigen::Matrix<double, spacedim, 2> tangents;

  SurfacePoint(const BezierElement<degree, spacedim> &element, double u, double v)
  {
    using Weights      = typename BezierElement<degree, spacedim>::Weights;
    const auto    size = element.box.size();
    const auto    B    = bernstein_2d<degree>((u - element.box.min[0]) / size[0], (v - element.box.min[1]) / size[1]);
    const Weights w    = element.weights.cwiseProduct(Eigen::Map<const Weights>(B.value.data()));
    X                  = element.values.transpose() * w / w.sum();
    for (int d = 0; d < 2; ++d)
      {
        Weights dw;
        for (int b = 0; b < dw.size(); ++b)
          dw[b] = element.weights[b] * B.first[b][d] / size[d];
        tangents.col(d) = (element.values.transpose() * dw - dw.sum() * X) / w.sum();
      }
  }
};

template <int degree, int spacedim>
std::vector<SurfacePlace> probe_places(const Surface<degree, spacedim>         &surface,
                                       const std::vector<PointProbe<spacedim>> &points)
{
  const auto                X    = surface.control_points();
  const double              size = (X.colwise().maxCoeff() - X.colwise().minCoeff()).norm();
  std::vector<SurfacePlace> places;
  for (const auto &point : points)
    {
      const auto  place = closest_place(surface, point.X);
      const auto &patch = surface.patch(place.patch);
      const auto  element =
          bezier_element<spacedim>(patch, patch.basis.element_at(place.u, place.v), patch.control_points);
      const double distance = (element(place.u, place.v) - point.X).norm();
      if (!(distance <= 0.01 * size))
        throw InvalidParameter("probe '" + point.name + "' lies " + std::to_string(distance) +
                               " away from the reference surface, whose size is " + std::to_string(size) +
                               "; expected a point on it");
      places.push_back(place);
    }
  return places;
}

} // namespace internal

template <int degree, int spacedim>
SurfacePlace closest_place(const Surface<degree, spacedim> &surface, const Point<spacedim> &X)
{
  SurfacePlace best{};
  double       best_distance = std::numeric_limits<double>::infinity();
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      const auto &patch = surface.patch(p);
      for (int e = 0; e < patch.basis.n_elements(); ++e)
        {
          const auto element = bezier_element<spacedim>(patch, e, patch.control_points);
          for (int k = 0; k < 9; ++k)
            {
              const double u = element.box.min[0] + element.box.size()[0] * (k % 3) / 2.;
              const double v = element.box.min[1] + element.box.size()[1] * (k / 3) / 2.;
              if (const double d = (element(u, v) - X).norm(); d < best_distance)
                {
                  best_distance = d;
                  best          = {p, u, v};
                }
            }
        }
    }
  const auto &patch  = surface.patch(best.patch);
  const auto &domain = patch.basis.domain();
  for (int iteration = 0; iteration < 20; ++iteration)
    {
      const int                                      e = patch.basis.element_at(best.u, best.v);
      const internal::SurfacePoint<degree, spacedim> point(bezier_element<spacedim>(patch, e, patch.control_points),
                                                           best.u, best.v);
      const Eigen::Matrix2d                          metric = point.tangents.transpose() * point.tangents;
      const Eigen::Vector2d step = metric.inverse() * (point.tangents.transpose() * (X - point.X));
      const SurfacePlace    next{best.patch, std::clamp(best.u + step[0], domain.min[0], domain.max[0]),
                              std::clamp(best.v + step[1], domain.min[1], domain.max[1])};
      const internal::SurfacePoint<degree, spacedim> there(
          bezier_element<spacedim>(patch, patch.basis.element_at(next.u, next.v), patch.control_points), next.u,
          next.v);
      if (!((there.X - X).norm() < (point.X - X).norm()))
        break;
      best = next;
    }
  return best;
}

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
      const auto &patch  = surface.patch(place.patch);
      const int   offset = surface.point_offset(place.patch), n = patch.basis.n_functions();
      const int   e = patch.basis.element_at(place.u, place.v);
      const auto u = bezier_element<spacedim>(patch, e, snapshot.position.middleRows(offset, n) - patch.control_points)(
          place.u, place.v);
      for (int d = 0; d < spacedim; ++d)
        row << u[d];
      row << bezier_element<1>(patch, e, snapshot.phase.segment(offset, n))(place.u, place.v)[0];
    }
  for (const auto &reaction : reactions)
    for (int d = 0; d < spacedim; ++d)
      row << reaction[d];
  table_.append(row);
}

} // namespace sherd
