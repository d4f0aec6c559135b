#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/base/parameter_section.h>

namespace sherd
{

/// How far Newton goes along its direction d. The slope is s(t) = d . r(x + t d) with the residual r, which is the
/// derivative of -Pi where forces have a potential Pi; s vanishes where the energy along d is least.
struct LineSearchSettings
{
  int    max_trials = 5;  ///< lengths tried beyond the full step; 0: always the full step
  double slope      = .8; ///< a length is taken once |s(t)| <= slope |s(0)|
  double shortest   = .1; ///< lengths stay in [shortest, 1]

  void declare(ParameterSection &section)
  {
    section.value("max_trials", max_trials, range::non_negative(), "lengths tried beyond the full step; 0: none");
    section.value("slope", slope, "-", range::open(0., 1.), "part of the slope that may remain");
    section.value("shortest", shortest, "-", range::left_open(0., 1.), "shortest part of a step that is tried");
  }
};

/// Length t in [shortest, 1] of a step: 1 if its slope is small enough, else by regula falsi (Illinois) on s where it
/// changes sign; where it does not, the length with the smallest |s|.
/// @param slope0     s(0)
/// @param slope_at   s(t), called at most 1 + max_trials times
template <class Slope>
double search_line(double slope0, const Slope &slope_at, const LineSearchSettings &settings)
{
  double low = 0., s_low = slope0, high = 1., s_high = slope_at(1.);
  double best = 1., s_best = std::abs(s_high);
  for (int trial = 0; trial < settings.max_trials; ++trial)
    {
      if (s_best <= settings.slope * std::abs(slope0) || !((s_low < 0.) != (s_high < 0.)))
        break;
      const double t = std::clamp(low + (high - low) * s_low / (s_low - s_high), settings.shortest, 1.);
      const double s = slope_at(t);
      if (!(std::abs(s) >= s_best))
        {
          best   = t;
          s_best = std::abs(s);
        }
      if ((s < 0.) == (s_high < 0.))
        {
          high   = t;
          s_high = s;
          s_low *= .5;
        }
      else
        {
          low   = t;
          s_low = s;
          s_high *= .5;
        }
      if (low >= high || high <= settings.shortest)
        break;
    }
  return best;
}

} // namespace sherd
