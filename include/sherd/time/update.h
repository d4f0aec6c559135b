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

/// Velocity and acceleration of x_{n+1}:
///   a_{n+1} = (x_{n+1} - x_n - dt v_n)/(beta dt^2) - (1 - 2 beta)/(2 beta) a_n,
///   v_{n+1} = v_n + dt [(1 - gamma) a_n + gamma a_{n+1}].
/// Source: theory F.2.
inline void update_rates(const Stage &stage, const Motion &old, Motion &next)
{
  const auto   x0 = old.position.local(), v0 = old.velocity.local(), a0 = old.acceleration.local();
  const auto   x1 = next.position.local();
  auto         v1 = next.velocity.local(), a1 = next.acceleration.local();
  const double inverse = 1. / (stage.beta * stage.dt * stage.dt);
  const double keep    = (1. - 2. * stage.beta) / (2. * stage.beta);
  for (std::size_t i = 0; i < x1.size(); ++i)
    {
      a1[i] = (x1[i] - x0[i] - stage.dt * v0[i]) * inverse - keep * a0[i];
      v1[i] = v0[i] + stage.dt * ((1. - stage.gamma) * a0[i] + stage.gamma * a1[i]);
    }
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
