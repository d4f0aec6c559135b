#pragma once

#include <array>
#include <cmath>

#include <sherd/base/print.h>
#include <sherd/geometry/surface.h>

/// Surfaces by name. Each is one function that returns a Surface with named edges.
namespace sherd::shapes
{

/// Open knot vector with unit spans on [0, n].
template <int degree>
std::vector<double> uniform_knots(int n)
{
  std::vector<double> knots(degree, 0.);
  for (int i = 0; i <= n; ++i)
    knots.push_back(i);
  knots.insert(knots.end(), degree, n);
  return knots;
}

/// Flat rectangle [0, size_x] x [0, size_y] (z = 0), elements[0] x elements[1] equal elements, parameters
/// [0, elements[0]] x [0, elements[1]]; edges "left", "right" (x = 0, size_x), "bottom", "top" (y = 0, size_y).
///
/// Control points at the Greville abscissae, so that X is linear in the parameters. Source: theory I.
/// @throws InvalidParameter   a size that is not positive and finite, less than one element
template <int degree, int spacedim>
Surface<degree, spacedim> plate(const std::array<double, 2> &size, const std::array<int, 2> &elements)
{
  for (int d = 0; d < 2; ++d)
    {
      if (!(std::isfinite(size[d]) && size[d] > 0.))
        throw InvalidParameter("plate: size[" + std::to_string(d) + "] = " + print(size[d]) +
                               ", expected a finite length > 0");
      if (elements[d] < 1)
        throw InvalidParameter("plate: elements[" + std::to_string(d) + "] = " + std::to_string(elements[d]) +
                               ", expected at least 1");
    }
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
                                   {{"left", {{0, Side::u_min}}},
                                    {"right", {{0, Side::u_max}}},
                                    {"bottom", {{0, Side::v_min}}},
                                    {"top", {{0, Side::v_max}}}});
}

} // namespace sherd::shapes
