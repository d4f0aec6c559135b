#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/kinematics/surface_point.h>
#include <sherd/space/continuity.h>

namespace sherd::internal
{

/// c or D that scales the penalty of the angle, theory G.3; 0 in the plane and for membranes.
template <class Model>
double bending_stiffness(const Model &model)
{
  if constexpr (Model::spacedim == 3)
    return model.split.bending().stiffness();
  else
    return 0.;
}

/// Share of the bending energy that a crack leaves, in [0, 1]: that of a flat sheet bent to a sphere of @p radius, to
/// the side on which it is larger. Half with layers, none where all of bending is active.
template <class Model>
double lasting_bending(const Model &model, double radius)
{
  double share = 0.;
  if constexpr (Model::spacedim == 3)
    {
      const Metric            flat = metric(Voigt(1., 1., 0.));
      const ReferencePoint<3> reference(flat, Voigt::Zero());
      for (const double curvature : {1. / radius, -1. / radius})
        {
          const auto response = model.split.respond(SurfacePoint<3>(reference, flat, Voigt(curvature, curvature, 0.)));
          if (const double total = response.energy_active + response.energy_passive; total > 0.)
            share = std::max(share, response.energy_passive / total);
        }
    }
  return share;
}

/// beta of theory G.3: @p given, or @p otherwise if that is 0. @param where   begins the message
/// @throws InvalidParameter   a factor that is negative or not finite
inline double penalty_factor(double given, double otherwise, const std::string &where)
{
  if (!(given >= 0. && std::isfinite(given)))
    throw InvalidParameter(where + ": factor " + print(given) + ", expected a positive one, or 0 for the default of " +
                           print(otherwise));
  return given > 0. ? given : otherwise;
}

/// eps of the angle [force], theory G.3. @param size   h of the elements across the edge
inline double angle_penalty(double beta, double bending_stiffness, double size)
{
  return beta * bending_stiffness / size;
}

/// eps of the phase [energy * length], theory G.3.
inline double phase_penalty(double beta, double toughness, double length_scale, double size)
{
  return beta * toughness * length_scale * length_scale * length_scale / (2. * size);
}

} // namespace sherd::internal
