#pragma once

#include <array>
#include <optional>
#include <vector>

#include <sherd/geometry/shape_values.h>
#include <sherd/geometry/surface.h>
#include <sherd/spline/extraction.h>

namespace sherd
{

/// Reference surface at one quadrature point, in the coordinates of the element. Constant in time.
struct ReferenceQuadraturePoint
{
  Voigt  covariant;     ///< A_ab
  Voigt  contravariant; ///< A^ab
  double dA;            ///< J_A times the quadrature weight, [length^2]
  double laplace_1;     ///< A^ab Gamma^1_ab: the Laplacian of S is A^ab S,ab - laplace_1 S,1 - laplace_2 S,2
  double laplace_2;     ///< A^ab Gamma^2_ab
  Voigt  curvature;     ///< B_ab = A_a,b . N with N = A_1 x A_2 / |A_1 x A_2| (theory A.1); zero in the plane
};

/// One element in Bernstein form: which control points act on it and how, and the reference surface at its
/// (degree+1)^2 Gauss points.
///
/// Control values c_i, shape=(n_functions), become Bernstein coefficients c_b = sum_i E_ib c_i, and element vectors and
/// matrices return the same way: f_i = sum_b E_ib f_b, with E_ib = w_i C_ib of theory H.5 and shape functions S_b.
template <int degree, int spacedim>
struct ElementGeometry
{
  static constexpr int n_b = ShapeValues<degree>::n_functions;
  static constexpr int n_q = ShapeValues<degree>::n_points;

  std::vector<int>                                      points;      ///< control points, in the order of functions_of
  ExtractionMatrix<degree>                              extraction;  ///< E, shape=(n_functions, n_b)
  std::optional<std::array<double, n_b>>                denominator; ///< W_b of a rational element
  std::array<ReferenceQuadraturePoint, n_q>             reference;
  Eigen::Matrix<double, spacedim, n_b, Eigen::RowMajor> bezier_points; ///< numerators of X: X = sum_b S_b X_b

  /// Shape functions; @p storage is used by rational elements only.
  const ShapeValues<degree> &shapes(std::optional<ShapeValues<degree>> &storage) const
  {
    if (!denominator)
      return polynomial_shape_values<degree>();
    storage = rational_shape_values<degree>(*denominator);
    return *storage;
  }

  /// X at quadrature point q.
  Point<spacedim> position(int q) const
  {
    std::optional<ShapeValues<degree>> storage;
    const auto                        &s = shapes(storage);
    Point<spacedim>                    X = Point<spacedim>::Zero();
    for (int b = 0; b < n_b; ++b)
      X += s.value[q][b] * bezier_points.col(b);
    return X;
  }
};

/// Geometry of a surface element.
/// @throws InvalidParameter   if the surface is degenerate at a quadrature point of the element
template <int degree, int spacedim>
ElementGeometry<degree, spacedim> element_geometry(const Surface<degree, spacedim> &surface, int element);

/// Shortest edge of the element on the reference surface, min over directions and opposite edges of the arc length
/// int |X,a| by degree + 1 Gauss points (theory F.3). Exact to rounding on straight edges of polynomial elements, of
/// order 2 degree + 2 on the others.
template <int degree, int spacedim>
double shortest_edge(const ElementGeometry<degree, spacedim> &geometry);

} // namespace sherd

#include <sherd/geometry/element_geometry.templates.h>

namespace sherd
{
extern template ElementGeometry<2, 2> element_geometry(const Surface<2, 2> &, int);
extern template ElementGeometry<3, 2> element_geometry(const Surface<3, 2> &, int);
extern template ElementGeometry<4, 2> element_geometry(const Surface<4, 2> &, int);
extern template ElementGeometry<2, 3> element_geometry(const Surface<2, 3> &, int);
extern template ElementGeometry<3, 3> element_geometry(const Surface<3, 3> &, int);
extern template ElementGeometry<4, 3> element_geometry(const Surface<4, 3> &, int);
} // namespace sherd
