#pragma once

#include <sherd/fracture/degradation/degradation.h>
#include <sherd/verify/report.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sherd::verify
{

/// Checks a degradation function: both derivatives on [-0.1, 1.1], g(0) = 0 or the residual() of the function,
/// g(1) = 1, g'(0) = 0, g' >= 0 on [0, 1] (theory C.2).
///
/// `CHECK(verify::degradation(my_function).passed())` is a test of a new one.
template <Degradation Function>
Report degradation(const Function &g)
{
  constexpr double step    = 2e-3; // on which functions as steep as g'(1) = 100 are smooth
  constexpr int    n_steps = 11;
  Report           report;
  if constexpr (requires { g.residual(); })
    report.add("g(0) is the residual", std::abs(g.value(0.) - g.residual()), 1e-15);
  else
    report.add("g(0) = 0", std::abs(g.value(0.)), 1e-15);
  report.add("g(1) = 1", std::abs(g.value(1.) - 1.), 1e-15);
  report.add("g'(0) = 0", std::abs(g.first(0.)), 1e-15);
  // The straight line added sets the scale of the comparison where values or derivatives vanish.
  for (int i = -2; i <= 22; ++i)
    {
      const double      phi   = .05 * i + (i == 20 ? -1e-2 : 0.); // a function may go on differently above 1
      const std::string where = "phi = " + print(phi);
      report.add("g' is the derivative of g",
                 check_derivative([&](const double h) { return 10. + h + g.value(phi + h); }, 1. + g.first(phi), step,
                                  n_steps),
                 where);
      report.add("g'' is the derivative of g'",
                 check_derivative([&](const double h) { return 10. + h + g.first(phi + h); }, 1. + g.second(phi), step,
                                  n_steps),
                 where);
      if (phi >= 0. && i <= 20)
        report.add("g rises on [0, 1]", std::max(0., -g.first(std::min(phi, 1.))), 1e-15, where);
    }
  return report;
}

} // namespace sherd::verify
