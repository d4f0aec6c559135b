#pragma once

#include <sherd/base/types.h>
#include <sherd/kinematics/surface_point.h>

#include <concepts>

namespace sherd
{

/// Answer of a bending law at one point, by reference area, theory B.
struct BendingResponse
{
  double energy;    ///< Psi_b [force/length]
  Voigt  moment;    ///< M_b^ab = d Psi_b / d b_ab [force]
  Voigt4 stiffness; ///< f_b^abcd = d M_b^ab / d b_cd [force * length]
};

/// A bending law: a surface energy of the change of curvature k_ab = b_ab - B_ab alone.
///
/// It does not depend on the deformed metric: indices are raised with A^ab. Energy and moment vanish at k = 0.
/// stiffness() is the flexural rigidity that scales penalties and errors [force * length].
template <class Law>
concept BendingLaw = requires(const Law &law, const SurfacePoint<3> &point)
{
  {
    law.bend(point)
    } -> std::same_as<BendingResponse>;
  {
    law.stiffness()
    } -> std::convertible_to<double>;
};

namespace material
{

/// The bending law of a membrane: none.
struct NoBending
{
  BendingResponse bend(const SurfacePoint<3> &) const { return {0., Voigt::Zero(), Voigt4::Zero()}; }
  double          stiffness() const { return 0.; }
};

static_assert(BendingLaw<NoBending>);

} // namespace material
} // namespace sherd
