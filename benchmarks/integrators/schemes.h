#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sherd/time/any_integrator.h>
#include <sherd/time/backward_euler.h>
#include <sherd/time/bathe.h>
#include <sherd/time/generalized_alpha.h>
#include <sherd/time/hht.h>
#include <sherd/time/implicit_midpoint.h>
#include <sherd/time/newmark.h>
#include <sherd/time/wbz.h>

namespace sherd::integrators
{

/// An implicit integrator and what it is called.
struct Scheme
{
  std::string   name;
  AnyIntegrator integrator;
};

inline const std::vector<Scheme> &schemes()
{
  static const std::vector<Scheme> all{{"generalized_alpha_0.5", GeneralizedAlpha(.5)},
                                       {"generalized_alpha_0", GeneralizedAlpha(0.)},
                                       {"generalized_alpha_0.8", GeneralizedAlpha(.8)},
                                       {"plain_generalized_alpha_0.5", PlainGeneralizedAlpha(.5)},
                                       {"hht_0.1", HHT(-.1)},
                                       {"wbz_0.5", WBZ(.5)},
                                       {"trapezoid", Newmark()},
                                       {"midpoint", ImplicitMidpoint()},
                                       {"newmark_0.6", Newmark(.3025, .6)},
                                       {"bathe", Bathe()},
                                       {"backward_euler", BackwardEuler()}};
  return all;
}

/// How the nonlinear system of a step is solved.
enum class Method
{
  newton,
  line_search,
  lagged_history,
  modified,
  staggered,
  explicit_scheme ///< central differences: no system for the displacement
};

inline const std::vector<std::pair<std::string, Method>> &methods()
{
  static const std::vector<std::pair<std::string, Method>> all{
      {"newton", Method::newton},     {"line_search", Method::line_search}, {"lagged_history", Method::lagged_history},
      {"modified", Method::modified}, {"staggered", Method::staggered},     {"explicit", Method::explicit_scheme}};
  return all;
}

} // namespace sherd::integrators
