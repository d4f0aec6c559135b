#pragma once

#include <sherd/time/integrator.h>

namespace sherd
{

/// No inertia: every step ends in a static equilibrium f_int(x_{n+1}, phi_{n+1}) = f_ext(t_{n+1}, x_{n+1}), and time
/// only orders loads and supports. The body has to be held, also when it is broken.
///
/// Source: theory F.2.
struct QuasiStatic
{
  Stages stages(double dt, double) const { return {newmark_stage(dt, 0., 1., 1., 1.)}; }
};

static_assert(ImplicitIntegrator<QuasiStatic>);

} // namespace sherd
