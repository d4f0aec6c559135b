#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sherd
{

/// Knots of one univariate B-spline, ascending; the multiplicity of a knot is the number of its repetitions.
template <int degree>
using LocalKnots = std::array<double, degree + 2>;

/// Position and derivatives of one univariate function.
struct UnivariateValue
{
  double value, first, second;
};

/// Non-empty knot span [knots[m], knots[m+1]) that holds @p x (half-open); -1 if @p x lies outside the support.
template <int degree>
int span_index(const LocalKnots<degree> &knots, double x);

/// Value, first and second derivative at @p x of the polynomial piece of the B-spline on knot span @p m.
/// The piece is evaluated wherever @p x lies: at the right end of the domain take the last span (closed there).
/// @pre 0 <= m <= degree, knots[m] < knots[m+1].
template <int degree>
UnivariateValue evaluate_piece(const LocalKnots<degree> &knots, int m, double x);

/// Bernstein coefficients e_j on [@p a, @p b] of the polynomial piece of the B-spline on that interval: N(x) = sum_j
/// e_j b_j((x-a)/(b-a)). The recurrence of Cox and de Boor is run on Bernstein coefficients, whose terms are not
/// negative: no cancellation, relative error of a few rounding units. All zero outside the support.  theory H.5
/// @pre a < b, and no knot lies strictly inside (a, b).
template <int degree>
std::array<double, degree + 1> bernstein_coefficients(const LocalKnots<degree> &knots, double a, double b);

/// Knots obtained from a local knot vector by insertion of more, and the weights of the B-splines on them:
/// N = sum_k weights[k] N_{window k}, window k = knots[k .. k + degree + 1].
struct KnotInsertion
{
  std::vector<double> knots, weights;
};

/// Inserts all of @p inserted, one after the other, into @p knots.  theory H.2, applied to each window:
/// N = alpha_1 N_1 + alpha_2 N_2, N_1 without the last knot of the union, N_2 without the first.
/// @param inserted  values inside the open support; equal values raise the multiplicity
/// @param result    overwritten; pass the same object again to reuse its memory
template <int degree>
void insert_knots(const LocalKnots<degree> &knots, std::span<const double> inserted, KnotInsertion &result);

} // namespace sherd
