#pragma once

#include <concepts>

namespace sherd
{

/// Degradation function g(phi) of the active energy, phase 1 intact and 0 broken (theory C.2; paper Eq. (5)).
///
/// g(0) = 0, g(1) = 1, g'(0) = 0, monotone between. The fourth-order density lets phi leave [0, 1] slightly: members
/// evaluate their polynomial as it stands, since clamping would spoil the tangent. Dimensionless.
template <class Function>
concept Degradation = requires(const Function &g, const double phi)
{
  {
    g.value(phi)
    } -> std::same_as<double>;
  {
    g.first(phi)
    } -> std::same_as<double>;
  {
    g.second(phi)
    } -> std::same_as<double>;
};

} // namespace sherd
