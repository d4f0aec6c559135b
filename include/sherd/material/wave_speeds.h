#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>

#include <cmath>

namespace sherd
{

/// Speeds of small waves in an undamaged surface [length/time], theory F.3.
struct WaveSpeeds
{
  double dilatational; ///< c_d = ((K + G) / rho)^{1/2}
  double shear;        ///< c_s = (G / rho)^{1/2}
  double rayleigh;     ///< c_R, along a free edge; the limit speed of a crack
};

/// Wave speeds of a surface with the given moduli.
///
/// c_R is the root in (0, c_s) of (2 - c^2/c_s^2)^2 = 4 (1 - c^2/c_d^2)^{1/2} (1 - c^2/c_s^2)^{1/2}. Squared and freed
/// of c = 0 this is a cubic in x = c^2/c_s^2 with one root between 0 and 1; it is bisected to the last bit.
/// @param bulk, shear  K, G at rest.
/// @param density      rho, mass by reference area, in units that fit: (modulus / density) is a speed squared.
/// @throws InvalidParameter  unless all three are positive and finite.
inline WaveSpeeds wave_speeds(const double bulk, const double shear, const double density)
{
  for (const double value : {bulk, shear, density})
    if (!(std::isfinite(value) && value > 0.))
      throw InvalidParameter("wave speeds: bulk modulus " + print(bulk) + ", shear modulus " + print(shear) +
                             " and density " + print(density) + " must be positive and finite");

  const double k     = shear / (bulk + shear); // (c_s / c_d)^2
  const auto   cubic = [k](const double x) { return ((x - 8.) * x + (24. - 16. * k)) * x - 16. * (1. - k); };
  double       low = 0., high = 1.;
  for (double middle = .5; low < middle && middle < high; middle = .5 * (low + high))
    (cubic(middle) < 0. ? low : high) = middle;

  const double c_s = std::sqrt(shear / density);
  return {std::sqrt((bulk + shear) / density), c_s, c_s * std::sqrt(high)};
}

} // namespace sherd
