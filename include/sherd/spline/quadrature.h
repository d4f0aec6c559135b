#pragma once

#include <array>
#include <string>

#include <sherd/base/exceptions.h>

namespace sherd
{

/// Gauss-Legendre rule on [0, 1]: exact for polynomials up to degree 2 n_points - 1, weights sum to 1.
struct GaussRule
{
  static constexpr int max_points = 10;

  int                            n_points = 0;
  std::array<double, max_points> points{};  ///< ascending, inside (0, 1); the first n_points count
  std::array<double, max_points> weights{}; ///< positive; the first n_points count
};

namespace internal
{

struct LegendreValue
{
  long double value, derivative;
};

/// Legendre polynomial P_n and its derivative at x in (-1, 1), by the three-term recurrence.
constexpr LegendreValue legendre(int n, long double x)
{
  long double previous = 1, current = x;
  for (int k = 2; k <= n; ++k)
    {
      const long double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
      previous               = current;
      current                = next;
    }
  return {current, n * (previous - x * current) / (1 - x * x)};
}

/// Root of P_n in the bracket [low, high], which shows a change of sign.
constexpr long double legendre_root(int n, long double low, long double high)
{
  const bool rising = legendre(n, low).value < 0;
  for (int i = 0; i < 70; ++i)
    {
      const long double middle                                 = (low + high) / 2;
      ((legendre(n, middle).value < 0) == rising ? low : high) = middle;
    }
  return (low + high) / 2;
}

constexpr GaussRule make_gauss_rule(int n)
{
  // Brackets of the roots: finer than their smallest distance, and odd in number so that x = 0 is not an end.
  constexpr int n_brackets = 129;
  GaussRule     rule;
  for (int i = 0; i < n_brackets; ++i)
    {
      const long double low  = (2.L * i - n_brackets) / n_brackets;
      const long double high = (2.L * (i + 1) - n_brackets) / n_brackets;
      // The outer ends -1 and 1 hold no root; the derivative is not defined there.
      const bool low_negative  = i == 0 ? n % 2 == 1 : legendre(n, low).value < 0;
      const bool high_negative = i + 1 == n_brackets ? false : legendre(n, high).value < 0;
      if (low_negative == high_negative)
        continue;
      const bool        middle    = n % 2 == 1 && 2 * rule.n_points + 1 == n;
      const long double x         = middle ? 0 : legendre_root(n, low, high);
      const long double slope     = legendre(n, x).derivative;
      rule.points[rule.n_points]  = static_cast<double>((1 + x) / 2);
      rule.weights[rule.n_points] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
      ++rule.n_points;
    }
  return rule;
}

inline constexpr auto gauss_rules = [] {
  std::array<GaussRule, GaussRule::max_points> rules;
  for (int n = 1; n <= GaussRule::max_points; ++n)
    rules[n - 1] = make_gauss_rule(n);
  return rules;
}();

} // namespace internal

/// The rule with @p n_points points, from a table made at compile time in extended precision.
/// @throws InvalidParameter  outside 1..10
constexpr const GaussRule &gauss_legendre(int n_points)
{
  if (n_points < 1 || n_points > GaussRule::max_points)
    throw InvalidParameter("gauss_legendre: " + std::to_string(n_points) + " points; 1 to " +
                           std::to_string(GaussRule::max_points) + " are available");
  return internal::gauss_rules[n_points - 1];
}

} // namespace sherd
