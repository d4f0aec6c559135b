#pragma once

#include <vector>

#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/surface.h>

namespace sherd
{

/// A point of the reference surface in the parameters of a patch.
struct SurfacePlace
{
  int    patch;
  double u, v;
};

/// Shape functions at a place: N_A = w_A gamma_A B_A / sum_C w_C gamma_C B_C of all control points A that act there.
struct PlaceValues
{
  std::vector<int>    points; ///< control points, in the numbering of the surface
  std::vector<double> value;  ///< N_A, shape=(points); sum 1
};

/// The point of the surface closest to @p X: on each patch the best of 3 x 3 points an element, then damped
/// Gauss-Newton in the parameters, kept inside the patch; the closest of them. Where several places are equally close,
/// as on the two sides of a slit or a shared edge, the first found.
template <int degree, int spacedim>
SurfacePlace closest_place(const Surface<degree, spacedim> &surface, const Point<spacedim> &X);

/// X at a place. @throws InvalidParameter   parameters outside the patch
template <int degree, int spacedim>
Point<spacedim> position(const Surface<degree, spacedim> &surface, const SurfacePlace &place);

/// Shape functions at a place: a field with control values c is sum_A N_A c_A there.
/// @throws InvalidParameter   parameters outside the patch
template <int degree, int spacedim>
PlaceValues evaluate(const Surface<degree, spacedim> &surface, const SurfacePlace &place);

} // namespace sherd

#include <sherd/geometry/place.templates.h>

namespace sherd
{
extern template SurfacePlace closest_place(const Surface<2, 2> &, const Point<2> &);
extern template SurfacePlace closest_place(const Surface<3, 2> &, const Point<2> &);
extern template SurfacePlace closest_place(const Surface<4, 2> &, const Point<2> &);
extern template SurfacePlace closest_place(const Surface<2, 3> &, const Point<3> &);
extern template SurfacePlace closest_place(const Surface<3, 3> &, const Point<3> &);
extern template SurfacePlace closest_place(const Surface<4, 3> &, const Point<3> &);
} // namespace sherd
