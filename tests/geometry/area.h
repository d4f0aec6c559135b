#pragma once

#include <sherd/geometry/element_geometry.h>

namespace sherd::test
{

/// Area of the reference surface by the quadrature of its elements.
template <int degree, int spacedim>
double area(const Surface<degree, spacedim> &surface)
{
  double sum = 0.;
  for (int e = 0; e < surface.n_elements(); ++e)
    for (const auto &q : element_geometry(surface, e).reference)
      sum += q.dA;
  return sum;
}

} // namespace sherd::test
