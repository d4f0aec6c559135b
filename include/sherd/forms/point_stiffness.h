#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <sherd/geometry/element_geometry.h>
#include <sherd/kinematics/surface_frame.h>
#include <sherd/material/response.h>

/// The tangent at one quadrature point as a matrix of derivatives of shape functions (theory E.2).
namespace sherd::internal
{

/// Derivatives of a shape function: N,1 N,2 N,11 N,22 N,12.
inline constexpr int n_derivatives = 5;

/// A factor for each derivative, side by side in whole registers; the rest holds zeros.
typedef double DerivativePack __attribute__((vector_size(64)));

/// Pairs of components i <= j of the displacement, row by row: (0, 0), (0, 1), ...
template <int spacedim>
inline constexpr int n_pairs = spacedim *(spacedim + 1) / 2;

/// Stiffness of the displacements at one point by derivatives of the shape functions P_r,
///
///   K_AB^ij = sum_rs P_r(A) stiffness[pair(i, j)][r][s] P_s(B)   for i <= j,
///
/// r = 1, 2 only in the plane. The rest follows from symmetry, or from skew symmetry.
template <int spacedim>
using PointStiffness = std::array<std::array<DerivativePack, spacedim == 2 ? 2 : n_derivatives>, n_pairs<spacedim>>;

/// A stress contracted with the strain by displacement component i, sum_r P_r(A) slope[i][r].
template <int spacedim>
using PointSlope = std::array<DerivativePack, spacedim>;

/// Engineering membrane strains of component i of the displacement: (a1_i, 0, a2_i) N,1 + (0, a2_i, a1_i) N,2.
template <int spacedim>
struct MembraneStrain
{
  const SurfaceFrame<spacedim> &frame;

  /// Contraction of rows (11, 22, 12) with the strain by N,1 or N,2 of component i.
  template <class T>
  auto contract(int derivative, int i, const T &row_11, const T &row_22, const T &row_12) const
  {
    return derivative == 0 ? frame.a1[i] * row_11 + frame.a2[i] * row_12 : frame.a2[i] * row_22 + frame.a1[i] * row_12;
  }

  /// stress^ab e_ab of component i.
  DerivativePack slope(int i, const Voigt &stress) const
  {
    return DerivativePack{contract(0, i, stress[0], stress[1], stress[2]),
                          contract(1, i, stress[0], stress[1], stress[2])};
  }

  /// Row r of the membrane part for a pair of components, with the geometric stiffness tau on its diagonal.
  DerivativePack row(int r, int i, int j, const Voigt4 &D, const Voigt &tau) const
  {
    double entry[2];
    for (int s = 0; s < 2; ++s)
      {
        const double x = contract(s, j, D(0, 0), D(0, 1), D(0, 2));
        const double y = contract(s, j, D(1, 0), D(1, 1), D(1, 2));
        const double z = contract(s, j, D(2, 0), D(2, 1), D(2, 2));
        entry[s]       = contract(r, i, x, y, z) + (i == j ? tau[r == s ? r : 2] : 0.);
      }
    return DerivativePack{entry[0], entry[1]};
  }
};

/// Changes of curvature (11, 22, 2 x 12) along the normal by derivatives: N;ab = N,ab - Gamma^c_ab N,c.
struct CurvatureChange
{
  explicit CurvatureChange(const SurfaceFrame<3> &frame)
  {
    const Voigt &one = frame.christoffel_1, &two = frame.christoffel_2;
    rows[0] = DerivativePack{-one[0], -two[0], 1.};
    rows[1] = DerivativePack{-one[1], -two[1], 0., 1.};
    rows[2] = DerivativePack{-2. * one[2], -2. * two[2], 0., 0., 2.};
  }

  /// sum_i values_i rows_i
  template <class Values>
  DerivativePack contract(const Values &values) const
  {
    return values[0] * rows[0] + values[1] * rows[1] + values[2] * rows[2];
  }

