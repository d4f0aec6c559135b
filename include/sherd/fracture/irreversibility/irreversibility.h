#pragma once

#include <concepts>

namespace sherd
{

/// How the energy that drives the phase remembers the past, at one quadrature point (theory D).
///
/// trial(accepted, energy) is the driving energy H of the present iterate, from the H of the last accepted step and the
/// present active energy. is_loading(accepted, energy) tells whether H moves with the energy, that is whether its
/// derivative enters the tangent. A rejected step forgets its trial values; NaN is passed on, never hidden.
template <class Policy>
concept Irreversibility = requires(const Policy &policy, const double energy)
{
  {
    policy.trial(energy, energy)
    } -> std::same_as<double>;
  {
    policy.is_loading(energy, energy)
    } -> std::same_as<bool>;
};

} // namespace sherd
