#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/checks.h>

namespace sherd::shapes
{

/// Flat rectangle [0, size_x] x [0, size_y] (z = 0), elements[0] x elements[1] equal elements, parameters
/// [0, elements[0]] x [0, elements[1]]; edges "left", "right" (x = 0, size_x), "bottom", "top" (y = 0, size_y).
///
/// Control points at the Greville abscissae, so that X is linear in the parameters. Source: theory I.
/// @throws InvalidParameter   a size that is not positive and finite, less than one element
template <int degree, int spacedim>
Surface<degree, spacedim> plate(const std::array<double, 2> &size, const std::array<int, 2> &elements)
{
  for (int d = 0; d < 2; ++d)
    internal::check_length("plate: size[" + std::to_string(d) + "]", size[d]);
  internal::check_elements("plate", elements);
  LRBasis<degree>         basis(uniform_knots<degree>(elements[0]), uniform_knots<degree>(elements[1]));
  const int               n      = basis.n_functions();
  ControlValues<spacedim> points = ControlValues<spacedim>::Zero(n, spacedim);
  for (int i = 0; i < n; ++i)
    for (int d = 0; d < 2; ++d)
      {
        double greville = 0.;
        for (int k = 1; k <= degree; ++k)
          greville += basis.function(i).knots[d][k];
        points(i, d) = greville / degree * size[d] / elements[d];
      }
  using PatchType = Patch<degree, spacedim>;
  return Surface<degree, spacedim>({PatchType{std::move(basis), std::move(points), Eigen::VectorXd::Ones(n)}},
                                   name_sides("left", "right", "bottom", "top"));
}

} // namespace sherd::shapes
