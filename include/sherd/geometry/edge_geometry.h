#pragma once

#include <array>
#include <vector>

#include <sherd/geometry/surface.h>
#include <sherd/spline/extraction.h>
#include <sherd/spline/quadrature.h>

namespace sherd
{

/// One element's part of a named edge of the reference surface at degree+1 Gauss points.
///
/// Derivatives and tangents refer to the coordinates of the element, which run over [0,1]^2 in the directions of the
/// parameters of the patch, as in ShapeValues. The edge is where coordinate e is constant, and its outward sign s says
/// at which end: the outward conormal of the surface x = sum_A N_A x_A is nu = s a^e / |a^e|.
template <int degree, int spacedim>
struct EdgeGeometry
{
  struct QuadraturePoint
  {
    Point<spacedim>     position; ///< X
    Point<spacedim>     A1, A2;   ///< tangents X,1  X,2 of the reference surface
    double              dS;       ///< reference length times the quadrature weight, [length]
    std::vector<double> value;    ///< N_A, shape=(n_functions), in the order of points
    std::vector<double> d1, d2;   ///< N_A,1  N_A,2, likewise
  };

  int                                     element;          ///< in the numbering of the surface
  int                                     normal_direction; ///< e: 0 on the sides u_min, u_max, 1 on v_min, v_max
  int                                     outward;          ///< s: 1 at the maximum of coordinate e, -1 at its minimum
  std::vector<int>                        points;           ///< control points of the element
  std::array<QuadraturePoint, degree + 1> quadrature;
};

namespace internal
{

/// Values, derivatives and tangents at the point (@p s, @p t) of an element; dS is left to the caller.
/// @param E         extraction operator with the weights, shape=(n_functions, n_b)
/// @param control   control points X_A, shape=(n_functions, spacedim)
template <int degree, int spacedim>
typename EdgeGeometry<degree, spacedim>::QuadraturePoint
edge_point(const ExtractionMatrix<degree> &E, const ControlValues<spacedim> &control, double s, double t)
{
  constexpr int                 n_b       = n_bernstein<degree>;
  const auto                    bernstein = bernstein_2d<degree>(s, t);
  Eigen::Matrix<double, n_b, 3> table;
  for (int b = 0; b < n_b; ++b)
    table.row(b) << bernstein.value[b], bernstein.first[b][0], bernstein.first[b][1];
  const Eigen::Matrix<double, Eigen::Dynamic, 3> numerator = E.lazyProduct(table);
  const Eigen::RowVector3d                       W         = numerator.colwise().sum();

  typename EdgeGeometry<degree, spacedim>::QuadraturePoint point{};
  point.position = point.A1 = point.A2 = Point<spacedim>::Zero();
  for (Eigen::Index k = 0; k < numerator.rows(); ++k)
    {
      const Point<spacedim> X  = control.row(k).transpose();
      const double          N  = numerator(k, 0) / W[0];
      const double          N1 = (numerator(k, 1) - N * W[1]) / W[0];
      const double          N2 = (numerator(k, 2) - N * W[2]) / W[0];
      point.value.push_back(N);
      point.d1.push_back(N1);
      point.d2.push_back(N2);
      point.position += N * X;
      point.A1 += N1 * X;
      point.A2 += N2 * X;
    }
  return point;
}

} // namespace internal

/// Edge geometry of every element along @p edge, in the order of the parameter.
template <int degree, int spacedim>
std::vector<EdgeGeometry<degree, spacedim>> edge_geometry(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  const auto                                 &patch  = surface.patch(edge.patch);
  const int                                   normal = internal::normal_direction(edge.side);
  const bool                                  at_end = internal::at_maximum(edge.side);
  const auto                                 &gauss  = gauss_legendre(degree + 1);
  std::vector<EdgeGeometry<degree, spacedim>> pieces;
  for (const int element : elements_along(surface, edge))
    {
      const int                       local     = element - surface.element_offset(edge.patch);
      const auto                      functions = patch.basis.functions_of(local);
      ExtractionMatrix<degree>        E         = extraction(patch.basis, local);
      ControlValues<spacedim>         control(functions.size(), spacedim);
      EdgeGeometry<degree, spacedim> &piece = pieces.emplace_back();
      piece.element                         = element;
      piece.normal_direction                = normal;
      piece.outward                         = at_end ? 1 : -1;
      for (std::size_t k = 0; k < functions.size(); ++k)
        {
          piece.points.push_back(surface.point(edge.patch, functions[k]));
          E.row(k) *= patch.weights[functions[k]];
          control.row(k) = patch.control_points.row(functions[k]);
        }
      for (int q = 0; q <= degree; ++q)
        {
          std::array<double, 2> at;
          at[normal]          = at_end ? 1. : 0.;
          at[1 - normal]      = gauss.points[q];
          piece.quadrature[q] = internal::edge_point<degree, spacedim>(E, control, at[0], at[1]);
          auto &point         = piece.quadrature[q];
          point.dS            = (normal == 0 ? point.A2 : point.A1).norm() * gauss.weights[q];
        }
    }
  return pieces;
}

} // namespace sherd
