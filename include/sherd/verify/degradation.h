#pragma once

#include <sherd/fracture/degradation/degradation.h>
#include <sherd/verify/report.h>

#include <algorithm>
#include <cmath>

namespace sherd::verify
{

/// Checks a degradation function: both derivatives on [-0.1, 1.1], g(0) = 0, g(1) = 1, g'(0) = 0, g' >= 0 on [0, 1]
/// (theory C.2).
template <Degradation Function>
Report degradation(const Function &g)
{
  Report report;
  report.add("g(0) = 0", std::abs(g.value(0.)), 1e-15);
  report.add("g(1) = 1", std::abs(g.value(1.) - 1.), 1e-15);
  report.add("g'(0) = 0", std::abs(g.first(0.)), 1e-15);
  for (int i = -2; i <= 22; ++i)
    {
      const double phi = .05 * i;
      report.add("g' is the derivative of g",
                 check_derivative([&](const double h) { return g.value(phi + h); }, g.first(phi)));
      report.add("g'' is the derivative of g'",
                 check_derivative([&](const double h) { return g.first(phi + h); }, g.second(phi)));
      if (phi >= 0. && i <= 20)
        report.add("g rises on [0, 1]", std::max(0., -g.first(std::min(phi, 1.))), 1e-15);
    }
  return report;
}

} // namespace sherd::verify
