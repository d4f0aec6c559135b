#pragma once

#include <array>

#include <sherd/spline/quadrature.h>

namespace sherd
{

/// Number of Bernstein polynomials, and of Gauss points, of one element.
template <int degree>
inline constexpr int n_bernstein = (degree + 1) * (degree + 1);

/// Univariate Bernstein polynomials b_i(t) = binom(degree, i) t^i (1-t)^(degree-i), i = 0..degree, and derivatives.
template <int degree>
struct UnivariateBernstein
{
  std::array<double, degree + 1> value{}, first{}, second{};
};

/// Evaluates the univariate Bernstein polynomials at @p t in [0, 1].
template <int degree>
constexpr UnivariateBernstein<degree> bernstein_1d(double t)
{
  static_assert(degree >= 1);
  // Differences of a lower degree: the derivative of b_i^p is p (b_{i-1}^{p-1} - b_i^{p-1}).
  const auto differentiate = [](const std::array<double, degree + 1> &lower, int from_degree) {
    std::array<double, degree + 1> result{};
    for (int i = 0; i <= from_degree + 1; ++i)
      result[i] = (from_degree + 1) * ((i > 0 ? lower[i - 1] : 0.) - (i <= from_degree ? lower[i] : 0.));
    return result;
  };
  UnivariateBernstein<degree>    b;
  std::array<double, degree + 1> current{1.};
  for (int k = 0; k < degree; ++k)
    {
      if (k == degree - 2)
        b.second = differentiate(differentiate(current, k), k + 1);
      if (k == degree - 1)
        b.first = differentiate(current, k);
      std::array<double, degree + 1> next{};
      for (int i = 0; i <= k; ++i)
        {
          next[i] += (1. - t) * current[i];
          next[i + 1] += t * current[i];
        }
      current = next;
    }
  b.value = current;
  return b;
}

/// All bivariate Bernstein polynomials of one degree at one point of [0,1]^2.
/// Polynomial b = j (degree+1) + i is b_i(s) b_j(t): i runs along the first coordinate, fastest.
template <int degree>
struct BernsteinValues
{
  std::array<double, n_bernstein<degree>>                value{};  ///< shape=(n_bernstein)
  std::array<std::array<double, 2>, n_bernstein<degree>> first{};  ///< d/ds, d/dt
  std::array<std::array<double, 3>, n_bernstein<degree>> second{}; ///< d2/ds2, d2/dt2, d2/dsdt
};

/// Evaluates all bivariate Bernstein polynomials at (@p s, @p t) in [0,1]^2.
template <int degree>
constexpr BernsteinValues<degree> bernstein_2d(double s, double t)
{
  const auto              along_s = bernstein_1d<degree>(s);
  const auto              along_t = bernstein_1d<degree>(t);
  BernsteinValues<degree> result;
  for (int j = 0, b = 0; j <= degree; ++j)
    for (int i = 0; i <= degree; ++i, ++b)
      {
        result.value[b]  = along_s.value[i] * along_t.value[j];
        result.first[b]  = {along_s.first[i] * along_t.value[j], along_s.value[i] * along_t.first[j]};
        result.second[b] = {along_s.second[i] * along_t.value[j], along_s.value[i] * along_t.second[j],
                            along_s.first[i] * along_t.first[j]};
      }
  return result;
}

/// Bernstein polynomials at the (degree+1)^2 Gauss points of [0,1]^2, shared by all elements, made at compile time.
///
/// Point q = j (degree+1) + i and polynomial b are both numbered with the first coordinate fastest. Derivatives are
/// with respect to the coordinates of [0,1]^2; on an element of parameter size (h_u, h_v) divide by h_u, h_v.
template <int degree>
struct BernsteinTable
{
  static constexpr int n = n_bernstein<degree>; ///< number of points and of polynomials

  std::array<std::array<double, 2>, n>                points{};  ///< shape=(n, 2)
  std::array<double, n>                               weights{}; ///< shape=(n), sum 1
  std::array<std::array<double, n>, n>                value{};   ///< [q][b]
  std::array<std::array<std::array<double, 2>, n>, n> first{};   ///< [q][b][d/ds, d/dt]
  std::array<std::array<std::array<double, 3>, n>, n> second{};  ///< [q][b][d2/ds2, d2/dt2, d2/dsdt]

  /// The table.
  static constexpr const BernsteinTable &get();
};

namespace internal
{

template <int degree>
constexpr BernsteinTable<degree> make_bernstein_table()
{
  const auto            &rule = gauss_legendre(degree + 1);
  BernsteinTable<degree> table;
  for (int j = 0, q = 0; j <= degree; ++j)
    for (int i = 0; i <= degree; ++i, ++q)
      {
        const auto values = bernstein_2d<degree>(rule.points[i], rule.points[j]);
        table.points[q]   = {rule.points[i], rule.points[j]};
        table.weights[q]  = rule.weights[i] * rule.weights[j];
        table.value[q]    = values.value;
        table.first[q]    = values.first;
        table.second[q]   = values.second;
      }
  return table;
}

template <int degree>
inline constexpr BernsteinTable<degree> bernstein_table = make_bernstein_table<degree>();

} // namespace internal

template <int degree>
constexpr const BernsteinTable<degree> &BernsteinTable<degree>::get()
{
  return internal::bernstein_table<degree>;
}

} // namespace sherd
