#pragma once

#include <sherd/fracture/crack_density/second_order.h>
#include <sherd/fracture/degradation/degradation.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// The false branch of the phase equation, theory C.2.
///
/// Where g is concave at phi = 1 and the driving energy is above the onset, the phase equation has a second, unstable
/// solution slightly above 1, and Newton's method from the intact state converges to it. A converged iteration is
/// therefore checked, and repeated with a modified stiffness where it fails the check.
namespace sherd::branch
{

/// Above this phase a loaded point may lie on the false branch.
inline constexpr double suspect_phase = 1. - 1e-3;

/// Largest change of the phase in one iteration of a branch switch.
inline constexpr double largest_phase_step = .3;

/// Driving energy -Gc w''(1) / (4 l0 g''(1)) above which the intact state is unstable; infinite where g''(1) >= 0.
/// For the cubic function with small s and the densities of second and fourth order this is Gc / (12 l0).
template <Degradation Function, CrackDensity Density>
inline double onset(const Function &g, const Density &density, const double Gc, const double l0)
{
  const double curvature = g.second(1.);
  return curvature < 0. ? -Gc * density.local_second(1.) / (4. * l0 * curvature)
                        : std::numeric_limits<double>::infinity();
}

/// Whether a point with driving energy H and phase phi may lie on the false branch.
///
/// Being suspect is no verdict: stress concentrations smaller than l0 are suspect and sound, and a phase above 1 alone
/// is normal for the fourth-order density. The verdict is the definiteness of the phase stiffness over the control
/// points around suspect points.
template <Degradation Function, CrackDensity Density>
inline bool is_suspect(const Function &g, const Density &density, const double history, const double phi,
                       const double Gc, const double l0)
{
  return history > onset(g, density, Gc, l0) && phi > suspect_phase;
}

/// Factor of N_A N_B in the consistent phase stiffness, kappa = g'' H + Gc w'' / (4 l0), where w'' / 2 is 1 for the
/// densities of second and fourth order (theory E.2).
template <Degradation Function, CrackDensity Density>
inline double stiffness(const Function &g, const Density &density, const double history, const double phi,
                        const double Gc, const double l0)
{
  return g.second(phi) * history + .5 * density.local_second(phi) * (Gc / (2. * l0));
}

/// The same factor during a branch switch, max(|kappa|, 0.02 Gc / (2 l0)): always positive, so that the iteration
/// leaves the unstable state downhill.
template <Degradation Function, CrackDensity Density>
inline double switched_stiffness(const Function &g, const Density &density, const double history, const double phi,
                                 const double Gc, const double l0)
{
  return std::max(std::abs(stiffness(g, density, history, phi, Gc, l0)), .02 * Gc / (2. * l0));
}

/// Those of densities of second and fourth order.
template <Degradation Function>
inline double onset(const Function &g, const double Gc, const double l0)
{
  return onset(g, crack_density::SecondOrder{}, Gc, l0);
}
template <Degradation Function>
inline bool is_suspect(const Function &g, const double history, const double phi, const double Gc, const double l0)
{
  return is_suspect(g, crack_density::SecondOrder{}, history, phi, Gc, l0);
}
template <Degradation Function>
inline double stiffness(const Function &g, const double history, const double phi, const double Gc, const double l0)
{
  return stiffness(g, crack_density::SecondOrder{}, history, phi, Gc, l0);
}
template <Degradation Function>
inline double switched_stiffness(const Function &g, const double history, const double phi, const double Gc,
                                 const double l0)
{
  return switched_stiffness(g, crack_density::SecondOrder{}, history, phi, Gc, l0);
}

} // namespace sherd::branch
