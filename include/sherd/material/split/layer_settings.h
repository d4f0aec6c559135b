#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/split/thickness_weight.h>

#include <cmath>

namespace sherd
{

/// What the stress knows of the moving boundary between stretched and compressed layers, theory B.4 (2).
enum class Cut
{
  frozen, ///< layers keep their sign while the energy is differentiated: no artificial stress where the layer energy
          ///< jumps; not the gradient of an energy, and a tangent without symmetry, while cuts move and g < 1
  kept    ///< exact gradient of the energy, symmetric tangent
};

/// Whether the tangent has the derivatives of the weight.
enum class CutTangent
{
  full,   ///< derivative of the stress
  dropped ///< weight held fixed: symmetric with a frozen cut, but Newton's method loses its quadratic convergence
};

/// How a split looks into the thickness of a shell.
struct LayerSettings
{
  double      thickness = 0.;                ///< T [length], positive
  LayerMetric metric    = LayerMetric::full; ///< of a layer
  Cut         cut       = Cut::frozen;
  CutTangent  tangent   = CutTangent::full;
  int         n_points  = 0; ///< Gauss points in the thickness, at least 2; 0: closed form
};

/// @throws InvalidParameter  unless the thickness is positive and finite and n_points is 0 or at least 2.
inline void require_valid(const LayerSettings &layers)
{
  if (!(std::isfinite(layers.thickness) && layers.thickness > 0.))
    throw InvalidParameter("layers of a shell: thickness " + print(layers.thickness) + " must be positive and finite");
  if (layers.n_points < 0 || layers.n_points == 1)
    throw InvalidParameter("layers of a shell: " + print(layers.n_points) +
                           " Gauss points given; 0 chooses the closed form, a rule needs at least 2");
}

} // namespace sherd
