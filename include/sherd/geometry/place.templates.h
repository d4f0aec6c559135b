#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Geometry>

#include <sherd/geometry/place.h>
#include <sherd/spline/evaluation.h>

namespace sherd
{
namespace internal
{

/// X and its derivatives by u and v at a place.
template <int degree, int spacedim>
struct SurfaceTangents
{
  Point<spacedim>                    X;
  Eigen::Matrix<double, spacedim, 2> tangents;

  SurfaceTangents(const Surface<degree, spacedim> &surface, const SurfacePlace &place)
  {
    const auto &patch     = surface.patch(place.patch);
    const int   e         = patch.basis.element_at(place.u, place.v);
    const auto  functions = patch.basis.functions_of(e);
    const auto  values    = sherd::evaluate(patch.basis, e, place.u, place.v);
    using Homogeneous     = Point<spacedim + 1>;
    Homogeneous H = Homogeneous::Zero(), H1 = H, H2 = H;
    for (std::size_t k = 0; k < functions.size(); ++k)
      {
        const Point<spacedim> control = patch.control_points.row(functions[k]).transpose();
        const Homogeneous     c       = patch.weights[functions[k]] * control.homogeneous();
        H += values[k].value * c;
        H1 += values[k].first[0] * c;
        H2 += values[k].first[1] * c;
      }
    X               = H.hnormalized();
    tangents.col(0) = (H1.template head<spacedim>() - H1[spacedim] * X) / H[spacedim];
    tangents.col(1) = (H2.template head<spacedim>() - H2[spacedim] * X) / H[spacedim];
  }
};

/// Step of the parameters that brings the tangent plane closest to a point at @p offset, without the directions in
/// which the domain ends; without one in which the surface does not extend, as on a side that is drawn together to a
/// point.
template <int spacedim>
Eigen::Vector2d closest_step(const Eigen::Matrix<double, spacedim, 2> &tangents, const Point<spacedim> &offset,
                             const Eigen::Vector2d &at, const Box &domain)
{
  const Eigen::Matrix2d metric   = tangents.transpose() * tangents;
  const Eigen::Vector2d gradient = tangents.transpose() * offset;
  const double          det      = metric(0, 0) * metric(1, 1) - metric(0, 1) * metric(0, 1);
  const auto            along    = [&](int d) { return metric(d, d) > 0. ? gradient[d] / metric(d, d) : 0.; };
  Eigen::Vector2d       step(metric(1, 1) * gradient[0] - metric(0, 1) * gradient[1],
                             metric(0, 0) * gradient[1] - metric(0, 1) * gradient[0]);
  step /= det;
  if (!(det > 1e-14 * metric.trace() * metric.trace()))
    {
      const int d = metric(0, 0) > metric(1, 1) ? 0 : 1;
      step        = along(d) * Eigen::Vector2d::Unit(d);
    }
  const auto blocked = [&](int d) {
    return (at[d] == domain.min[d] && step[d] < 0.) || (at[d] == domain.max[d] && step[d] > 0.);
  };
  for (int d = 0; d < 2; ++d)
    if (blocked(d))
      {
        step[d]     = 0.;
        step[1 - d] = along(1 - d);
        if (blocked(1 - d))
          step[1 - d] = 0.;
        break;
      }
  return step;
}

} // namespace internal

namespace internal
{

/// A place and how far it is from the point that is looked for.
struct NearPlace
{
  SurfacePlace place{};
  double       distance = std::numeric_limits<double>::infinity();
};

/// The closest of 3 x 3 points of each element of a patch.
template <int degree, int spacedim>
NearPlace closest_sample(const Surface<degree, spacedim> &surface, int p, const Point<spacedim> &X)
{
  NearPlace   best;
  const auto &patch = surface.patch(p);
  for (int e = 0; e < patch.basis.n_elements(); ++e)
    {
      const auto element = bezier_element<spacedim>(patch, e, patch.control_points);
      const auto samples = [&box = element.box](int d) {
        return std::array<double, 3>{box.min[d], .5 * (box.min[d] + box.max[d]), box.max[d]};
      };
      for (const double u : samples(0))
        for (const double v : samples(1))
          if (const double d = (element(u, v) - X).norm(); d < best.distance)
            best = {{p, u, v}, d};
    }
  return best;
}

/// Damped Gauss-Newton in the parameters of the patch.
template <int degree, int spacedim>
NearPlace approach(const Surface<degree, spacedim> &surface, NearPlace best, const Point<spacedim> &X)
{
  const int   patch  = best.place.patch;
  const auto &domain = surface.patch(patch).basis.domain();
  for (int iteration = 0; iteration < 50; ++iteration)
    {
      const SurfaceTangents<degree, spacedim> here(surface, best.place);
      const Eigen::Vector2d                   at(best.place.u, best.place.v);
      const Point<spacedim>                   offset   = X - here.X;
      Eigen::Vector2d                         step     = closest_step<spacedim>(here.tangents, offset, at, domain);
      bool                                    improved = false;
      for (int halving = 0; halving < 8 && !improved; ++halving, step *= .5)
        {
          const SurfacePlace next{patch, std::clamp(at[0] + step[0], domain.min[0], domain.max[0]),
                                  std::clamp(at[1] + step[1], domain.min[1], domain.max[1])};
          if (const double d = (position(surface, next) - X).norm(); d < best.distance)
            {
              best     = {next, d};
              improved = true;
            }
        }
      if (!improved)
        break;
    }
  return best;
}

} // namespace internal

template <int degree, int spacedim>
SurfacePlace closest_place(const Surface<degree, spacedim> &surface, const Point<spacedim> &X)
{
  internal::NearPlace best;
  for (int p = 0; p < surface.n_patches(); ++p)
    if (const auto found = internal::approach(surface, internal::closest_sample(surface, p, X), X);
        found.distance < best.distance)
      best = found;
  return best.place;
}

template <int degree, int spacedim>
Point<spacedim> position(const Surface<degree, spacedim> &surface, const SurfacePlace &place)
{
  const auto     &patch     = surface.patch(place.patch);
  const auto      functions = patch.basis.functions_of(patch.basis.element_at(place.u, place.v));
  const auto      values    = evaluate(surface, place);
  Point<spacedim> X         = Point<spacedim>::Zero();
  for (std::size_t k = 0; k < values.value.size(); ++k)
    X += values.value[k] * patch.control_points.row(functions[k]).transpose();
  return X;
}

template <int degree, int spacedim>
PlaceValues evaluate(const Surface<degree, spacedim> &surface, const SurfacePlace &place)
{
  const auto &patch     = surface.patch(place.patch);
  const int   e         = patch.basis.element_at(place.u, place.v);
  const auto  functions = patch.basis.functions_of(e);
  const auto  values    = evaluate(patch.basis, e, place.u, place.v);
  PlaceValues result;
  double      sum = 0.;
  for (std::size_t k = 0; k < functions.size(); ++k)
    {
      result.points.push_back(surface.point(place.patch, functions[k]));
      result.value.push_back(patch.weights[functions[k]] * values[k].value);
      sum += result.value.back();
    }
  for (double &value : result.value)
    value /= sum;
  return result;
}

} // namespace sherd
