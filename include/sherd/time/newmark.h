#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/time/integrator.h>

namespace sherd
{

/// Newmark's scheme, balanced at the end of the step. The default is the trapezoidal rule, second order also under
/// changing steps; gamma > 1/2 damps and is of first order.
///
/// Source: theory F.
class Newmark
{
public:
  /// @throws InvalidParameter   unless 2 beta >= gamma >= 1/2 (unconditional stability)
  explicit Newmark(double beta = .25, double gamma = .5) : beta_(beta), gamma_(gamma)
  {
    if (!(gamma >= .5 && 2. * beta >= gamma))
      throw InvalidParameter("Newmark: beta = " + print(beta) + ", gamma = " + print(gamma) +
                             ", expected 2 beta >= gamma >= 1/2; the trapezoidal rule is beta = 1/4, gamma = 1/2");
  }

  Stages stages(double dt, double) const { return {newmark_stage(dt, 1., 1., gamma_, beta_)}; }

private:
  double beta_, gamma_;
};

static_assert(ImplicitIntegrator<Newmark>);

} // namespace sherd
