#pragma once

#include <cmath>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/time/integrator.h>

namespace sherd
{

/// Central differences:
///
///   x_{n+1} = x_n + dt v_n + dt^2 a_n / 2,  v_{n+1} = v_n + dt (a_n + a_{n+1}) / 2,
///
/// with a_{n+1} from the balance at x_{n+1}. Explicit, second order, no dissipation, stable for dt < 2 / omega_max: see
/// ExplicitSolver. With a damping xi > 0 the balance has the force b K v_{n+1/2}, b = 2 xi / omega_max, too: it damps a
/// frequency omega by the share xi omega / omega_max of critical damping, and leaves slow motions alone. Then
///
///   dt < 2 / omega_max (sqrt(1 + xi^2) - xi),
///
/// since the velocity is half a step late.
///
/// Source: theory F.5.
class CentralDifference
{
public:
  static constexpr bool is_explicit = true;

  /// @param damping   xi, share of critical damping at the largest frequency
  /// @throws InvalidParameter   unless 0 <= damping < 1
  explicit CentralDifference(double damping = 0.) : damping_(damping)
  {
    if (!(damping >= 0. && damping < 1.))
      throw InvalidParameter("CentralDifference: damping = " + print(damping) +
                             ", expected a value in [0, 1), the share of critical damping at the largest frequency; "
                             "0 does not dissipate, 0.05 is usual");
  }

  Stages stages(double dt, double) const { return {newmark_stage(dt, 1., 1., .5, 0.)}; }

  /// Largest stable step where the largest frequency is @p omega [1/time].
  double largest_step(double omega) const { return 2. / omega * (std::sqrt(1. + damping_ * damping_) - damping_); }

  /// b, the factor of the stiffness in the damping force [time]; 0 where nothing can vibrate.
  double stiffness_factor(double omega) const { return omega > 0. ? 2. * damping_ / omega : 0.; }

private:
  double damping_;
};

static_assert(ExplicitIntegrator<CentralDifference>);

} // namespace sherd
