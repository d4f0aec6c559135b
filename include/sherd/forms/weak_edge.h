#pragma once

#include <array>
#include <cmath>

#include <sherd/base/exceptions.h>
#include <sherd/forms/fold_angle.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/kinematics/metric.h>

namespace sherd
{

/// Conditions on the rotation of an edge in weak form, by penalty (theory G.5). They ask nothing of the parameter lines
/// at the edge, unlike the strong ones of Supports, and are as good as their factor eps [force] (theory G.3).
///
/// Control points x have the order of EdgeGeometry::points, shape=(n, 3); matrices have row 3 A + i, column 3 B + j.
///
/// This is the type of normals at the quadrature points of a piece of an edge.
template <int degree>
using PieceNormals = std::array<Point<3>, degree + 1>;

namespace internal
{

template <int degree>
struct EdgeNormal
{
  Point<3>   a1 = Point<3>::Zero(), a2 = Point<3>::Zero();
  UnitVector n;

  static EdgeNormal at(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, int q)
  {
    const auto &point = piece.quadrature[q];
    Point<3>    a1 = Point<3>::Zero(), a2 = a1;
    for (Eigen::Index A = 0; A < x.rows(); ++A)
      {
        a1 += point.d1[A] * x.row(A).transpose();
        a2 += point.d2[A] * x.row(A).transpose();
      }
    return {a1, a2, UnitVector(a1.cross(a2))};
  }

  /// Adds scale * d(v . n)/dx_A for a constant v.
  void add_gradient(const typename EdgeGeometry<degree, 3>::QuadraturePoint &point, const Point<3> &v, double scale,
                    ControlValues<3> &out) const
  {
    const Point<3> w = n.gradient(v), by_1 = a2.cross(w), by_2 = w.cross(a1);
    for (Eigen::Index A = 0; A < out.rows(); ++A)
      out.row(A) += scale * (point.d1[A] * by_1 + point.d2[A] * by_2).transpose();
  }

  /// Adds scale * d^2(v . n)/dx_A dx_B.
  void add_hessian(const typename EdgeGeometry<degree, 3>::QuadraturePoint &point, const Point<3> &v, double scale,
                   Eigen::MatrixXd &out) const
  {
    const Eigen::Matrix3d D[2] = {-cross_matrix(a2), cross_matrix(a1)}; // dm/da_1, dm/da_2
    const Eigen::Matrix3d z = n.hessian(v), mixed = cross_matrix(n.gradient(v));
    Eigen::Matrix3d       H[2][2];
    for (int k = 0; k < 2; ++k)
      for (int l = 0; l < 2; ++l)
        H[k][l] = scale * (D[k].transpose() * z * D[l]);
    H[0][1] -= scale * mixed;
    H[1][0] += scale * mixed;
    const double *d[2] = {point.d1.data(), point.d2.data()};
    const auto    size = static_cast<Eigen::Index>(point.d1.size());
    for (Eigen::Index A = 0; A < size; ++A)
      for (Eigen::Index B = 0; B < size; ++B)
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l)
            out.block<3, 3>(3 * A, 3 * B) += d[k][A] * d[l][B] * H[k][l];
  }
};

template <int degree>
void check_edge_values(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x)
{
  if (x.rows() != static_cast<Eigen::Index>(piece.points.size()))
    throw DimensionMismatch("weak edge condition: " + std::to_string(x.rows()) + " control values for a piece of " +
                            std::to_string(piece.points.size()) + " control points; expected one row a point");
}

} // namespace internal

/// Normal N of the reference surface at a quadrature point, turned by @p angle about the edge: a positive angle turns
/// it towards the outward conormal, as a positive edge moment does.
template <int degree>
Point<3> turned_normal(const EdgeGeometry<degree, 3> &piece, int q, double angle)
{
  const auto    &point   = piece.quadrature[q];
  const Point<3> N       = point.A1.cross(point.A2).normalized();
  const Point<3> along   = (piece.normal_direction == 0 ? point.A2 : point.A1).normalized();
  Point<3>       outward = along.cross(N);
  if (outward.dot(piece.outward * (piece.normal_direction == 0 ? point.A1 : point.A2)) < 0.)
    outward = -outward;
  return std::cos(angle) * N + std::sin(angle) * outward;
}

/// Clamped edge or prescribed rotation: the normal n of the edge is held at n^, Pi = int eps (1 - n . n^) dS.
/// @param stiffness   eps [force]   @param target   n^ at each quadrature point
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
template <int degree>
double held_normal_energy(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, double stiffness,
                          const PieceNormals<degree> &target)
{
  internal::check_edge_values(piece, x);
  double sum = 0.;
  for (int q = 0; q <= degree; ++q)
    sum += .5 * stiffness * piece.quadrature[q].dS *
           (internal::EdgeNormal<degree>::at(piece, x, q).n.unit - target[q]).squaredNorm();
  return sum;
}

