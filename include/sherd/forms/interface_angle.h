#pragma once

#include <sherd/forms/interface_tables.h>

namespace sherd
{

/// Continuity of the deformation across an interface: the angle alpha between the normals of both sides keeps the
/// value alpha0 it has on the reference surface (theory G.1).
///
/// Penalty:    Pi = int eps (1 - cos(alpha - alpha0)) dS,
/// multiplier: Pi = int q g dS with g = sin(alpha - alpha0), whose slope is 1 at the solution for every alpha0; q is
///             the moment [force] that the interface transmits, one value for each piece.
///
/// Both are combinations of cos alpha and sin alpha. Control points x have the order of InterfaceTables::points,
/// shape=(n, 3); matrices have row 3 A + i, column 3 B + j.
///
/// This is the type of the weights of such a combination at each quadrature point.
template <int degree>
using AngleWeights = std::array<CosineSine, degree + 1>;

/// @param stiffness   eps at each quadrature point [force]
template <int degree>
AngleWeights<degree> penalty_weights(const InterfaceTables<degree, 3> &piece, double stiffness)
{
  AngleWeights<degree> w;
  for (int q = 0; q <= degree; ++q)
    w[q] = {-stiffness * piece.quadrature[q].reference.cosine, -stiffness * piece.quadrature[q].reference.sine};
  return w;
}

/// Those of @p multiplier times sin(alpha - alpha0).
template <int degree>
AngleWeights<degree> multiplier_weights(const InterfaceTables<degree, 3> &piece, double multiplier = 1.)
{
  AngleWeights<degree> w;
  for (int q = 0; q <= degree; ++q)
    w[q] = {-multiplier * piece.quadrature[q].reference.sine, multiplier * piece.quadrature[q].reference.cosine};
  return w;
}

/// Gradient of int w . (cos alpha, sin alpha) dS by the control points, shape=(n, 3).
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
template <int degree>
ControlValues<3> angle_gradient(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x,
                                const AngleWeights<degree> &w)
{
  internal::check_interface_values(piece, x);
  ControlValues<3> result = ControlValues<3>::Zero(x.rows(), 3);
  for (int q = 0; q <= degree; ++q)
    {
      const auto   &point = piece.quadrature[q];
      FoldVariables g     = point.dS * fold_gradient(internal::fold_variables(piece, x, q), w[q]);
      g.col(piece.along) += g.col(4);
      result += point.slopes.transpose().lazyProduct(g.template leftCols<4>().transpose());
    }
  return result;
}

/// Second derivatives of int w . (cos alpha, sin alpha) dS, shape=(3 n, 3 n).
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
template <int degree>
Eigen::MatrixXd angle_hessian(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x,
                              const AngleWeights<degree> &w)
{
  internal::check_interface_values(piece, x);
  const Eigen::Index                        n      = x.rows();
  Eigen::MatrixXd                           result = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Eigen::Matrix<double, 12, Eigen::Dynamic> right(12, 3 * n);
  for (int q = 0; q <= degree; ++q)
    {
      const auto &point = piece.quadrature[q];
      FoldHessian H     = point.dS * fold_hessian(internal::fold_variables(piece, x, q), w[q]);
      H.middleRows<3>(3 * piece.along) += H.bottomRows<3>();
      H.middleCols<3>(3 * piece.along) += H.rightCols<3>();
      right.setZero();
      for (Eigen::Index B = 0; B < n; ++B)
        for (int l = 0; l < 4; ++l)
          if (point.slopes(l, B) != 0.)
            right.middleCols<3>(3 * B) += point.slopes(l, B) * H.block<12, 3>(0, 3 * l);
      for (Eigen::Index A = 0; A < n; ++A)
        for (int k = 0; k < 4; ++k)
          if (point.slopes(k, A) != 0.)
            result.middleRows<3>(3 * A) += point.slopes(k, A) * right.middleRows<3>(3 * k);
    }
  return result;
}

/// Energy of the penalty, int eps/2 [(cos alpha - cos alpha0)^2 + (sin alpha - sin alpha0)^2] dS, which is the same
/// without the cancellation. @param stiffness   eps [force]
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
template <int degree>
double angle_penalty_energy(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x, double stiffness)
{
  internal::check_interface_values(piece, x);
  double sum = 0.;
  for (int q = 0; q <= degree; ++q)
    {
      const auto  &point  = piece.quadrature[q];
      const auto   now    = fold_angle(internal::fold_variables(piece, x, q));
      const double cosine = now.cosine - point.reference.cosine, sine = now.sine - point.reference.sine;
      sum += .5 * stiffness * point.dS * (cosine * cosine + sine * sine);
    }
  return sum;
}

/// Force of the penalty on the control points, the gradient of its energy, shape=(n, 3).
template <int degree>
ControlValues<3> angle_penalty_force(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x,
                                     double stiffness)
{
  return angle_gradient(piece, x, penalty_weights(piece, stiffness));
}

/// Its derivative, shape=(3 n, 3 n).
template <int degree>
Eigen::MatrixXd angle_penalty_tangent(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x,
                                      double stiffness)
{
  return angle_hessian(piece, x, penalty_weights(piece, stiffness));
}

/// r_q = int sin(alpha - alpha0) dS, the residual of the multiplier [length].
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
template <int degree>
double angle_defect(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x)
{
  internal::check_interface_values(piece, x);
  double sum = 0.;
  for (int q = 0; q <= degree; ++q)
    {
      const auto &point = piece.quadrature[q];
      const auto  now   = fold_angle(internal::fold_variables(piece, x, q));
      sum += point.dS * (point.reference.cosine * now.sine - point.reference.sine * now.cosine);
    }
  return sum;
}

/// K_xq = d r_q / dx, shape=(n, 3); the force of a multiplier is q times this.
template <int degree>
ControlValues<3> angle_defect_gradient(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x)
{
  return angle_gradient(piece, x, multiplier_weights(piece));
}

/// K_xx = q d^2 r_q / dx^2, shape=(3 n, 3 n).
template <int degree>
Eigen::MatrixXd angle_multiplier_tangent(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x,
                                         double multiplier)
{
  return angle_hessian(piece, x, multiplier_weights(piece, multiplier));
}

} // namespace sherd
