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
/// changes sign; where it does not, 1. Lengths whose slope is not finite are halved. After max_trials the length with
/// the smallest |s|.
/// @param slope0     s(0)
/// @param slope_at   s(t), called at most 1 + max_trials times
template <class Slope>
double search_line(double slope0, const Slope &slope_at, const LineSearchSettings &settings)
{
  double high = 1., s_high = slope_at(high);
  int    trials = 0;
  for (; !std::isfinite(s_high) && trials < settings.max_trials && high > settings.shortest; ++trials)
    {
      high   = std::max(.5 * high, settings.shortest);
      s_high = slope_at(high);
    }
  double low = 0., s_low = slope0;
  double best = high, s_best = std::abs(s_high);
  int    last_side = 0;
  for (; trials < settings.max_trials; ++trials)
    {
      const bool brackets = s_low * s_high < 0.;
      if (!brackets || s_best <= settings.slope * std::abs(slope0) || high <= settings.shortest)
        break;
      const double t = std::max(low + (high - low) * s_low / (s_low - s_high), settings.shortest);
      const double s = slope_at(t);
      if (!std::isfinite(s))
        break;
      if (std::abs(s) < s_best)
        {
          best   = t;
          s_best = std::abs(s);
        }
      // Illinois: an end that stays twice counts half, or regula falsi would crawl.
      const int side              = s * s_high > 0. ? 1 : -1;
      (side > 0 ? high : low)     = t;
      (side > 0 ? s_high : s_low) = s;
      if (side == last_side)
        (side > 0 ? s_low : s_high) *= .5;
      last_side = side;
    }
  return best;
}

} // namespace sherd