  DerivativePack rows[3];
};

/// A tangent and its transpose are equal where the stress derives from an energy.
enum class Symmetry
{
  symmetric,
  skew
};

/// Symmetric or skew part of a tangent.
inline Tangent<2> part_of(const Tangent<2> &D, Symmetry symmetry)
{
  const double sign = symmetry == Symmetry::symmetric ? .5 : -.5;
  return {.5 * D.membrane + sign * D.membrane.transpose()};
}
inline Tangent<3> part_of(const Tangent<3> &D, Symmetry symmetry)
{
  const double sign     = symmetry == Symmetry::symmetric ? .5 : -.5;
  const Voigt4 coupling = .5 * D.coupling + sign * D.moment_coupling.transpose();
  return {.5 * D.membrane + sign * D.membrane.transpose(), coupling, 2. * sign * coupling.transpose(),
          .5 * D.bending + sign * D.bending.transpose()};
}

/// Whether a tangent differs from its transpose by more than rounding.
inline bool is_unsymmetric(const Voigt4 &A, const Voigt4 &B)
{
  double difference = 0.;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      difference = std::max(difference, std::abs(A(i, j) - B(j, i)));
  return difference > 1e-12 * A.cwiseAbs().maxCoeff();
}
inline bool is_unsymmetric(const Tangent<2> &D)
{
  return is_unsymmetric(D.membrane, D.membrane);
}
inline bool is_unsymmetric(const Tangent<3> &D)
{
  return is_unsymmetric(D.membrane, D.membrane) || is_unsymmetric(D.bending, D.bending) ||
         is_unsymmetric(D.coupling, D.moment_coupling);
}

/// @param D         dA c^abcd, its symmetric or skew part
/// @param total     dA tau^ab, of the geometric stiffness
/// @param symmetry  of D
inline PointStiffness<2> point_stiffness(const SurfaceFrame<2> &frame, const Tangent<2> &D, const Stress<2> &total,
                                         Symmetry)
{
  const MembraneStrain<2> strain{frame};
  PointStiffness<2>       stiffness;
  for (int i = 0, pair = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j, ++pair)
      for (int r = 0; r < 2; ++r)
        stiffness[pair][r] = strain.row(r, i, j, D.membrane, total.membrane);
  return stiffness;
}

/// The geometric part of bending is, with p^c = N,c n and u^c = M^ab N;ab a^c + 1/2 (b_ab M^ab) a^cd N,d n,
/// -(p^c u^c + u^c p^c), c = 1, 2 (theory E.2).
inline PointStiffness<3> point_stiffness(const SurfaceFrame<3> &frame, const Tangent<3> &D, const Stress<3> &total,
                                         Symmetry symmetry)
{
  const double            sign = symmetry == Symmetry::symmetric ? 1. : -1.;
  const MembraneStrain<3> strain{frame};
  const CurvatureChange   change(frame);
  const Voigt            &a         = frame.metric.contravariant;
  const Point<3>         &n         = frame.normal;
  const Point<3>          dual[2]   = {frame.dual_1, frame.dual_2};
  const double            bM        = contract(frame.curvature, total.moment);
  const DerivativePack    m         = change.contract(total.moment); // M^ab N;ab = m_s P_s
  const DerivativePack    metric[2] = {{bM * a[0], bM * a[2]}, {bM * a[2], bM * a[1]}};

  // Membrane stress by change of curvature, for each strain by N,c of component i; change of curvature by itself.
  DerivativePack coupling[3], bending[3], mixed[2][3];
  for (int k = 0; k < 3; ++k)
    {
      coupling[k] = change.contract(D.coupling.row(k));
      bending[k]  = change.contract(D.bending.row(k));
    }
  for (int c = 0; c < 2; ++c)
    for (int i = 0; i < 3; ++i)
      mixed[c][i] = strain.contract(c, i, coupling[0], coupling[1], coupling[2]);
  DerivativePack Q[n_derivatives];
  for (int r = 0; r < n_derivatives; ++r)
    Q[r] = change.rows[0][r] * bending[0] + change.rows[1][r] * bending[1] + change.rows[2][r] * bending[2];

  PointStiffness<3> stiffness;
  for (int i = 0, pair = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++pair)
      {
        const double nn = n[i] * n[j];
        for (int r = 0; r < n_derivatives; ++r)
          {
            const double   y[2] = {sign * n[i] * mixed[0][j][r] - n[j] * dual[0][i] * m[r],
                                   sign * n[i] * mixed[1][j][r] - n[j] * dual[1][i] * m[r]};
            DerivativePack row  = nn * Q[r] + DerivativePack{y[0], y[1]};
            if (r < 2)
              row += n[j] * mixed[r][i] - n[i] * dual[r][j] * m - nn * metric[r] +
                     strain.row(r, i, j, D.membrane, total.membrane);
            stiffness[pair][r] = row;
          }
      }
  return stiffness;
}

inline PointSlope<2> point_slope(const SurfaceFrame<2> &frame, const Stress<2> &stress)
{
  const MembraneStrain<2> strain{frame};
  return {strain.slope(0, stress.membrane), strain.slope(1, stress.membrane)};
}

inline PointSlope<3> point_slope(const SurfaceFrame<3> &frame, const Stress<3> &stress)
{
  const MembraneStrain<3> strain{frame};
  const DerivativePack    m = CurvatureChange(frame).contract(stress.moment);
  PointSlope<3>           slope;
  for (int i = 0; i < 3; ++i)
    slope[i] = strain.slope(i, stress.membrane) + frame.normal[i] * m;
  return slope;
}

/// Stiffness of the phase by derivatives, dA Gc/(2 l0) (c1 A^ab N,a N,b + c2 lap N lap N).
inline std::array<DerivativePack, n_derivatives> phase_stiffness(const ReferenceQuadraturePoint &reference, double c1,
                                                                 double c2)
{
  const auto                               &A   = reference.contravariant;
  const DerivativePack                      lap = {-reference.laplace_1, -reference.laplace_2, A[0], A[1], 2. * A[2]};
  std::array<DerivativePack, n_derivatives> rows;
  for (int r = 0; r < n_derivatives; ++r)
    rows[r] = c2 * lap[r] * lap;
  rows[0] += DerivativePack{c1 * A[0], c1 * A[2]};
  rows[1] += DerivativePack{c1 * A[2], c1 * A[1]};
  return rows;
}

} // namespace sherd::internal
