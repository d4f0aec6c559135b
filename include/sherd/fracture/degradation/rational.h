#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/degradation/degradation.h>

#include <cmath>

namespace sherd::degradation
{

/// Rational degradation of cohesive cracks, theory C.2:
///
///   g = phi^2 / (phi^2 + Q),   Q = m d (1 + P d),   d = 1 - phi,   g'(1) = m.
///
/// m sets the onset of damage and P the softening that follows. Above phi = 1, where Q turns negative and g has a pole,
/// it goes on as its Taylor polynomial of second degree in phi - 1.
class Rational
{
public:
  /// @param slope  m, positive and finite; the greater it is, the lower the strength.
  /// @param shape  P, at least -0.9 and finite; -0.5 gives nearly linear softening.
  /// @throws InvalidParameter  for values outside these ranges.
  explicit Rational(const double slope, const double shape = -.5) : m_(slope), P_(shape)
  {
    if (!(std::isfinite(slope) && slope > 0.))
      throw InvalidParameter("rational degradation: slope m = " + print(slope) + " must be positive and finite");
    if (!(std::isfinite(shape) && shape >= -.9))
      throw InvalidParameter("rational degradation: shape P = " + print(shape) + " must be finite and at least -0.9");
  }

  double slope() const { return m_; }
  double shape() const { return P_; }

  /// g
  double value(const double phi) const
  {
    if (phi > 1.)
      return 1. + (phi - 1.) * (m_ + .5 * second(1.) * (phi - 1.));
    return phi * phi / denominator(phi);
  }

  /// g' = m phi (1 + (1 + 2 P) d) / (phi^2 + Q)^2
  double first(const double phi) const
  {
    if (phi > 1.)
      return m_ + second(1.) * (phi - 1.);
    const double S = denominator(phi);
    return m_ * phi * (1. + (1. + 2. * P_) * (1. - phi)) / (S * S);
  }

  /// g'' = (2 - 2 g' S' - g S'') / S with S = phi^2 + Q
  double second(const double phi) const
  {
    if (phi > 1.)
      return second(1.);
    const double S = denominator(phi), S_1 = 2. * phi - m_ * (1. + 2. * P_ * (1. - phi)), S_2 = 2. + 2. * m_ * P_;
    return (2. - 2. * first(phi) * S_1 - phi * phi / S * S_2) / S;
  }

private:
  double denominator(const double phi) const
  {
    const double d = 1. - phi;
    return phi * phi + m_ * d * (1. + P_ * d);
  }

  double m_, P_;
};

static_assert(Degradation<Rational>);

} // namespace sherd::degradation
