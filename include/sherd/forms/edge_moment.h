#pragma once

#include <array>

#include <sherd/base/exceptions.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/kinematics/metric.h>

namespace sherd
{

/// Moments m [force] by reference length at the quadrature points of one piece of an edge, shape=(degree + 1).
template <int degree>
using PieceMoment = std::array<double, degree + 1>;

namespace internal
{

/// Present surface on an edge at one quadrature point.
struct EdgeFrame
{
  Point<3>         normal;   ///< n
  Point<3>         conormal; ///< nu = s a^e / |a^e|, outward
  ControlValues<3> gradient; ///< surface gradients g_A = N_A,a a^a, shape=(n_functions, 3)
};

template <int degree>
EdgeFrame edge_frame(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, int q)
{
  const auto &point = piece.quadrature[q];
  Point<3>    a1 = Point<3>::Zero(), a2 = a1;
  for (Eigen::Index A = 0; A < x.rows(); ++A)
    {
      a1 += point.d1[A] * x.row(A).transpose();
      a2 += point.d2[A] * x.row(A).transpose();
    }
  const auto     a       = metric<3>(a1, a2).contravariant;
  const Point<3> dual[2] = {a[0] * a1 + a[2] * a2, a[2] * a1 + a[1] * a2};
  EdgeFrame      frame{a1.cross(a2).normalized(), piece.outward * dual[piece.normal_direction].normalized(),
                  ControlValues<3>(x.rows(), 3)};
  for (Eigen::Index A = 0; A < x.rows(); ++A)
    frame.gradient.row(A) = (point.d1[A] * dual[0] + point.d2[A] * dual[1]).transpose();
  return frame;
}

template <int degree>
void check_control_values(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x)
{
  if (x.rows() != static_cast<Eigen::Index>(piece.points.size()))
    throw DimensionMismatch("edge moment: " + std::to_string(x.rows()) + " control values for a piece of " +
                            std::to_string(piece.points.size()) + " control points; expected one row a point");
}

} // namespace internal

/// External force of a follower moment on one piece of an edge,
///
///   f_A = -int m (g_A . nu) n dS,   g_A . nu = N_A,a nu^a,   nu^a = s a^ea / sqrt(a^ee),
///
/// so that f . dx = int m nu . dn dS: m > 0 turns the normal towards the outward conormal, the edge moves towards -n.
/// It has no resultant force; its resultant moment is int m n x nu dS.
///
/// @param x   present control points of the piece, shape=(n_functions, 3)
/// @return    shape=(n_functions, 3)
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
///
/// Source: theory E.3.
template <int degree>
ControlValues<3> edge_moment_force(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x,
                                   const PieceMoment<degree> &moment)
{
  internal::check_control_values(piece, x);
  ControlValues<3> force = ControlValues<3>::Zero(x.rows(), 3);
  for (int q = 0; q <= degree; ++q)
    {
      const auto frame = internal::edge_frame(piece, x, q);
      force -=
          moment[q] * piece.quadrature[q].dS * frame.gradient.lazyProduct(frame.conormal) * frame.normal.transpose();
    }
  return force;
}

/// Derivative d f_A / d x_B of edge_moment_force. With s_A = g_A . nu and t_A = g_A . t, t the unit tangent of the
/// edge,
///
///   d f_A / d x_B = int m [n (x) (s_B g_A + t_A t_B nu) + s_A g_B (x) n] dS,
///
/// which is the theory's formula after its contractions: dn = -g_B (n . dx_B) and
/// N_A,a dnu^a = -(s_B g_A + t_A t_B nu) . dx_B. Not symmetric. The tangent of (internal - external) gets its negative.
///
/// @return   shape=(3 n_functions, 3 n_functions), row 3 A + i, column 3 B + j
/// @throws DimensionMismatch   unless x has a row for each control point of the piece
///
/// Source: theory E.3.
template <int degree>
Eigen::MatrixXd edge_moment_tangent(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x,
                                    const PieceMoment<degree> &moment)
{
  internal::check_control_values(piece, x);
  const Eigen::Index n       = x.rows();
  Eigen::MatrixXd    tangent = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int q = 0; q <= degree; ++q)
    {
      const auto            frame = internal::edge_frame(piece, x, q);
      const double          m     = moment[q] * piece.quadrature[q].dS;
      const auto           &g     = frame.gradient;
      const Eigen::VectorXd s     = g.lazyProduct(frame.conormal);
      const Eigen::VectorXd t     = g.lazyProduct(frame.normal.cross(frame.conormal));
      for (Eigen::Index A = 0; A < n; ++A)
        for (Eigen::Index B = 0; B < n; ++B)
          tangent.block<3, 3>(3 * A, 3 * B) +=
              m * (frame.normal * (s[B] * g.row(A) + t[A] * t[B] * frame.conormal.transpose()) +
                   s[A] * g.row(B).transpose() * frame.normal.transpose());
    }
  return tangent;
}

} // namespace sherd
