#include <sherd/driver/run_parameters.h>

#include <sherd/time/backward_euler.h>
#include <sherd/time/bathe.h>
#include <sherd/time/generalized_alpha.h>
#include <sherd/time/hht.h>
#include <sherd/time/implicit_midpoint.h>
#include <sherd/time/newmark.h>
#include <sherd/time/quasi_static.h>
#include <sherd/time/wbz.h>

#include "given.h"

namespace sherd
{

void TimeParameters::declare(ParameterSection &section)
{
  section.choice("integrator", integrator,
                 {"generalized_alpha", "newmark", "hht", "wbz", "bathe", "implicit_midpoint", "backward_euler",
                  "quasi_static", "central_difference"},
                 "time integrator; quasi_static: no inertia; central_difference: explicit");
  section.value("rho_inf", rho_inf, "-", range::closed(0., 1.),
                "spectral radius of generalized_alpha and wbz (none: 0.5)");
  section.value("alpha", alpha, "-", range::closed(-1. / 3., 0.), "of hht (none: -0.1)");
  section.value("beta", beta, "-", range::positive(), "of newmark (none: 1/4)");
  section.value("gamma", gamma, "-", range::at_least(.5), "of newmark (none: 1/2)");
  section.value("damping", damping, "-", range::right_open(0., 1.),
                "of central_difference, share of critical damping at the largest frequency (none: 0)");
  section.value("end", end, "time", range::positive(), "end of the run");
  section.value("largest_step", largest_step, "time", range::positive(),
                "no step is longer; none: the bound of step control alone, and none for quasi_static");
  section.subsection("steps", steps, "step sizes, paper Eq. (13)");
}

namespace
{
void check(const TimeParameters &time, const std::initializer_list<std::string> &allowed)
{
  internal::check_given("time: integrator = " + time.integrator,
                        {{"rho_inf", time.rho_inf.has_value()},
                         {"alpha", time.alpha.has_value()},
                         {"beta", time.beta.has_value()},
                         {"gamma", time.gamma.has_value()},
                         {"damping", time.damping.has_value()}},
                        {}, allowed);
}
} // namespace

AnyIntegrator TimeParameters::make_integrator() const
{
  if (integrator == "generalized_alpha")
    {
      check(*this, {"rho_inf"});
      return GeneralizedAlpha(rho_inf.value_or(.5));
    }
  if (integrator == "wbz")
    {
      check(*this, {"rho_inf"});
      return WBZ(rho_inf.value_or(.5));
    }
  if (integrator == "hht")
    {
      check(*this, {"alpha"});
      return HHT(alpha.value_or(-.1));
    }
  if (integrator == "newmark")
    {
      check(*this, {"beta", "gamma"});
      return Newmark(beta.value_or(.25), gamma.value_or(.5));
    }
  check(*this, {});
  if (integrator == "bathe")
    return Bathe();
  if (integrator == "implicit_midpoint")
    return ImplicitMidpoint();
  if (integrator == "backward_euler")
    return BackwardEuler();
  return QuasiStatic();
}

CentralDifference TimeParameters::make_explicit() const
{
  check(*this, {"damping"});
  return CentralDifference(damping.value_or(0.));
}

void StopParameters::declare(ParameterSection &section)
{
  section.value("crack_at", crack_at, "edges: the run ends when the phase is below the threshold on one of them");
  section.value("threshold", threshold, "-", range::open(0., 1.), "of the phase, for crack_at");
  section.value("crack_length", crack_length, "length", range::positive(), "ends when the cracks are that long");
  section.value("elastic_share", elastic_share, "-", range::open(0., 1.),
                "ends when the elastic energy has fallen to this share of its largest value: the body is broken");
  section.value("steps", steps, range::at_least(0), "ends after that many accepted steps; 0: no limit");
}

} // namespace sherd
