#pragma once

#include <concepts>
#include <functional>

#include <sherd/time/integrator.h>

namespace sherd
{

/// An implicit integrator that is chosen at run time. It costs nothing that could be measured: it is asked once a step.
class AnyIntegrator
{
public:
  template <ImplicitIntegrator Rule>
  requires(!std::same_as<Rule, AnyIntegrator>) AnyIntegrator(const Rule &rule)
      : stages_([rule](double dt, double previous_dt) { return rule.stages(dt, previous_dt); })
  {
  }

  Stages stages(double dt, double previous_dt) const { return stages_(dt, previous_dt); }

private:
  std::function<Stages(double, double)> stages_;
};

static_assert(ImplicitIntegrator<AnyIntegrator>);

} // namespace sherd
