#pragma once

#include <sherd/kinematics/surface_point.h>

#include <cstdint>
#include <random>

namespace sherd::verify
{

/// Reproducible numbers: the same on every platform for the same seed.
class RandomNumbers
{
public:
  explicit RandomNumbers(const std::uint32_t seed) : engine_(seed) {}

  /// Uniform in [low, high].
  double operator()(const double low, const double high)
  {
    return low + (high - low) * (static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max()));
  }

private:
  std::mt19937 engine_;
};

/// One deformed point of a surface: covariant metrics on skewed parametric coordinates.
struct MetricState
{
  Voigt reference; ///< A_ab
  Voigt current;   ///< a_ab

  SurfacePoint<2> point() const { return {ReferencePoint<2>(metric(reference)), metric(current)}; }
};

/// One deformed point of a shell: covariant metrics and curvatures on skewed parametric coordinates.
struct ShellState
{
  Voigt reference, current;                     ///< A_ab, a_ab
  Voigt reference_curvature, current_curvature; ///< B_ab, b_ab

  SurfacePoint<3> point() const
  {
    return {ReferencePoint<3>(metric(reference), reference_curvature), metric(current), current_curvature};
  }
};

namespace internal
{
/// Tangents of the undeformed surface and deformation gradient of the tangent plane, in Cartesian coordinates.
struct RandomGradient
{
  Eigen::Matrix2d tangents, F;
};

inline RandomGradient random_gradient(RandomNumbers &random, const double J_mean)
{
  Eigen::Matrix2d tangents = Eigen::Matrix2d::Identity(), F = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 4; ++i)
    tangents(i) += random(-.3, .3);
  const double shear = random(-.2, .2), ratio = random(.85, 1.15), turn = random(0., 6.);
  F << ratio, shear, 0., random(.97, 1.03) / ratio;
  F = std::sqrt(J_mean) * Eigen::Rotation2Dd(turn).toRotationMatrix() * F;

  return {tangents, F};
}

/// T(t_a, t_b) of a Cartesian tensor and the columns t_a.
inline Voigt components(const Eigen::Matrix2d &T, const Eigen::Matrix2d &tangents)
{
  const Eigen::Matrix2d product = tangents.transpose() * T * tangents;
  return {product(0, 0), product(1, 1), product(0, 1)};
}

inline Voigt reparametrised(const Voigt &T, const Eigen::Matrix2d &R)
{
  return components(Eigen::Matrix2d{{T[0], T[2]}, {T[2], T[1]}}, R);
}
} // namespace internal

/// Random change of the parametric coordinates: columns are the new tangents in terms of the old ones.
inline Eigen::Matrix2d random_parametrisation(RandomNumbers &random)
{
  Eigen::Matrix2d stretch;
  stretch << random(.6, 1.6), random(-.5, .5), 0., random(.6, 1.6);
  return Eigen::Rotation2Dd(random(0., 6.)).toRotationMatrix() * stretch;
}

/// The same deformation in other parametric coordinates.
inline MetricState reparametrised(const MetricState &state, const Eigen::Matrix2d &R)
{
  return {internal::reparametrised(state.reference, R), internal::reparametrised(state.current, R)};
}
inline ShellState reparametrised(const ShellState &state, const Eigen::Matrix2d &R)
{
  return {internal::reparametrised(state.reference, R), internal::reparametrised(state.current, R),
          internal::reparametrised(state.reference_curvature, R), internal::reparametrised(state.current_curvature, R)};
}

/// Random deformation with strains of order 0.1 around the surface stretch J_mean. J differs from J_mean by a few per
/// cent at most, so that the sign of J - 1 is known for J_mean outside [0.9, 1.1].
inline MetricState random_state(RandomNumbers &random, const double J_mean)
{
  const auto [tangents, F] = internal::random_gradient(random, J_mean);
  return {internal::components(Eigen::Matrix2d::Identity(), tangents),
          internal::components(Eigen::Matrix2d::Identity(), F * tangents)};
}

/// Curvatures of a random state.
enum class Bending
{
  general, ///< both surfaces curved: near J = 1 mostly one layer keeps its area
  saddle   ///< a flat surface bent into a saddle without mean curvature: near J = 1 none or two
};

/// Random deformation as random_state(), with principal curvatures of at most 0.5 / thickness, so that no layer within
/// the thickness is turned inside out.
inline ShellState random_shell_state(RandomNumbers &random, const double J_mean, const double thickness,
                                     const Bending bending = Bending::general)
{
  const auto [tangents, F] = internal::random_gradient(random, J_mean);
  Eigen::Matrix2d B = Eigen::Matrix2d::Zero(), b = Eigen::Matrix2d::Zero();
  const auto      curvature = [&] { return random(-.25, .25) / thickness; };
  if (bending == Bending::general)
    {
      B << curvature(), curvature(), 0., curvature();
      b << curvature(), curvature(), 0., curvature();
      B(1, 0) = B(0, 1);
      b(1, 0) = b(0, 1);
    }
  else
    {
      b << curvature(), curvature(), 0., 0.;
      b(1, 0) = b(0, 1);
      b(1, 1) = -b(0, 0);
    }
  return {internal::components(Eigen::Matrix2d::Identity(), tangents),
          internal::components(Eigen::Matrix2d::Identity(), F * tangents), internal::components(B, tangents),
          internal::components(b, F * tangents)};
}

} // namespace sherd::verify
