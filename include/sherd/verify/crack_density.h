#pragma once

#include <sherd/fracture/crack_density/crack_density.h>
#include <sherd/verify/report.h>

#include <array>
#include <algorithm>
#include <cmath>
#include <string>

namespace sherd::verify
{

/// Checks a crack density: the derivatives of its local part, which is zero and least in the intact state; its own
/// profile is broken at the crack and intact far away, and costs exactly Gc by unit length of crack (theory C.1).
///
/// The energy is integrated over both sides of the crack, with panels of 5 Gauss points out to 60 l0 and fourth-order
/// difference quotients of the profile, which together are right to 1e-7 even where the third derivative of a profile
/// jumps. `CHECK(verify::crack_density(my_density).passed())` is a test of a new one.
/// @param l0  any length; the result does not depend on it.
template <CrackDensity Density>
Report crack_density(const Density &density, const double l0 = .7)
{
  constexpr std::array<double, 5> points{-.906179845938664, -.538469310105683, 0., .538469310105683, .906179845938664};
  constexpr std::array<double, 5> weights{.236926885056189, .478628670499366, .568888888888889, .478628670499366,
                                          .236926885056189};
  constexpr int                   n_panels = 3000;
  constexpr double                step     = 4e-4; // the first point is farther from the crack than two of them

  double energy = 0.;
  for (int panel = 0; panel < n_panels; ++panel)
    {
      const double low = 60. * panel / n_panels, high = 60. * (panel + 1) / n_panels;
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

  // The straight line added sets the scale of the comparison where values or derivatives vanish.
  Report report;
  for (int i = -2; i <= 22; ++i)
    {
      const double      phi = .05 * i, h = 1e-4;
      const std::string where = "phi = " + print(phi);
      const double      jump  = density.local_second(phi + 1.5 * h) - density.local_second(phi - 1.5 * h);
      if (std::abs(jump) > .1 * (1. + std::abs(density.local_second(phi))))
        continue; // w' has a kink
      report.add("w' is the derivative of w",
                 check_derivative([&](const double x) { return 10. + x + density.local(phi + x); },
                                  1. + density.local_first(phi), h, 8),
                 where);
      report.add("w'' is the derivative of w'",
                 check_derivative([&](const double x) { return 10. + x + density.local_first(phi + x); },
                                  1. + density.local_second(phi), h, 8),
                 where);
      report.add("w >= 0", std::max(0., -density.local(phi)), 0., where);
    }
  report.add("w(1) = w'(1) = 0", std::abs(density.local(1.)) + std::abs(density.local_first(1.)), 1e-15);
  report.add("profile is 0 at the crack", std::abs(density.profile(0.)), 1e-15);
  report.add("profile is 1 far away", std::abs(density.profile(100.) - 1.), 1e-15);
  report.add("profile costs Gc", std::abs(energy - 1.), 1e-6);
  report.add("c2 = 0 for order 2", Density::order == 2 ? std::abs(density.c2(l0)) : 0., 0.);
  return report;
}

} // namespace sherd::verify
