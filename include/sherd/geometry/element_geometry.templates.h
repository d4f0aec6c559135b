#pragma once

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
      g.points.push_back(surface.point_offset(p) + i);
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
    }
  return g;
}

} // namespace sherd
