#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/base/print.h>
#include <sherd/solve/static_solver.h>

namespace sherd
{

/// How the load factor goes from one end to the other.
struct LoadStepSettings
{
  double first             = .05;  ///< first step of the load factor
  double largest           = .1;   ///< largest step
  double smallest          = 1e-5; ///< a failed step smaller than this ends the run
  int    wanted_iterations = 8;    ///< steps grow while Newton takes fewer iterations, and shrink beyond

  void declare(ParameterSection &section)
  {
    section.value("first", first, "-", range::positive(), "first step of the load factor, if not above the largest");
    section.value("largest", largest, "-", range::positive(), "largest step of the load factor");
    section.value("smallest", smallest, "-", range::positive(), "a failed step smaller than this ends the run");
    section.value("wanted_iterations", wanted_iterations, range::at_least(1),
                  "steps grow while Newton takes fewer iterations, and shrink beyond");
  }
};

/// Takes @p start from its load factor (its time) to @p end by load control. Steps are halved when there is no
/// equilibrium close by; a snap-through is jumped over if Newton finds the state beyond it (ArcLength follows it).
/// @param observe   called as observe(state, iterations) after each step
/// @throws NoConvergence   when the smallest step fails: at a limit point, for example
template <class Model, class Observer>
typename StaticSolver<Model>::StateType follow_loads(StaticSolver<Model>                           &solver,
                                                     const typename StaticSolver<Model>::StateType &start, double end,
                                                     const LoadStepSettings &settings, const Observer &observe)
{
  auto         state     = start;
  const double direction = end >= start.time ? 1. : -1.;
  double       step      = std::min(settings.first, settings.largest);
  while (state.time != end)
    {
      const double remaining = std::abs(end - state.time);
      const double target    = step >= remaining * (1. - 1e-9) ? end : state.time + direction * step;
      auto         result    = solver.solve(state, target);
      if (result.state)
        {
          state = std::move(*result.state);
          observe(state, result.iterations);
          step *= std::clamp(std::sqrt(settings.wanted_iterations / static_cast<double>(result.iterations)), .5, 1.5);
          step = std::min(step, settings.largest);
        }
      else
        {
          step = .5 * std::min(step, remaining);
          if (step < settings.smallest)
            throw NoConvergence("load stepping: no equilibrium beyond load factor " + print(state.time) +
                                " with steps of " + print(2. * step) + " (" + result.failure +
                                "); at a limit point of the load use the arc length");
        }
    }
  return state;
}

} // namespace sherd
