#pragma once

#include <optional>

#include <sherd/forms/point_state.h>

namespace sherd
{

namespace internal
{
/// (a_1 x a_2) . (b_1 x b_2), by Lagrange's identity.
template <int spacedim>
double same_side(const Point<spacedim> &a_1, const Point<spacedim> &a_2, const Point<spacedim> &b_1,
                 const Point<spacedim> &b_2)
{
  return a_1.dot(b_1) * a_2.dot(b_2) - a_1.dot(b_2) * a_2.dot(b_1);
}
} // namespace internal

/// Whether the tangents a_1, a_2 of an element keep their orientation from one deformation to another, that is
/// (a_1 x a_2) . (b_1 x b_2) > 0 at every quadrature point.
///
/// An element that turned inside out has passed J = 0, where the energy is infinite, in one stride. Its metric, and
/// with it energy and forces, are those of its mirror image and do not show it.
///
/// @param before, after   positions, shape=(spacedim, n_b)
///
/// Source: theory F.4 (elements inside out).
template <class Model>
bool keeps_orientation(const ElementData<Model> &data, const decltype(ElementFields<Model>::position) &before,
                       const decltype(ElementFields<Model>::position) &after)
{
  constexpr int                             spacedim = Model::spacedim;
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  for (int q = 0; q < s.n_points; ++q)
    {
      Point<spacedim> a_1 = Point<spacedim>::Zero(), a_2 = a_1, b_1 = a_1, b_2 = a_1;
      for (int b = 0; b < s.n_functions; ++b)
        for (int d = 0; d < spacedim; ++d)
          {
            a_1[d] += s.d1[q][b] * before[d][b];
            a_2[d] += s.d2[q][b] * before[d][b];
            b_1[d] += s.d1[q][b] * after[d][b];
            b_2[d] += s.d2[q][b] * after[d][b];
          }
      if (!(internal::same_side(a_1, a_2, b_1, b_2) > 0.))
        return false;
    }
  return true;
}

} // namespace sherd
