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

/// Constant-velocity predictor of a stage from the motion at the start of the step and the one at the end of the stage
/// before (the start again in the first stage): v_new = v_before, a_new = (v_before - V) / (gamma dt), x_new from the
/// update formula. Source: theory F.2.
inline Motion predict(const Stage &stage, const Motion &start, const Motion &before)
{
  const auto &s = stage.start, &b = stage.before;
  const auto  x = start.position.local(), v = start.velocity.local(), a = start.acceleration.local();
  const auto  xb = before.position.local(), vb = before.velocity.local(), ab = before.acceleration.local();
  const auto  dt   = stage.dt;
  Motion      next = before;
  for (std::size_t i = 0; i < x.size(); ++i)
    {
      // V - v_before and X - x, with the sums of weights already taken: equal values leave no rounding.
      const double dv = s.v_of_v * (v[i] - vb[i]) + dt * (s.v_of_a * a[i] + b.v_of_a * ab[i]);
      const double dx = b.x_of_x * (xb[i] - x[i]) + dt * (s.x_of_v * v[i] + b.x_of_v * vb[i]) +
                        dt * dt * (s.x_of_a * a[i] + b.x_of_a * ab[i]);
      next.acceleration.local()[i] = -dv / (stage.gamma * dt);
      next.position.local()[i]     = x[i] + dx + stage.beta * dt * dt * next.acceleration.local()[i];
    }
  return next;
}

/// Moves unknown @p i of the end of a stage by @p dx, and where there is inertia its rates with it:
///   x_new += dx,  a_new += dx / (beta dt^2),  v_new += gamma dx / (beta dt).
///
/// From the predictor on this keeps the update formulas of Stage. The rates follow the increments and not the
/// difference x_new - x_n, which for small steps has no digits left: rounding of x, divided by dt^2, would exceed any
/// tolerance. Source: theory F.2.
inline void move(const Stage &stage, Motion &next, std::size_t i, double dx)
{
  next.position.local()[i] += dx;
  if (!stage.has_inertia())
    return;
  next.acceleration.local()[i] += dx / (stage.beta * stage.dt * stage.dt);
  next.velocity.local()[i] += stage.gamma * dx / (stage.beta * stage.dt);
}

/// Gives unknown @p i at the end of an explicit stage its acceleration, and its velocity by the update formula.
inline void accelerate(const Stage &stage, Motion &next, std::size_t i, double acceleration)
{
  next.velocity.local()[i] += stage.gamma * stage.dt * (acceleration - next.acceleration.local()[i]);
  next.acceleration.local()[i] = acceleration;
}

/// Error of the displacement of unknown @p i over a step of size @p dt [length]:
///
///   x_{n+1} - x_n - dt (v_n + v_{n+1}) / 2 + dt^2 (a_{n+1} - a_n) / 12,
///
/// the deviation from what Hermite's rule of fourth order makes of the velocities at both ends. For the second-order
/// members of the generalized-alpha family it is dt^2 (beta - gamma/2 + 1/12) (a_{n+1} - a_n), to leading order the
/// true local error, which for Newmark's trapezoidal rule is that of Zienkiewicz and Xie; the same holds for Bathe's
/// scheme, central differences and backward Euler. Source: theory F.3.
inline double displacement_error(const Motion &start, const Motion &end, double dt, std::size_t i)
{
  const auto x = [i](const Vector &v) { return v.local()[i]; };
  return x(end.position) - x(start.position) - .5 * dt * (x(start.velocity) + x(end.velocity)) +
         dt * dt / 12. * (x(end.acceleration) - x(start.acceleration));
}

/// (1 - alpha) y_n + alpha y_new.
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
