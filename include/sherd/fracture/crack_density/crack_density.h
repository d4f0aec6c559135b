#pragma once

#include <concepts>

namespace sherd
{

/// Energy density of a smeared crack by reference area, theory C.1:
///
///   Psi_frac = Gc / (4 l0) [w(phi) + c1 |grad phi|^2 + c2 (lap phi)^2],
///
/// with gradient and Laplacian on the reference surface. local(phi) is w, the price of damage at a point: zero and
/// least at phi = 1; local_first and local_second are its derivatives. c1 [length^2], c2 [length^4] are such that a
/// straight crack of unit length costs exactly Gc. `order` is that of its Euler-Lagrange equation; a density of order 2
/// has c2 = 0 and needs no Laplacian. profile(r) is the phase at distance r l0 from a crack in an infinite body.
template <class Density>
concept CrackDensity = requires(const Density &density, const double x)
{
  {
    density.local(x)
    } -> std::same_as<double>;
  {
    density.local_first(x)
    } -> std::same_as<double>;
  {
    density.local_second(x)
    } -> std::same_as<double>;
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
         (density.local(phi) + density.c1(l0) * gradient_squared + density.c2(l0) * laplacian * laplacian);
}

namespace crack_density
{

/// w = (phi - 1)^2, of the densities of second and fourth order: damage begins with the first load.
struct QuadraticLocal
{
  double local(const double phi) const { return (phi - 1.) * (phi - 1.); } ///< w
  double local_first(const double phi) const { return 2. * (phi - 1.); }   ///< w'
  double local_second(const double) const { return 2.; }                   ///< w''
};

} // namespace crack_density
} // namespace sherd
