#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace sherd::verify
{

/// How a derivative compares with the difference quotients of its function.
struct DerivativeCheck
{
  /// Observed order of the defect in the step: 2 for a right derivative of a smooth function, 0 for a wrong one,
  /// infinite where the quotient is exact to rounding at every step (polynomials up to degree 2).
  double order;

  /// Smallest defect over all steps, relative to the derivative or, where that is larger, to the slope over the largest
  /// step (a derivative may vanish).
  double smallest_defect;

  /// What a right derivative reaches: order 2, less the scatter of the slope, and the accuracy of the best quotient.
  static constexpr double required_order = 1.8, allowed_defect = 1e-7;

  bool passed() const { return order > required_order && smallest_defect <= allowed_defect; }
};

namespace internal
{
template <class Value>
double largest_entry(const Value &value)
{
  if constexpr (std::is_arithmetic_v<Value>)
    return std::abs(value);
  else
    return value.allFinite() ? value.cwiseAbs().maxCoeff() : std::numeric_limits<double>::quiet_NaN();
}
} // namespace internal

/// Compares f'(0) with central difference quotients (f(h) - f(-h)) / (2 h) for h = step, step/2, step/4, ...
///
/// The order is the slope of a least-squares line through log(defect) over log(h), taken over the steps whose defect
/// is above the rounding of the quotient. To check a gradient or a Jacobian, let f be a path x(h) = x + h d and pass
/// its derivative times d.
/// @param f           value along the path: a number or an Eigen matrix.
/// @param derivative  df/dh at h = 0, of the type or shape of f.
/// @param step        largest step, so small that f is smooth on [-step, step].
/// @param n_steps     number of steps, at least 3.
template <class Function, class Derivative>
DerivativeCheck check_derivative(const Function &f, const Derivative &derivative, const double step = 1e-2,
                                 const int n_steps = 14)
{
  using Value        = std::decay_t<decltype(f(0.))>;
  const Value  value = f(0.), ahead = f(step), behind = f(-step);
  const double rounding = 200. * std::numeric_limits<double>::epsilon() *
                          std::max(internal::largest_entry(value), internal::largest_entry(ahead));
  const double scale =
      std::max({internal::largest_entry(Value(derivative)), internal::largest_entry(Value(ahead - value)) / step,
                internal::largest_entry(Value(behind - value)) / step});

  double                     smallest = std::numeric_limits<double>::infinity();
  Eigen::Array<double, 5, 1> sums     = Eigen::Array<double, 5, 1>::Zero(); // n, x, y, xx, xy
  double                     h        = step;
  for (int i = 0; i < n_steps; ++i, h /= 2.)
    {
      const Value  quotient = (f(h) - f(-h)) / (2. * h);
      const double defect   = internal::largest_entry(Value(quotient - derivative));
      if (!std::isfinite(defect))
        return {0., std::numeric_limits<double>::infinity()};
      smallest = std::min(smallest, defect);
      if (defect > rounding / h)
        {
          const double x = std::log(h), y = std::log(defect);
          sums += Eigen::Array<double, 5, 1>{1., x, y, x * x, x * y};
        }
    }
  const bool   exact = sums[0] < 2.;
  const double order = exact ? std::numeric_limits<double>::infinity()
                             : (sums[0] * sums[4] - sums[1] * sums[2]) / (sums[0] * sums[3] - sums[1] * sums[1]);
  return {order, scale > 0. ? smallest / scale : smallest};
}

} // namespace sherd::verify
