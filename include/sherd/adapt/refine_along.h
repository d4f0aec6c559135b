#pragma once

#include <cmath>
#include <vector>

#include <sherd/adapt/marking.h>
#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/polyline.h>

namespace sherd
{

/// Refines @p surface to elements of @p target or shorter where it is within @p width of a line, for example where a
/// crack is expected to run at once: in a quasi-static step that is unstable a front does not wait for the mesh, and
/// the step would have to be repeated. Call it before a space is built, or rebuilt, on the surface; later refinement
/// (Adaptivity) goes on from there. Distances are measured through space, also where the surface is curved.
/// @param width    [length], 0: only the elements that the line crosses
/// @param target   [length], as RefinementSettings::target
/// @throws InvalidParameter   unless width >= 0 and target > 0 are finite
template <int degree, int spacedim>
void refine_along(Surface<degree, spacedim> &surface, const Polyline<spacedim> &line, double width, double target)
{
  if (!(width >= 0. && std::isfinite(width)))
    throw InvalidParameter("refine_along: width = " + print(width) +
                           ", expected how far from the line the mesh is fine, a finite length >= 0");
  if (!(target > 0. && std::isfinite(target)))
    throw InvalidParameter("refine_along: target = " + print(target) +
                           ", expected an element size > 0, at most half the length scale");
  const auto targets = span_targets(surface, target);
  for (;;)
    {
      std::vector<int> marked;
      const auto       X = surface.control_points();
      for (const int point : coarse_points(surface, targets))
        {
          const Point<spacedim> position = X.row(point).transpose();
          const auto [p, i]              = surface.locate_point(point);
          // The line may run between the control points of coarse functions.
          if (distance(position, line) <= width + target * reach(surface.patch(p).basis.function(i), targets[p]))
            marked.push_back(point);
        }
      if (marked.empty())
        return;
      surface.refine_to(marked, targets);
    }
}

} // namespace sherd
