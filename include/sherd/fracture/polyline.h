#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/base/types.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sherd
{

/// Straight piece of a crack on the reference surface.
template <int spacedim>
struct Segment
{
  Point<spacedim> start, end;
};

/// Distance of X to the segment; beyond its ends, to the nearer end.
///
/// The arithmetic uses differences only and starts from the nearer end, so that points that mirror each other exactly,
/// across an axis-parallel segment or across its perpendicular bisector, get the same bits.
template <int spacedim>
inline double distance(const Point<spacedim> &X, const Segment<spacedim> &segment)
{
  const Point<spacedim> direction  = segment.end - segment.start;
  const Point<spacedim> from_start = X - segment.start, to_end = segment.end - X;
  const double          along = from_start.dot(direction), left = to_end.dot(direction);
  if (!(along > 0.))
    return from_start.norm();
  if (!(left > 0.))
    return to_end.norm();
  const double length_squared = direction.squaredNorm();
  return along <= left ? Point<spacedim>(from_start - along / length_squared * direction).norm()
                       : Point<spacedim>(to_end - left / length_squared * direction).norm();
}

/// Connected straight pieces of a crack. On a curved surface the points should be so dense that the chords stay close
/// to it: distances are measured through space.
template <int spacedim>
class Polyline
{
public:
  /// @throws InvalidParameter  for fewer than two points, a point that repeats its predecessor, or one not finite.
  explicit Polyline(std::vector<Point<spacedim>> points) : points_(std::move(points))
  {
    if (points_.size() < 2)
      throw InvalidParameter("crack: a polyline needs at least two points, " + std::to_string(points_.size()) +
                             " given");
    for (std::size_t i = 0; i < points_.size(); ++i)
      {
        if (!points_[i].allFinite())
          throw InvalidParameter("crack: coordinates of point " + std::to_string(i + 1) + " are not finite");
        if (i > 0 && points_[i] == points_[i - 1])
          throw InvalidParameter("crack: points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                                 " coincide; give each point once");
      }
  }

  Polyline(std::initializer_list<Point<spacedim>> points) : Polyline(std::vector<Point<spacedim>>(points)) {}

  Polyline(const Segment<spacedim> &segment) : Polyline(std::vector<Point<spacedim>>{segment.start, segment.end}) {}

  const std::vector<Point<spacedim>> &points() const { return points_; }

  /// Sum of the lengths of the pieces.
  double length() const
  {
    double sum = 0.;
    for (std::size_t i = 1; i < points_.size(); ++i)
      sum += (points_[i] - points_[i - 1]).norm();
    return sum;
  }

private:
  std::vector<Point<spacedim>> points_;
};

/// Distance of X to the nearest piece of the polyline.
template <int spacedim>
inline double distance(const Point<spacedim> &X, const Polyline<spacedim> &polyline)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < polyline.points().size(); ++i)
    nearest = std::min(nearest, distance(X, Segment<spacedim>{polyline.points()[i - 1], polyline.points()[i]}));
  return nearest;
}

} // namespace sherd
