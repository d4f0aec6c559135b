#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace sherd
{

/// Gauss-Legendre rule in the thickness: int f ds over [-1, 1] is about the sum of weights f(points).
struct ThicknessRule
{
  std::vector<double> points, weights;

  /// @param n_points  at least 2; fewer do not integrate s^2.
  /// @param where     begins the message.
  /// @throws InvalidParameter  for fewer.
  ThicknessRule(const int n_points, const std::string &where)
  {
    if (n_points < 2)
      throw InvalidParameter(where + ": " + print(n_points) + " Gauss points given, at least 2 are needed");
    for (int i = 0; i < n_points; ++i)
      {
        // Newton's method on the Legendre polynomial from the usual asymptotic root.
        double s = std::cos(std::numbers::pi * (i + .75) / (n_points + .5)), slope = 0.;
        for (int iteration = 0; iteration < 8; ++iteration)
          {
            double last = 1., value = s;
            for (int k = 2; k <= n_points; ++k)
              {
                const double next = ((2. * k - 1.) * s * value - (k - 1.) * last) / k;
                last              = value;
                value             = next;
              }
            slope = n_points * (s * value - last) / (s * s - 1.);
            s -= value / slope;
          }
        points.push_back(s);
        weights.push_back(2. / ((1. - s * s) * slope * slope));
      }
  }
};

} // namespace sherd