/// Gradient of held_normal_energy by the control points, shape=(n, 3).
template <int degree>
ControlValues<3> held_normal_force(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, double stiffness,
                                   const PieceNormals<degree> &target)
{
  internal::check_edge_values(piece, x);
  ControlValues<3> force = ControlValues<3>::Zero(x.rows(), 3);
  for (int q = 0; q <= degree; ++q)
    internal::EdgeNormal<degree>::at(piece, x, q)
        .add_gradient(piece.quadrature[q], target[q], -stiffness * piece.quadrature[q].dS, force);
  return force;
}

/// Its derivative, shape=(3 n, 3 n).
template <int degree>
Eigen::MatrixXd held_normal_tangent(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, double stiffness,
                                    const PieceNormals<degree> &target)
{
  internal::check_edge_values(piece, x);
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(3 * x.rows(), 3 * x.rows());
  for (int q = 0; q <= degree; ++q)
    internal::EdgeNormal<degree>::at(piece, x, q)
        .add_hessian(piece.quadrature[q], target[q], -stiffness * piece.quadrature[q].dS, tangent);
  return tangent;
}

/// Edge in a plane of symmetry with unit normal e: n . e keeps its value on the reference surface,
/// Pi = int eps/2 (n . e - N . e)^2 dS. The displacement along e is for Supports to hold.
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
template <int degree>
double symmetry_energy(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, double stiffness,
                       const Point<3> &e)
{
  internal::check_edge_values(piece, x);
  double sum = 0.;
  for (int q = 0; q <= degree; ++q)
    {
      const double gap =
          internal::EdgeNormal<degree>::at(piece, x, q).n.unit.dot(e) - turned_normal(piece, q, 0.).dot(e);
      sum += .5 * stiffness * piece.quadrature[q].dS * gap * gap;
    }
  return sum;
}

/// Gradient of symmetry_energy by the control points, shape=(n, 3).
template <int degree>
ControlValues<3> symmetry_force(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, double stiffness,
                                const Point<3> &e)
{
  internal::check_edge_values(piece, x);
  ControlValues<3> force = ControlValues<3>::Zero(x.rows(), 3);
  for (int q = 0; q <= degree; ++q)
    {
      const auto   at  = internal::EdgeNormal<degree>::at(piece, x, q);
      const double gap = at.n.unit.dot(e) - turned_normal(piece, q, 0.).dot(e);
      at.add_gradient(piece.quadrature[q], e, stiffness * piece.quadrature[q].dS * gap, force);
    }
  return force;
}

/// Its derivative, shape=(3 n, 3 n).
template <int degree>
Eigen::MatrixXd symmetry_tangent(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, double stiffness,
                                 const Point<3> &e)
{
  internal::check_edge_values(piece, x);
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(3 * x.rows(), 3 * x.rows());
  for (int q = 0; q <= degree; ++q)
    {
      const auto       at    = internal::EdgeNormal<degree>::at(piece, x, q);
      const double     gap   = at.n.unit.dot(e) - turned_normal(piece, q, 0.).dot(e);
      const double     scale = stiffness * piece.quadrature[q].dS;
      ControlValues<3> slope = ControlValues<3>::Zero(x.rows(), 3);
      at.add_gradient(piece.quadrature[q], e, 1., slope);
      const Eigen::Map<const Eigen::VectorXd> g(slope.data(), slope.size());
      tangent += scale * g * g.transpose();
      at.add_hessian(piece.quadrature[q], e, scale * gap, tangent);
    }
  return tangent;
}

/// Matrix of int eps/2 (nu^a phi_,a)^2 dS, shape=(n, n): the phase field is level across the edge, which a plane of
/// symmetry asks of a fourth-order crack density. @param stiffness   eps at each quadrature point [energy * length]
template <int degree, int spacedim>
Eigen::MatrixXd phase_symmetry_matrix(const EdgeGeometry<degree, spacedim> &piece,
                                      const std::array<double, degree + 1> &stiffness)
{
  const auto      n      = static_cast<Eigen::Index>(piece.points.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (int q = 0; q <= degree; ++q)
    {
      const auto     &point = piece.quadrature[q];
      const auto      A     = metric<spacedim>(point.A1, point.A2).contravariant;
      const double    e     = piece.normal_direction == 0 ? A[0] : A[1];
      const double    nu[2] = {piece.outward * (piece.normal_direction == 0 ? A[0] : A[2]) / std::sqrt(e),
                               piece.outward * (piece.normal_direction == 0 ? A[2] : A[1]) / std::sqrt(e)};
      Eigen::VectorXd b(n);
      for (Eigen::Index k = 0; k < n; ++k)
        b[k] = nu[0] * point.d1[k] + nu[1] * point.d2[k];
      result += stiffness[q] * point.dS * b * b.transpose();
    }
  return result;
}

} // namespace sherd
