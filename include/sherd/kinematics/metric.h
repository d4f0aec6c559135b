#pragma once

#include <sherd/base/types.h>

#include <Eigen/Geometry>

namespace sherd
{

/// First fundamental form of a surface at one point, theory A.1.
///
/// Components refer to the parametric coordinates, in the order (11, 22, 12).
struct Metric
{
  Voigt  covariant;     ///< a_ab = a_a . a_b [length^2 / parameter^2]
  Voigt  contravariant; ///< a^ab, the inverse of a_ab
  double determinant;   ///< det a_ab = |a_1 x a_2|^2; its root is the area per parametric area
};

namespace internal
{
/// a_ab with its determinant already known.
inline Metric metric_with_determinant(const Voigt &covariant, const double determinant)
{
  const double inverse = 1. / determinant;
  return {covariant, Voigt(covariant[1] * inverse, covariant[0] * inverse, -covariant[2] * inverse), determinant};
}
} // namespace internal

/// Metric of the tangents a_1, a_2 [length / parameter].
///
/// The determinant comes from the cross product, so that it is never negative and keeps its digits on skewed elements.
/// It does not know the orientation: in the plane an element turned inside out has the metric of its mirror image.
/// Parallel tangents give an infinite inverse; nothing is thrown here.
template <int spacedim>
inline Metric metric(const Point<spacedim> &a1, const Point<spacedim> &a2)
{
  static_assert(spacedim == 2 || spacedim == 3);
  const Voigt covariant(a1.squaredNorm(), a2.squaredNorm(), a1.dot(a2));
  if constexpr (spacedim == 2)
    {
      const double area = a1[0] * a2[1] - a1[1] * a2[0];
      return internal::metric_with_determinant(covariant, area * area);
    }
  else
    return internal::metric_with_determinant(covariant, a1.cross(a2).squaredNorm());
}

/// Metric with given covariant components a_ab (11, 22, 12), for studies at one point without a surface.
inline Metric metric(const Voigt &covariant)
{
  return internal::metric_with_determinant(covariant, covariant[0] * covariant[1] - covariant[2] * covariant[2]);
}

/// Symmetric matrix of Voigt components by its upper triangle. Coefficients are set one by one, which compilers keep in
/// registers.
inline Voigt4 symmetric_voigt4(const double m00, const double m01, const double m02, const double m11, const double m12,
                               const double m22)
{
  Voigt4 m;
  m(0, 0) = m00;
  m(0, 1) = m(1, 0) = m01;
  m(0, 2) = m(2, 0) = m02;
  m(1, 1)           = m11;
  m(1, 2) = m(2, 1) = m12;
  m(2, 2)           = m22;
  return m;
}

/// a^abcd = d a^ab / d a_cd = -(a^ac a^bd + a^ad a^bc) / 2, theory A.1. Rows (ab), columns (cd).
inline Voigt4 inverse_derivative(const Metric &metric)
{
  const double a11 = metric.contravariant[0], a22 = metric.contravariant[1], a12 = metric.contravariant[2];
  return symmetric_voigt4(-a11 * a11, -a12 * a12, -a11 * a12, -a22 * a22, -a22 * a12, -.5 * (a11 * a22 + a12 * a12));
}

} // namespace sherd
