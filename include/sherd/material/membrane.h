#pragma once

#include <sherd/kinematics/surface_point.h>
#include <sherd/material/response.h>

#include <concepts>

namespace sherd
{

/// A membrane law: a surface energy in two parts, one that resists change of area and one that resists distortion.
///
/// Both parts and their stresses vanish at the undeformed point. bulk() and shear() are the moduli of the law
/// linearised there [force/length]: Psi = K/2 (tr eps)^2 + G dev eps : dev eps.
template <class Law>
concept MembraneLaw = requires(const Law &law, const SurfacePoint<2> &point)
{
  {
    law.dilatation(point)
    } -> std::same_as<Response<2>>;
  {
    law.deviator(point)
    } -> std::same_as<Response<2>>;
  {
    law.bulk()
    } -> std::convertible_to<double>;
  {
    law.shear()
    } -> std::convertible_to<double>;
};

namespace material
{

/// The bending law of a membrane: none.
struct NoBending
{
};

} // namespace material
} // namespace sherd
