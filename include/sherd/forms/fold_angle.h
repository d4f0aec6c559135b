#pragma once

#include <Eigen/Geometry>

#include <sherd/base/types.h>

namespace sherd
{

/// What the angle between two surfaces on a common curve depends on: the tangents a_1, a_2 of the first surface, those
/// of the second and the tangent t along the curve, shape=(3, 5).
using FoldVariables = Eigen::Matrix<double, 3, 5>;

/// Second derivatives in the fold variables; row 3 k + i for component i of variable k.
using FoldHessian = Eigen::Matrix<double, 15, 15>;

/// Angle alpha from the normal n of the first surface to the normal n~ of the second about the unit tangent tau of
/// the curve: cos alpha = n . n~, sin alpha = (n x n~) . tau. Also the weights of a combination of both.
struct CosineSine
{
  double cosine, sine;
};

namespace internal
{

/// Unit vector u = m / |m| of one of the vectors m.
struct UnitVector
{
  Point<3> unit;
  double   length;

  explicit UnitVector(const Point<3> &m) : unit(m), length(m.norm()) { unit /= length; }

  /// d(v . u)/dm = (1 - u u) v / |m|
  Point<3> gradient(const Point<3> &v) const { return (v - unit * unit.dot(v)) / length; }

  /// du/dm
  Eigen::Matrix3d projection() const { return (Eigen::Matrix3d::Identity() - unit * unit.transpose()) / length; }

  /// d^2(v . u)/dm^2
  Eigen::Matrix3d hessian(const Point<3> &v) const
  {
    const Eigen::Matrix3d uu = unit * unit.transpose();
    return -(v * unit.transpose() + unit * v.transpose() + v.dot(unit) * (Eigen::Matrix3d::Identity() - 3. * uu)) /
           (length * length);
  }
};

/// [u]x with [u]x v = u x v.
inline Eigen::Matrix3d cross_matrix(const Point<3> &u)
{
  Eigen::Matrix3d result;
  result << 0., -u[2], u[1], u[2], 0., -u[0], -u[1], u[0], 0.;
  return result;
}

struct FoldDirections
{
  UnitVector n, other, tau; ///< n, n~, tau

  explicit FoldDirections(const FoldVariables &y)
      : n(y.col(0).cross(y.col(1))), other(y.col(2).cross(y.col(3))), tau(y.col(4))
  {
  }

  /// Derivatives of w.cosine cos alpha + w.sine sin alpha by n, n~ and tau, taken as independent.
  Eigen::Matrix3d gradients(const CosineSine &w) const
  {
    Eigen::Matrix3d g;
    g.col(0) = w.cosine * other.unit + w.sine * other.unit.cross(tau.unit);
    g.col(1) = w.cosine * n.unit + w.sine * tau.unit.cross(n.unit);
    g.col(2) = w.sine * n.unit.cross(other.unit);
    return g;
  }
};

} // namespace internal

/// Cosine and sine of the angle. Source: theory G.1.
inline CosineSine fold_angle(const FoldVariables &y)
{
  const internal::FoldDirections d(y);
  return {d.n.unit.dot(d.other.unit), d.n.unit.cross(d.other.unit).dot(d.tau.unit)};
}

/// Gradient of w.cosine cos alpha + w.sine sin alpha in the fold variables, shape=(3, 5). Source: theory G.1.
inline FoldVariables fold_gradient(const FoldVariables &y, const CosineSine &w)
{
  const internal::FoldDirections d(y);
  const auto                     g     = d.gradients(w);
  const Point<3>                 first = d.n.gradient(g.col(0)), second = d.other.gradient(g.col(1));
  FoldVariables                  result;
  result.col(0) = y.col(1).cross(first);
  result.col(1) = first.cross(y.col(0));
  result.col(2) = y.col(3).cross(second);
  result.col(3) = second.cross(y.col(2));
  result.col(4) = d.tau.gradient(g.col(2));
  return result;
}

/// Hessian of w.cosine cos alpha + w.sine sin alpha in the fold variables. Source: theory G.1.
inline FoldHessian fold_hessian(const FoldVariables &y, const CosineSine &w)
{
  using internal::cross_matrix;
  const internal::FoldDirections d(y);
  const auto                     g = d.gradients(w);
  const Eigen::Matrix3d          P = d.n.projection(), Q = d.other.projection(), R = d.tau.projection();

  // By the cross products m, m~ and by t.
  Eigen::Matrix<double, 9, 9> z;
  z.block<3, 3>(0, 0) = d.n.hessian(g.col(0));
  z.block<3, 3>(3, 3) = d.other.hessian(g.col(1));
  z.block<3, 3>(6, 6) = d.tau.hessian(g.col(2));
  z.block<3, 3>(0, 3) = P * (w.cosine * Eigen::Matrix3d::Identity() - w.sine * cross_matrix(d.tau.unit)) * Q;
  z.block<3, 3>(0, 6) = w.sine * P * cross_matrix(d.other.unit) * R;
  z.block<3, 3>(3, 6) = -w.sine * Q * cross_matrix(d.n.unit) * R;
  z.block<3, 3>(3, 0) = z.block<3, 3>(0, 3).transpose();
  z.block<3, 3>(6, 0) = z.block<3, 3>(0, 6).transpose();
  z.block<3, 3>(6, 3) = z.block<3, 3>(3, 6).transpose();

  Eigen::Matrix<double, 9, 15> D = Eigen::Matrix<double, 9, 15>::Zero(); // dz/dy
  D.block<3, 3>(0, 0)            = -cross_matrix(y.col(1));
  D.block<3, 3>(0, 3)            = cross_matrix(y.col(0));
  D.block<3, 3>(3, 6)            = -cross_matrix(y.col(3));
  D.block<3, 3>(3, 9)            = cross_matrix(y.col(2));
  D.block<3, 3>(6, 12).setIdentity();

  FoldHessian H = D.transpose() * z * D;
  for (const int side : {0, 1})
    {
      const Eigen::Matrix3d mixed = cross_matrix(side == 0 ? d.n.gradient(g.col(0)) : d.other.gradient(g.col(1)));
      H.block<3, 3>(6 * side, 6 * side + 3) -= mixed;
      H.block<3, 3>(6 * side + 3, 6 * side) += mixed;
    }
  return H;
}

} // namespace sherd
