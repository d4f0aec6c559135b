#pragma once

#include <sherd/material/split/split.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sherd::verify::internal
{

/// Blocks c, d, e, f of a tangent side by side; in the plane c alone.
inline std::array<Voigt4, 1> blocks(const Tangent<2> &tangent)
{
  return {tangent.membrane};
}
inline std::array<Voigt4, 4> blocks(const Tangent<3> &tangent)
{
  return {tangent.membrane, tangent.coupling, tangent.moment_coupling, tangent.bending};
}

/// Whether both tangents of a split vary smoothly along a path for |h| <= step: whether their second differences are
/// small against the tangent of the whole. A tangent jumps where the stress has a kink, and there difference quotients
/// say nothing.
/// @param at  response along the path.
template <class Respond>
bool is_smooth(const Respond &at, const double step)
{
  constexpr double largest_jump = 4e-3;
  const auto       middle       = at(0.);
  const auto       scales       = [&] {
    auto         sum   = blocks(middle.tangent_active + middle.tangent_passive);
    const double first = sum.front().cwiseAbs().maxCoeff(), last = sum.back().cwiseAbs().maxCoeff();
    std::array<double, std::tuple_size_v<decltype(sum)>> scale;
    scale.fill(std::sqrt(first * last));
    scale.front() = first;
    scale.back()  = last;
    return scale;
  }();

  const std::array<decltype(at(0.)), 5> samples{at(-step), at(-.5 * step), middle, at(.5 * step), at(step)};
  for (const auto part : {&decltype(at(0.))::tangent_active, &decltype(at(0.))::tangent_passive})
    for (int i = 1; i < 4; ++i)
      {
        const auto before = blocks(samples[i - 1].*part), here = blocks(samples[i].*part),
                   after = blocks(samples[i + 1].*part);
        for (std::size_t k = 0; k < scales.size(); ++k)
          if ((before[k] - 2. * here[k] + after[k]).cwiseAbs().maxCoeff() > largest_jump * scales[k])
            return false;
      }
  return true;
}

} // namespace sherd::verify::internal
