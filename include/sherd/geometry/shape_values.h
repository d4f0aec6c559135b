#pragma once

#include <array>

#include <sherd/spline/bernstein.h>

namespace sherd
{

/// The (degree+1)^2 shape functions S_b of one element at its Gauss points, with first and second derivatives with
/// respect to the coordinates of the element, which run over [0,1]^2 (theory is invariant under re-parametrisation,
/// so each element uses its own). Index order [q][b], b = j*(degree+1)+i with i along u.
///
/// On a polynomial element they are the Bernstein polynomials and shared by all elements; on a rational one
/// S_b = B_b / W with W = sum_b W_b B_b.
///
/// Source: theory H.5.
template <int degree>
struct ShapeValues
{
  static constexpr int n_functions = (degree + 1) * (degree + 1);
  static constexpr int n_points    = (degree + 1) * (degree + 1);
  using Table                      = std::array<std::array<double, n_functions>, n_points>;

  alignas(64) Table value;    ///< S
  alignas(64) Table d1, d2;   ///< S,1  S,2
  alignas(64) Table d11, d22; ///< S,11  S,22
  alignas(64) Table d12;      ///< S,12
};

/// Polynomial shape functions: the Bernstein polynomials of the element.
template <int degree>
const ShapeValues<degree> &polynomial_shape_values()
{
  static const ShapeValues<degree> values = [] {
    ShapeValues<degree> s;
    const auto         &table = BernsteinTable<degree>::get();
    for (int q = 0; q < s.n_points; ++q)
      for (int b = 0; b < s.n_functions; ++b)
        {
          s.value[q][b] = table.value[q][b];
          s.d1[q][b]    = table.first[q][b][0];
          s.d2[q][b]    = table.first[q][b][1];
          s.d11[q][b]   = table.second[q][b][0];
          s.d22[q][b]   = table.second[q][b][1];
          s.d12[q][b]   = table.second[q][b][2];
        }
    return s;
  }();
  return values;
}

/// Rational shape functions S_b = B_b / W, where @p denominator holds the Bernstein coefficients W_b > 0, shape=(n_b).
/// Quotient rule of theory H.5.
template <int degree>
ShapeValues<degree> rational_shape_values(const std::array<double, ShapeValues<degree>::n_functions> &denominator)
{
  ShapeValues<degree> s = polynomial_shape_values<degree>();
  for (int q = 0; q < s.n_points; ++q)
    {
      double w = 0., w1 = 0., w2 = 0., w11 = 0., w22 = 0., w12 = 0.;
      for (int b = 0; b < s.n_functions; ++b)
        {
          w += denominator[b] * s.value[q][b];
          w1 += denominator[b] * s.d1[q][b];
          w2 += denominator[b] * s.d2[q][b];
          w11 += denominator[b] * s.d11[q][b];
          w22 += denominator[b] * s.d22[q][b];
          w12 += denominator[b] * s.d12[q][b];
        }
      for (int b = 0; b < s.n_functions; ++b)
        {
          const double r  = s.value[q][b] / w;
          const double r1 = (s.d1[q][b] - r * w1) / w;
          const double r2 = (s.d2[q][b] - r * w2) / w;
          s.d11[q][b]     = (s.d11[q][b] - 2. * r1 * w1 - r * w11) / w;
          s.d22[q][b]     = (s.d22[q][b] - 2. * r2 * w2 - r * w22) / w;
          s.d12[q][b]     = (s.d12[q][b] - r1 * w2 - r2 * w1 - r * w12) / w;
          s.value[q][b]   = r;
          s.d1[q][b]      = r1;
          s.d2[q][b]      = r2;
        }
    }
  return s;
}

} // namespace sherd
