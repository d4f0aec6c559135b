#pragma once

#include <sherd/geometry/shapes/checks.h>

#include <Eigen/Core>

namespace sherd::shapes
{

/// How a curved shape becomes a spline.
enum class Fit
{
  /// The shape itself, by rational functions. Shapes that cannot do so, because an arc spans 180 degrees or more or the
  /// degree is too low, are refused.
  exact,
  /// Interpolation of the homogeneous coordinates of the exact shape at the Greville points: the exact shape wherever
  /// `exact` is possible, otherwise rational and of order degree + 1. Arcs of less than 180 degrees.
  rational,
  /// Interpolation of positions at the Greville points: a polynomial surface (all weights 1) of order degree + 1, with
  /// degree - 1 continuous derivatives. Arcs of any length.
  smooth
};

namespace internal
{

/// Arc of the unit circle over t in [0, 1] as (w cos, w sin, w).
///
/// Rational: one quadratic arc, the one whose speed is symmetric and varies least, 1 to 1/cos^2 of a quarter of the
/// opening. Smooth: w = 1 and constant speed.
///
/// Source: theory I.
class Arc
{
public:
  /// @param angles   begin and end [rad]
  /// @param what     shape and argument for the message
  /// @throws InvalidParameter   angles that are not finite or not ascending, more than a full turn (rounding excepted),
  ///                            a rational arc of 180 degrees or more
  Arc(const std::string &what, const std::array<double, 2> &angles, Fit fit) : angles_(angles), fit_(fit)
  {
    const double opening = angles[1] - angles[0];
    const auto   refuse  = [&](const std::string &expected) {
      throw InvalidParameter(what + " = {" + print(angles[0]) + ", " + print(angles[1]) + "}, expected " + expected);
    };
    if (!(std::isfinite(opening) && opening > 0.))
      refuse("finite angles in radians, begin < end");
    if (opening > 2. * M_PI * (1. + 1e-12))
      refuse("at most a full turn, end - begin <= 2 pi");
    if (fit != Fit::smooth && opening >= M_PI)
      refuse("less than 180 degrees, end - begin < pi, of a rational arc; use Fit::smooth for longer ones");
  }

  double angle(double t) const { return angles_[0] + t * (angles_[1] - angles_[0]); }

  Eigen::Vector3d operator()(double t) const
  {
    if (fit_ == Fit::smooth)
      return at(angle(t), 1.);
    return (1. - t) * (1. - t) * at(angles_[0], 1.) +
           2. * t * (1. - t) * at(angle(.5), std::cos(.5 * (angles_[1] - angles_[0]))) + t * t * at(angles_[1], 1.);
  }

private:
  static Eigen::Vector3d at(double angle, double w) { return {std::cos(angle), std::sin(angle), w}; }

  std::array<double, 2> angles_;
  Fit                   fit_;
};

} // namespace internal
} // namespace sherd::shapes
