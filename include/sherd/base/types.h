#pragma once

#include <cstdint>

#include <Eigen/Core>

/// Types and index conventions that every room shares.
namespace sherd
{

/// Position or vector in the space the surface lives in, shape=(spacedim).
template <int spacedim>
using Point = Eigen::Matrix<double, spacedim, 1>;

/// Symmetric surface tensor, components in the order (11, 22, 12). These are tensor components, not engineering
/// strains: a contraction counts the third one twice (doc/notation.md).
using Voigt = Eigen::Vector3d;

/// Surface tensor of fourth order with minor symmetries; row and column in the order (11, 22, 12), no weights inside.
using Voigt4 = Eigen::Matrix3d;

/// Weight of each Voigt component in a contraction.
inline const Voigt voigt_weight{1., 1., 2.};

/// A : B of two symmetric surface tensors.
inline double contract(const Voigt &a, const Voigt &b)
{
  return a[0] * b[0] + a[1] * b[1] + 2. * a[2] * b[2];
}

/// One row of values for each control point, shape=(n_control_points, n).
template <int n>
using ControlValues = Eigen::Matrix<double, Eigen::Dynamic, n, n == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// Unknowns of one control point: its displacement and its phase value.
template <int spacedim>
inline constexpr int fields_per_point = spacedim + 1;

} // namespace sherd
