#pragma once

#include <concepts>

namespace sherd
{

/// How a crack remembers the past, at one quadrature point (theory D).
///
/// There is one number of memory; it is 0 in a body without a past and what it means is the policy's own affair. For
/// the iterate with active energy Psi+ and phase phi, memory being that of the last accepted step,
///
///   trial(memory, energy)            the driving energy H [force/length],
///   is_loading(memory, energy)       whether H moves with the energy: then its derivative enters the tangent,
///   resistance(memory, phi)          r, of a force r Gc / l0 against healing in the residual of the phase,
///   resistance_stiffness(memory, phi)  dr / dphi,
///   commit(memory, energy, phi)      the memory when the step is accepted,
///   initial(energy, phi)             the memory of a pre-crack with this driving energy and phase.
///
/// A rejected step forgets its trial values; NaN is passed on, never hidden.
template <class Policy>
concept Irreversibility = requires(const Policy &policy, const double x)
{
  {
    policy.trial(x, x)
    } -> std::same_as<double>;
  {
    policy.is_loading(x, x)
    } -> std::same_as<bool>;
  {
    policy.resistance(x, x)
    } -> std::same_as<double>;
  {
    policy.resistance_stiffness(x, x)
    } -> std::same_as<double>;
  {
    policy.commit(x, x, x)
    } -> std::same_as<double>;
  {
    policy.initial(x, x)
    } -> std::same_as<double>;
};

namespace irreversibility::internal
{
/// The greater of two numbers; NaN if one of them is. The last case is that of a value that is no number: it must not
/// vanish in the comparison.
inline double greater(const double a, const double b)
{
  return a > b ? a : a <= b ? b : a + b;
}
} // namespace irreversibility::internal

} // namespace sherd
