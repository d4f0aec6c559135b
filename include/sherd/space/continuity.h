#pragma once

#include <variant>

namespace sherd
{

/// How the angle between patches and the slope of the phase field are kept across interfaces (theory G).
namespace continuity
{

/// Not at all: patches are hinged to each other, and cracks along interfaces cost too little.
struct None
{
};

/// Penalty, epsilon = beta times stiffness over element size (theory G.3).
struct Penalty
{
  double deformation = 0.; ///< beta of the angle; 0: penalty_factor(degree)
  double phase       = 0.; ///< beta of the phase; 0: phase_penalty_factor
};

/// A multiplier for the angle and one for the phase, constant on each piece of an interface.
struct LagrangeMultiplier
{
};

/// beta that leaves less error than the elements do, with equations that are still well conditioned: 1e3 for degree 2,
/// 1e4 above.  theory G.3
constexpr double penalty_factor(int degree)
{
  return degree == 2 ? 1e3 : 1e4;
}

/// The same for the phase: a crack along an interface costs Gc but for 1/4 / (1 + beta l0 / h), which is 6e-4 at h =
/// l0/2, for every degree. Incomplete factors need three times the iterations with 1e3.  theory G.3
inline constexpr double phase_penalty_factor = 200.;

} // namespace continuity

using Continuity = std::variant<continuity::None, continuity::Penalty, continuity::LagrangeMultiplier>;

} // namespace sherd
