#pragma once

#include <sherd/fracture/crack_density/crack_density.h>
#include <sherd/verify/report.h>

#include <array>
#include <cmath>

namespace sherd::verify
{

/// Checks a crack density: its own profile is broken at the crack and intact far away, and costs exactly Gc by unit
/// length of crack (theory C.1).
///
/// The energy is integrated over both sides of the crack, with 60 panels of 5 Gauss points out to 60 l0 and
/// fourth-order difference quotients of the profile, which together are right to about 1e-9.
/// @param l0  any length; the result does not depend on it.
template <CrackDensity Density>
Report crack_density(const Density &density, const double l0 = .7)
{
  constexpr std::array<double, 5> points{-.906179845938664, -.538469310105683, 0., .538469310105683, .906179845938664};
  constexpr std::array<double, 5> weights{.236926885056189, .478628670499366, .568888888888889, .478628670499366,
                                          .236926885056189};
  constexpr int                   n_panels = 60;
  constexpr double                step     = 2e-3;

  // Panels grow towards the far end; the first is wide enough for the difference quotients.
  double energy = 0.;
  for (int panel = 0; panel < n_panels; ++panel)
    {
      const auto   edge = [&](const int i) { return 60. * std::pow(static_cast<double>(i) / n_panels, 1.3); };
      const double low = edge(panel), high = edge(panel + 1);
      for (std::size_t q = 0; q < points.size(); ++q)
        {
          const double r     = .5 * (low + high + points[q] * (high - low));
          const auto   phi   = [&](const int i) { return density.profile(r + i * step); };
          const double slope = (8. * (phi(1) - phi(-1)) - (phi(2) - phi(-2))) / (12. * step * l0);
          const double curving =
              (16. * (phi(1) + phi(-1)) - (phi(2) + phi(-2)) - 30. * phi(0)) / (12. * step * step * l0 * l0);
          energy += weights[q] * (high - low) * l0 * crack_energy(density, 1., l0, phi(0), slope * slope, curving);
        }
    }

  Report report;
  report.add("profile is 0 at the crack", std::abs(density.profile(0.)), 1e-15);
  report.add("profile is 1 far away", std::abs(density.profile(100.) - 1.), 1e-15);
  report.add("profile costs Gc", std::abs(energy - 1.), 1e-8);
  report.add("c2 = 0 for order 2", Density::order == 2 ? std::abs(density.c2(l0)) : 0., 0.);
  return report;
}

} // namespace sherd::verify
