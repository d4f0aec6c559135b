#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/crack_density/crack_density.h>

#include <cmath>

namespace sherd::crack_density
{

/// Second-order density with an elastic limit (AT1), theory C.1: w = 3/2 d in the damage d = 1 - phi, c1 = 3/2 l0^2.
///
/// Nothing is damaged below the driving energy 3 Gc / (8 l0 g'(1)), and a crack ends at the distance 2 l0. The bound
/// phi <= 1, without which d < 0 would gain energy, is part of the density: within the width W of the intact state w is
/// a parabola that meets the straight line with equal slope,
///
///   w = 3/2 d^2 / (2 W) for d < W,   3/2 (d - W/2) for d >= W,
///
/// so that the intact state is a minimum, phi = 1 exactly, and the phase equation has no constraint and needs no active
/// set. c1 and the profile are those of this w: a crack costs exactly Gc for any width. Where w'' jumps, at d = W,
/// Newton's method goes on as with the jumps of a history; w is convex.
///
/// With W = 1e-2 stresses up to the peak are right to 2 % and a crack nucleates from the intact state in about 9
/// iterations, with 1e-3 to 0.2 % and in about 17. The strip of a pre-crack, made for the fourth order, costs 1.13 Gc.
///
/// Use it with a degradation whose slope at the intact state is of order 1 (quadratic, rational): with the cubic
/// function the elastic limit is 1 / s times higher.
class AT1
{
public:
  static constexpr int order = 2;

  AT1() : AT1(1e-2) {}

  /// @param width  W, in (0, 0.1]. The limit of elasticity is sharp up to this damage.
  /// @throws InvalidParameter  outside that interval.
  explicit AT1(const double width) : width_(width)
  {
    if (!(width > 0. && width <= .1))
      throw InvalidParameter("AT1 crack density: width " + print(width) +
                             " of the bound must lie in (0, 0.1]; the usual value is 1e-2");
    // A crack costs Gc sqrt(c1) / l0 int_0^1 sqrt(w) dd.
    const double parabola = .5 * width * std::sqrt(.75 * width);
    const double line     = (std::pow(1.5 - .75 * width, 1.5) - std::pow(.75 * width, 1.5)) / 2.25;
    steepness_            = parabola + line;
    edge_                 = (std::sqrt(1.5 - .75 * width) - std::sqrt(.75 * width)) / (.75 * steepness_);
  }

  double width() const { return width_; }

  /// w
  double local(const double phi) const
  {
    const double d = 1. - phi;
    return d < width_ ? .75 * d * d / width_ : 1.5 * (d - .5 * width_);
  }
  double local_first(const double phi) const { return 1. - phi < width_ ? -1.5 * (1. - phi) / width_ : -1.5; } ///< w'
  double local_second(const double phi) const { return 1. - phi < width_ ? 1.5 / width_ : 0.; }                ///< w''

  double c1(const double l0) const { return l0 * l0 / (steepness_ * steepness_); } ///< 3/2 l0^2 for a vanishing width
  double c2(const double) const { return 0.; }

  /// r - r^2/4 up to r = 2 for a vanishing width; solves c1 d'^2 = w.
  double profile(const double r) const
  {
    if (r >= edge_)
      return 1. - width_ * std::exp(-(r - edge_) * steepness_ * std::sqrt(.75 / width_));
    const double at_crack = 1.5 - .75 * width_, slope = .75 * steepness_;
    return r * slope * (2. * std::sqrt(at_crack) - slope * r) / 1.5;
  }

private:
  double width_;
  double steepness_; ///< int_0^1 sqrt(w) dd = l0 / sqrt(c1)
  double edge_;      ///< r where d = W
};

static_assert(CrackDensity<AT1>);

} // namespace sherd::crack_density
