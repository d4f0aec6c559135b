#pragma once

#include <sherd/kinematics/curvature.h>
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

/// In space: the curvature of the undeformed surface as well, theory A.1.
template <>
struct ReferencePoint<3> : ReferencePoint<2>
{
  ReferencePoint() = default;

  /// @param curvature  B_ab in the same parametric coordinates.
  ReferencePoint(const Metric &reference, const Voigt &curvature)
      : ReferencePoint<2>(reference),
        curvature(curvature),
        mean_curvature(sherd::mean_curvature(reference, curvature)),
        gauss_curvature(sherd::gauss_curvature(reference, curvature))
  {
  }

  Voigt  curvature;       ///< B_ab [length / parameter^2]
  double mean_curvature;  ///< H_0 [1/length]
  double gauss_curvature; ///< kappa_0 [1/length^2]
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
    I1_minus_2       = trace;
    I1               = 2. + trace;
    deviator         = reference.frame.push(Voigt(half_difference, -half_difference, E[2]));
    deviator_squared = half_difference * half_difference + E[2] * E[2];
  }

  ReferencePoint<2> reference;
  Metric            metric;           ///< a_ab, a^ab, det a_ab
  double            J;                ///< surface stretch, (det a_ab / det A_ab)^{1/2}
  double            J_minus_1;        ///< J - 1 without cancellation
  double            I1;               ///< A^ab a_ab
  double            I1_minus_2;       ///< I1 - 2 without cancellation, twice the trace of the strain
  Voigt             deviator;         ///< D^ab, deviator of A^ac a_cd A^db
  double            deviator_squared; ///< (I1^2 - 4 J^2) / 4 = D^a_b D^b_a / 2 >= 0, a sum of squares
};

/// In space: curvatures besides. Membrane laws take it for the SurfacePoint<2> that it is.
///
/// The change of curvature is the difference of its components, so that bending energies keep their relative accuracy
/// on curved surfaces, up to the rounding of the curvatures themselves.
template <>
struct SurfacePoint<3> : SurfacePoint<2>
{
  /// @param reference  the undeformed point.
  /// @param current    a_ab of the deformed surface in the same parametric coordinates, det a_ab > 0.
  /// @param curvature  b_ab of the deformed surface, about the same side of the normal as B_ab.
  SurfacePoint(const ReferencePoint<3> &reference, const Metric &current, const Voigt &curvature)
      : SurfacePoint<2>(reference, current),
        curvature(curvature),
        curvature_change(curvature - reference.curvature),
        mean_curvature(sherd::mean_curvature(current, curvature)),
        gauss_curvature(sherd::gauss_curvature(current, curvature)),
        reference_mean_curvature(reference.mean_curvature),
        reference_gauss_curvature(reference.gauss_curvature)
  {
  }

  Voigt  curvature;                 ///< b_ab [length / parameter^2]
  Voigt  curvature_change;          ///< k_ab = b_ab - B_ab
  double mean_curvature;            ///< H = a^ab b_ab / 2 [1/length]
  double gauss_curvature;           ///< kappa = det b_ab / det a_ab [1/length^2]
  double reference_mean_curvature;  ///< H_0
  double reference_gauss_curvature; ///< kappa_0
};

} // namespace sherd
