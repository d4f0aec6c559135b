#pragma once

#include <sherd/base/types.h>

namespace sherd
{

/// The solution at one time, complete on the rank that holds it: one row a control point, in the surface's numbering.
template <int spacedim>
struct Snapshot
{
  double                  time = 0.;
  ControlValues<spacedim> position; ///< x, shape=(n_control_points, spacedim)
  ControlValues<spacedim> velocity; ///< v, shape=(n_control_points, spacedim)
  Eigen::VectorXd         phase;    ///< phi, shape=(n_control_points)
};

} // namespace sherd
