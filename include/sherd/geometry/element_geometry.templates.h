#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <sherd/base/print.h>
#include <sherd/geometry/element_geometry.h>

namespace sherd
{

template <int degree, int spacedim>
ElementGeometry<degree, spacedim> element_geometry(const Surface<degree, spacedim> &surface, int element)
{
  const auto [p, local] = surface.locate_element(element);
  const auto &patch     = surface.patch(p);

  ElementGeometry<degree, spacedim> g;
  g.extraction         = extraction(patch.basis, local);
  const auto functions = patch.basis.functions_of(local);
  g.bezier_points.setZero();
  bool rational = false;
  for (std::size_t k = 0; k < functions.size(); ++k)
    {
      const int i = functions[k];
      g.points.push_back(surface.point(p, i));
      g.extraction.row(k) *= patch.weights[i];
      rational = rational || patch.weights[i] != 1.;
      g.bezier_points += patch.control_points.row(i).transpose() * g.extraction.row(k);
    }
  if (rational)
    {
      g.denominator.emplace();
      for (int b = 0; b < g.n_b; ++b)
        (*g.denominator)[b] = g.extraction.col(b).sum();
    }

  std::optional<ShapeValues<degree>> storage;
  const auto                        &s       = g.shapes(storage);
  const auto                        &weights = BernsteinTable<degree>::get().weights;
  using Vector                               = Point<spacedim>;
  for (int q = 0; q < g.n_q; ++q)
    {
      Vector A1 = Vector::Zero(), A2 = A1, A11 = A1, A22 = A1, A12 = A1;
      for (int b = 0; b < g.n_b; ++b)
        {
          const Vector X = g.bezier_points.col(b);
          A1 += s.d1[q][b] * X;
          A2 += s.d2[q][b] * X;
          A11 += s.d11[q][b] * X;
          A22 += s.d22[q][b] * X;
          A12 += s.d12[q][b] * X;
        }
      auto &point      = g.reference[q];
      point.covariant  = Voigt(A1.dot(A1), A2.dot(A2), A1.dot(A2));
      const auto  &A   = point.covariant;
      const double det = A[0] * A[1] - A[2] * A[2];
      if (!(det > 0.))
        throw InvalidParameter("surface: element " + std::to_string(element) +
                               " is degenerate, the determinant of its metric is " + print(det) +
                               "; expected a regular parametrisation (check control points and weights)");
      point.contravariant    = Voigt(A[1], A[0], -A[2]) / det;
      point.dA               = std::sqrt(det) * weights[q];
      const auto  &Ac        = point.contravariant;
      const Vector laplacian = Ac[0] * A11 + Ac[1] * A22 + 2. * Ac[2] * A12;
      point.laplace_1        = (Ac[0] * A1 + Ac[2] * A2).dot(laplacian);
      point.laplace_2        = (Ac[2] * A1 + Ac[1] * A2).dot(laplacian);
      if constexpr (spacedim == 3)
        {
          const Vector normal = A1.cross(A2).normalized();
          point.curvature     = Voigt(A11.dot(normal), A22.dot(normal), A12.dot(normal));
        }
      else
        point.curvature.setZero();
    }
  return g;
}

template <int degree, int spacedim>
double shortest_edge(const ElementGeometry<degree, spacedim> &geometry)
{
  constexpr int         n     = degree + 1;
  static constexpr auto gauss = [] {
    std::array<UnivariateBernstein<degree>, n> values{};
    for (int q = 0; q < n; ++q)
      values[q] = bernstein_1d<degree>(gauss_legendre(n).points[q]);
    return values;
  }();
  const auto length = [&](int first, int stride) {
    double sum = 0.;
    for (int q = 0; q < n; ++q)
      {
        Point<spacedim> X = Point<spacedim>::Zero(), dX = X;
        double          W = 0., dW = 0.;
        for (int k = 0; k < n; ++k)
          {
            const int b = first + k * stride;
            X += gauss[q].value[k] * geometry.bezier_points.col(b);
            dX += gauss[q].first[k] * geometry.bezier_points.col(b);
            if (geometry.denominator)
              {
                W += gauss[q].value[k] * (*geometry.denominator)[b];
                dW += gauss[q].first[k] * (*geometry.denominator)[b];
              }
          }
        if (geometry.denominator)
          dX = (dX - dW / W * X) / W;
        sum += gauss_legendre(n).weights[q] * dX.norm();
      }
    return sum;
  };
  return std::min({length(0, 1), length(degree * n, 1), length(0, n), length(degree, n)});
}

} // namespace sherd
