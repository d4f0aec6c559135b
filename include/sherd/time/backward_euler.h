#pragma once

#include <sherd/time/integrator.h>

namespace sherd
{

/// Backward Euler: v_{n+1} = v_n + dt a_{n+1}, x_{n+1} = x_n + dt v_{n+1}, balanced at the end of the step. First
/// order, kills high frequencies in one step. It is no scheme of Newmark: beta = gamma = 1 would leave -dt^2 a_n / 2 in
/// x.
///
/// Source: theory F.
struct BackwardEuler
{
  Stages stages(double dt, double) const { return {{dt, 1., 1., 1., 1., {1., 1., 0., 1., 0.}}}; }
};

static_assert(ImplicitIntegrator<BackwardEuler>);

} // namespace sherd
