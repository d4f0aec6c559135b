#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/time/integrator.h>

namespace sherd
{

/// Bathe's scheme: the trapezoidal rule to t_n + split dt, then backward differences over the three points t_n,
/// t_n + split dt, t_{n+1}:
///
///   v_{n+1} = w_0 v_n + w_1 v_split + gamma dt a_{n+1},  x_{n+1} = w_0 x_n + w_1 x_split + gamma dt v_{n+1},
///   w_1 = 1 / (split (2 - split)),  w_0 = 1 - w_1,  gamma = (1 - split) / (2 - split).
///
/// Second order whatever the steps do, since nothing older than t_n enters; the highest frequencies die in one step
/// (rho_inf = 0), low ones lose little. Both stages solve for displacement and phase at their own end, and the second
/// one remembers the history of the first. With the default split 2 - sqrt(2) both have the same weight of the mass, so
/// that they can share a tangent, and the error is least; 1/2 is the original choice.
///
/// Source: theory F.
class Bathe
{
public:
  /// @throws InvalidParameter   unless 0 < split < 1
  explicit Bathe(double split = 0.58578643762690495) : split_(split)
  {
    if (!(split > 0. && split < 1.))
      throw InvalidParameter("Bathe: split = " + print(split) +
                             ", expected a part of the step in (0, 1); the default is 2 - sqrt(2)");
  }

  Stages stages(double dt, double) const
  {
    const double gamma = (1. - split_) / (2. - split_);
    const double w_1 = 1. / (split_ * (2. - split_)), w_0 = 1. - w_1;
    return {newmark_stage(split_ * dt, 1., 1., .5, .25),
            {dt, 1., 1., gamma, gamma * gamma, {w_0, gamma * w_0, 0., w_0, 0.}, {w_1, gamma * w_1, 0., w_1, 0.}}};
  }

private:
  double split_;
};

static_assert(ImplicitIntegrator<Bathe>);

} // namespace sherd
