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

/// Random deformation with strains of order 0.1 around the surface stretch J_mean. J differs from J_mean by a few per
/// cent at most, so that the sign of J - 1 is known for J_mean outside [0.9, 1.1].
inline MetricState random_state(RandomNumbers &random, const double J_mean)
{
  Eigen::Matrix2d tangents = Eigen::Matrix2d::Identity(), F = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 4; ++i)
    tangents(i) += random(-.3, .3);
  const double shear = random(-.2, .2), ratio = random(.85, 1.15), turn = random(0., 6.);
  F << ratio, shear, 0., random(.97, 1.03) / ratio;
  F = std::sqrt(J_mean) * Eigen::Rotation2Dd(turn).toRotationMatrix() * F;

  const Eigen::Matrix2d A = tangents.transpose() * tangents;
  const Eigen::Matrix2d a = (F * tangents).transpose() * (F * tangents);
  return {Voigt(A(0, 0), A(1, 1), A(0, 1)), Voigt(a(0, 0), a(1, 1), a(0, 1))};
}

} // namespace sherd::verify
