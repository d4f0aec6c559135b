#pragma once

#include <sherd/kinematics/surface_point.h>
#include <sherd/material/response.h>

#include <concepts>

namespace sherd
{

/// A membrane law: a surface energy of the metric, which with its stress vanishes at the undeformed point.
///
/// bulk() and shear() are the moduli of the law linearised there [force/length]:
/// Psi = K/2 (tr eps)^2 + G dev eps : dev eps.
template <class Law>
concept MembraneLaw = requires(const Law &law, const SurfacePoint<2> &point)
{
  {
    law.respond(point)
    } -> std::same_as<Response<2>>;
  {
    law.bulk()
    } -> std::convertible_to<double>;
  {
    law.shear()
    } -> std::convertible_to<double>;
};

/// A membrane law in two parts that sum to respond(): dilatation() resists change of area, deviator() distortion.
///
/// Dilatation and its stress vanish wherever J = 1, so that a split may cut there and stay continuous.
template <class Law>
concept SeparableMembraneLaw = MembraneLaw<Law> && requires(const Law &law, const SurfacePoint<2> &point)
{
  {
    law.dilatation(point)
    } -> std::same_as<Response<2>>;
  {
    law.deviator(point)
    } -> std::same_as<Response<2>>;
};

} // namespace sherd
