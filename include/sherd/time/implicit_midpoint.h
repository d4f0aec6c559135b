#pragma once

#include <sherd/time/integrator.h>

namespace sherd
{

/// Implicit midpoint rule, the same as generalized-alpha with rho_inf = 1: momentum and phase are balanced in the
/// middle of the step. It does not dissipate and is of second order, also under changing steps.
///
/// Source: theory F.
struct ImplicitMidpoint
{
  Stages stages(double dt, double) const { return {newmark_stage(dt, .5, .5, .5, .25)}; }
};

static_assert(ImplicitIntegrator<ImplicitMidpoint>);

} // namespace sherd
