#pragma once

#include <concepts>

namespace sherd
{

/// Energy density of a smeared crack by reference area, theory C.1:
///
///   Psi_frac = Gc / (4 l0) [(phi - 1)^2 + c1 |grad phi|^2 + c2 (lap phi)^2],
///
/// with gradient and Laplacian on the reference surface. c1 [length^2], c2 [length^4] are such that a straight crack
/// of unit length costs exactly Gc. `order` is that of its Euler-Lagrange equation; a density of order 2 has c2 = 0 and
/// needs no Laplacian. profile(r) is the phase at distance r l0 from a crack in an infinite body.
template <class Density>
concept CrackDensity = requires(const Density &density, const double x)
{
  {
    density.c1(x)
    } -> std::same_as<double>;
  {
    density.c2(x)
    } -> std::same_as<double>;
  {
    density.profile(x)
    } -> std::same_as<double>;
  {
    Density::order
    } -> std::convertible_to<int>;
};

/// Psi_frac at one point.
/// @param gradient_squared  A^ab phi_,a phi_,b [1/length^2].
/// @param laplacian         lap phi [1/length^2].
template <CrackDensity Density>
inline double crack_energy(const Density &density, const double Gc, const double l0, const double phi,
                           const double gradient_squared, const double laplacian)
{
  return Gc / (4. * l0) *
         ((phi - 1.) * (phi - 1.) + density.c1(l0) * gradient_squared + density.c2(l0) * laplacian * laplacian);
}

} // namespace sherd
