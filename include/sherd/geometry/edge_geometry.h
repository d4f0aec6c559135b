#pragma once

#include <array>
#include <vector>

#include <sherd/geometry/surface.h>
#include <sherd/spline/extraction.h>
#include <sherd/spline/quadrature.h>

namespace sherd
{

/// One element's part of a named edge of the reference surface at degree+1 Gauss points.
template <int degree, int spacedim>
struct EdgeGeometry
{
  struct QuadraturePoint
  {
    Point<spacedim>     position; ///< X
    double              dS;       ///< reference length times the quadrature weight, [length]
    std::vector<double> value;    ///< N_A, shape=(n_functions), in the order of points
  };

  std::vector<int>                        points; ///< control points of the element
  std::array<QuadraturePoint, degree + 1> quadrature;
};

/// Edge geometry of every element along @p edge, in the order of the parameter.
template <int degree, int spacedim>
std::vector<EdgeGeometry<degree, spacedim>> edge_geometry(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  const auto                                 &patch  = surface.patch(edge.patch);
  const int                                   normal = internal::normal_direction(edge.side);
  const auto                                  gauss  = gauss_legendre(degree + 1);
  const bool                                  at_end = internal::at_maximum(edge.side);
  std::vector<EdgeGeometry<degree, spacedim>> pieces;
  for (const int element : elements_along(surface, edge))
    {
      const int                       local     = element - surface.element_offset(edge.patch);
      const auto                      functions = patch.basis.functions_of(local);
      ExtractionMatrix<degree>        E         = extraction(patch.basis, local);
      EdgeGeometry<degree, spacedim> &piece     = pieces.emplace_back();
      for (std::size_t k = 0; k < functions.size(); ++k)
        {
          piece.points.push_back(surface.point_offset(edge.patch) + functions[k]);
          E.row(k) *= patch.weights[functions[k]];
        }
      for (int q = 0; q <= degree; ++q)
        {
          std::array<double, 2> point;
          point[normal]                   = at_end ? 1. : 0.;
          point[1 - normal]               = gauss.points[q];
          const auto            bernstein = bernstein_2d<degree>(point[0], point[1]);
          const Eigen::VectorXd value =
              E * Eigen::Map<const Eigen::Matrix<double, (degree + 1) * (degree + 1), 1>>(bernstein.value.data());
          Eigen::Matrix<double, (degree + 1) * (degree + 1), 1> slope;
          for (int b = 0; b < slope.size(); ++b)
            slope[b] = bernstein.first[b][1 - normal];
          const Eigen::VectorXd tangent_value = E * slope;

          const double    W  = value.sum();
          const double    dW = tangent_value.sum();
          Point<spacedim> X = Point<spacedim>::Zero(), dX = X;
          auto           &out = piece.quadrature[q];
          for (std::size_t k = 0; k < functions.size(); ++k)
            {
              const Point<spacedim> control = patch.control_points.row(functions[k]).transpose();
              const double          N       = value[k] / W;
              out.value.push_back(N);
              X += N * control;
              dX += (tangent_value[k] - N * dW) / W * control;
            }
          out.position = X;
          out.dS       = dX.norm() * gauss.weights[q];
        }
    }
  return pieces;
}

} // namespace sherd
