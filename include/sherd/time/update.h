#pragma once

#include <span>

#include <sherd/algebra/vector.h>
#include <sherd/time/integrator.h>

namespace sherd
{

/// Motion of a set of unknowns: x, v, a of one time. Works on the raw values of vectors, ghosts included.
struct Motion
{
  Vector position, velocity, acceleration;
};

/// Constant-velocity predictor of step @p stage from @p old: v_{n+1} = v_n, a_{n+1} = (gamma - 1)/gamma a_n and x_{n+1}
/// from the update formula. Source: theory F.2.
inline Motion predict(const Stage &stage, const Motion &old)
{
  Motion     next  = old;
  const auto a     = old.acceleration.local();
  const auto v     = old.velocity.local();
  const auto ratio = (stage.gamma - 1.) / stage.gamma;
  for (std::size_t i = 0; i < a.size(); ++i)
    {
      next.acceleration.local()[i] = ratio * a[i];
      next.position.local()[i] += stage.dt * v[i] + stage.dt * stage.dt * (.5 - stage.beta + stage.beta * ratio) * a[i];
    }
  return next;
}

/// Moves unknown @p i of the end of the step by @p dx, and where there is inertia its rates with it:
///   x_{n+1} += dx,  a_{n+1} += dx / (beta dt^2),  v_{n+1} += gamma dx / (beta dt).
///
/// From the predictor on this keeps the update formulas of Stage. The rates follow the increments and not the
/// difference x_{n+1} - x_n, which for small steps has no digits left: rounding of x, divided by dt^2, would exceed any
/// tolerance. Source: theory F.2.
inline void move(const Stage &stage, Motion &next, std::size_t i, double dx)
{
  next.position.local()[i] += dx;
  if (!stage.has_inertia())
    return;
  next.acceleration.local()[i] += dx / (stage.beta * stage.dt * stage.dt);
  next.velocity.local()[i] += stage.gamma * dx / (stage.beta * stage.dt);
}

/// (1 - alpha) y_n + alpha y_{n+1}.
inline Vector interpolate(double alpha, const Vector &old, const Vector &next)
{
  Vector     result = old;
  const auto y      = next.local();
  auto       out    = result.local();
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = (1. - alpha) * out[i] + alpha * y[i];
  return result;
}

} // namespace sherd
