#pragma once

#include <sherd/kinematics/surface_point.h>

#include <cmath>

namespace sherd
{

/// Tangents of the deformed surface at one point and what follows from them (theory A.1).
template <int spacedim>
struct SurfaceFrame;

/// In the plane: tangents and metric.
template <>
struct SurfaceFrame<2>
{
  SurfaceFrame(const Point<2> &a1_, const Point<2> &a2_) : a1(a1_), a2(a2_), metric(sherd::metric<2>(a1_, a2_)) {}

  Point<2> a1, a2; ///< a_a = x,a [length / parameter]
  Metric   metric;
};

/// In space: also normal, dual tangents, curvature and Christoffel symbols. Symmetric pairs ab in the order (11, 22,
/// 12).
template <>
struct SurfaceFrame<3>
{
  /// @param a11, a22, a12   second derivatives x,ab
  SurfaceFrame(const Point<3> &a1_, const Point<3> &a2_, const Point<3> &a11, const Point<3> &a22, const Point<3> &a12)
      : a1(a1_), a2(a2_), metric(sherd::metric<3>(a1_, a2_))
  {
    const Voigt &a = metric.contravariant;
    normal         = a1.cross(a2) / std::sqrt(metric.determinant);
    dual_1         = a[0] * a1 + a[2] * a2;
    dual_2         = a[2] * a1 + a[1] * a2;
    curvature      = {a11.dot(normal), a22.dot(normal), a12.dot(normal)};
    christoffel_1  = {a11.dot(dual_1), a22.dot(dual_1), a12.dot(dual_1)};
    christoffel_2  = {a11.dot(dual_2), a22.dot(dual_2), a12.dot(dual_2)};
  }

  Point<3> a1, a2; ///< a_a = x,a [length / parameter]
  Metric   metric;
  Point<3> normal;         ///< n = a_1 x a_2 / |a_1 x a_2|
  Point<3> dual_1, dual_2; ///< a^1, a^2
  Voigt    curvature;      ///< b_ab = x,ab . n
  Voigt    christoffel_1;  ///< Gamma^1_ab = a^1 . x,ab
  Voigt    christoffel_2;  ///< Gamma^2_ab
};

/// Deformation that material laws see.
inline SurfacePoint<2> surface_point(const ReferencePoint<2> &reference, const SurfaceFrame<2> &frame)
{
  return {reference, frame.metric};
}
inline SurfacePoint<3> surface_point(const ReferencePoint<3> &reference, const SurfaceFrame<3> &frame)
{
  return {reference, frame.metric, frame.curvature};
}

} // namespace sherd
