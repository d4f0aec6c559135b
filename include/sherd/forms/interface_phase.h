#pragma once

#include <sherd/forms/interface_tables.h>

namespace sherd
{

/// Continuity of the phase field across an interface: its slopes along the outward conormals of both sides add up to
/// nothing, g = nu^a phi_,a + nu~^a phi~_,a = b . phi = 0 on the reference surface (theory G.2). Needed by a
/// fourth-order crack density, whose functions have to be C^1. Linear, and constant in time.
///
/// Penalty: Pi = int eps/2 g^2 dS; multiplier: Pi = int q g dS, q constant on each piece [energy].
///
/// Values have the order of InterfaceTables::points, shape=(n).
///
/// This is the matrix of the penalty, int eps b (x) b dS, shape=(n, n). Its energy is phi . K phi / 2.
/// @param stiffness   eps at each quadrature point [energy * length]
template <int degree, int spacedim>
Eigen::MatrixXd phase_penalty_matrix(const InterfaceTables<degree, spacedim> &piece,
                                     const std::array<double, degree + 1>    &stiffness)
{
  const auto      n      = static_cast<Eigen::Index>(piece.points.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (int q = 0; q <= degree; ++q)
    {
      const auto &point = piece.quadrature[q];
      result += stiffness[q] * point.dS * point.jump * point.jump.transpose();
    }
  return result;
}

/// Row of the multiplier, int b dS, shape=(n): its residual is this times phi, its force q times this.
template <int degree, int spacedim>
Eigen::VectorXd phase_jump(const InterfaceTables<degree, spacedim> &piece)
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(piece.points.size()));
  for (const auto &point : piece.quadrature)
    result += point.dS * point.jump;
  return result;
}

} // namespace sherd
