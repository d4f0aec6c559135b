#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>

namespace sherd::shapes
{

/// Open knot vector with unit spans on [0, n].
template <int degree>
std::vector<double> uniform_knots(int n)
{
  std::vector<double> knots(degree, 0.);
  for (int i = 0; i <= n; ++i)
    knots.push_back(i);
  knots.insert(knots.end(), degree, n);
  return knots;
}

namespace internal
{

/// @throws InvalidParameter   a length that is not positive and finite; @p what names shape and argument
inline void check_length(const std::string &what, double length)
{
  if (!(std::isfinite(length) && length > 0.))
    throw InvalidParameter(what + " = " + print(length) + ", expected a finite length > 0");
}

/// @throws InvalidParameter   less than one element in a direction
inline void check_elements(const std::string &shape, const std::array<int, 2> &elements)
{
  for (int d = 0; d < 2; ++d)
    if (elements[d] < 1)
      throw InvalidParameter(shape + ": elements[" + std::to_string(d) + "] = " + std::to_string(elements[d]) +
                             ", expected at least 1");
}

} // namespace internal
} // namespace sherd::shapes
