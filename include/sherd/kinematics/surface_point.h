#pragma once

#include <sherd/kinematics/metric.h>
#include <sherd/kinematics/orthonormal_frame.h>

#include <cmath>

namespace sherd
{

/// What a material law needs of the reference surface at one point; constant in time.
///
/// spacedim 2 is the plane; the shell adds curvature by its own specialisation, which derives from this one so that
/// membrane laws take both.
template <int spacedim>
struct ReferencePoint;

template <>
struct ReferencePoint<2>
{
  ReferencePoint() = default;

  explicit ReferencePoint(const Metric &reference) : metric(reference), frame(reference) {}

  Metric           metric; ///< A_ab, A^ab, det A_ab
  OrthonormalFrame frame;  ///< orthonormal frame of the tangent plane
};

/// Deformation of the surface at one point: all that material laws and energy splits see (theory A.1).
template <int spacedim>
struct SurfacePoint;

/// In the plane: the metrics and the invariants of C = A^{-1} a.
///
/// All measures of strain derive from the difference a_ab - A_ab. Nearby numbers subtract without error, so that J - 1
/// and the deviator keep their relative accuracy at the smallest strains, and so do energies and stresses built on
/// them; what remains is the rounding of the metrics themselves.
template <>
struct SurfacePoint<2>
{
  /// @param reference  the undeformed point.
  /// @param current    a_ab of the deformed surface in the same parametric coordinates, det a_ab > 0.
  SurfacePoint(const ReferencePoint<2> &reference, const Metric &current) : reference(reference), metric(current)
  {
    const Voigt E = reference.frame.pull(current.covariant - reference.metric.covariant);

    const double trace = E[0] + E[1], half_difference = .5 * (E[0] - E[1]);
    J                = std::sqrt(current.determinant / reference.metric.determinant);
    J_minus_1        = (trace + (E[0] * E[1] - E[2] * E[2])) / (1. + J);
    I1               = 2. + trace;
    deviator         = reference.frame.push(Voigt(half_difference, -half_difference, E[2]));
    deviator_squared = half_difference * half_difference + E[2] * E[2];
  }

  ReferencePoint<2> reference;
  Metric            metric;           ///< a_ab, a^ab, det a_ab
  double            J;                ///< surface stretch, (det a_ab / det A_ab)^{1/2}
  double            J_minus_1;        ///< J - 1 without cancellation
  double            I1;               ///< A^ab a_ab
  Voigt             deviator;         ///< D^ab, deviator of A^ac a_cd A^db
  double            deviator_squared; ///< (I1^2 - 4 J^2) / 4 = D^a_b D^b_a / 2 >= 0, a sum of squares
};

} // namespace sherd
