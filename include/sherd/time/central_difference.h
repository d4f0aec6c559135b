#pragma once

#include <sherd/time/integrator.h>

namespace sherd
{

/// Central differences:
///
///   x_{n+1} = x_n + dt v_n + dt^2 a_n / 2,  v_{n+1} = v_n + dt (a_n + a_{n+1}) / 2,
///
/// with a_{n+1} from the balance at x_{n+1}. Explicit, second order, no dissipation, stable for dt < 2 / omega_max: see
/// ExplicitSolver.
///
/// Source: theory F.5.
struct CentralDifference
{
  static constexpr bool is_explicit = true;

  Stages stages(double dt, double) const { return {newmark_stage(dt, 1., 1., .5, 0.)}; }
};

static_assert(ExplicitIntegrator<CentralDifference>);

} // namespace sherd
