#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/crack_density/second_order.h>
#include <sherd/fracture/degradation/degradation.h>

#include <cmath>

namespace sherd
{

/// Driving energy H that holds a homogeneous body at the phase phi, theory D:
///
///   H = -Gc w'(phi) / (4 l0 g'(phi)),
///
/// which is Gc (1 - phi) / (2 l0 g'(phi)) for the densities of second and fourth order.
/// @param phi  in (0, 1].
/// @throws InvalidParameter  for a phase outside.
template <Degradation Function, CrackDensity Density>
inline double homogeneous_history(const Function &g, const Density &density, const double phi, const double Gc,
                                  const double l0)
{
  if (!(phi > 0. && phi <= 1.))
    throw InvalidParameter("homogeneous state: phase " + print(phi) + " must lie in (0, 1]");
  return -Gc * density.local_first(phi) / (4. * l0 * g.first(phi));
}

/// The same for densities of second and fourth order.
template <Degradation Function>
inline double homogeneous_history(const Function &g, const double phi, const double Gc, const double l0)
{
  return homogeneous_history(g, crack_density::SecondOrder{}, phi, Gc, l0);
}

/// Stable phase of a homogeneous body under the driving energy H, theory C.3: the root in [0, 1] of
///
///   2 l0 / Gc g'(phi) H + w'(phi) / 2 = 0
///
/// at which the left side rises; w' / 2 is phi - 1 for densities of second and fourth order. It is bisected to the last
/// bit, so that the false root above 1, to which Newton's method runs from phi = 1 (theory C.2), cannot be met.
/// @param history  H >= 0, finite.
/// @throws InvalidParameter  for any other H.
template <Degradation Function, CrackDensity Density>
inline double homogeneous_phase(const Function &g, const Density &density, const double history, const double Gc,
                                const double l0)
{
  if (!(std::isfinite(history) && history >= 0.))
    throw InvalidParameter("homogeneous state: driving energy " + print(history) + " must be finite and not negative");
  const double load = 2. * l0 / Gc * history;
  double       low = 0., high = 1.;
  for (double middle = .5; low < middle && middle < high; middle = .5 * (low + high))
    (load * g.first(middle) + .5 * density.local_first(middle) < 0. ? low : high) = middle;
  return high;
}

/// The same for densities of second and fourth order.
template <Degradation Function>
inline double homogeneous_phase(const Function &g, const double history, const double Gc, const double l0)
{
  return homogeneous_phase(g, crack_density::SecondOrder{}, history, Gc, l0);
}

} // namespace sherd
