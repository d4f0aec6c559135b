#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <mpi.h>

#include <sherd/time/update.h>

namespace sherd::test
{

/// Steps of one unit mass x'' + 2 damping x' + omega^2 x = gravity + cos(forcing t), taken by the formulas of the
/// library on a vector of one entry.
struct Oscillator
{
  double omega2 = 4., damping = 0., forcing = 0., gravity = 0.;

  double force(double x, double v, double t) const
  {
    return gravity - omega2 * x - 2. * damping * v + (forcing > 0. ? std::cos(forcing * t) : 0.);
  }

  /// State (x, v, a) at the end of the steps @p sizes from x0, v0 at t = 0.
  template <class Integrator>
  Motion run(const Integrator &integrator, const std::vector<double> &sizes, double x0, double v0) const
  {
    const auto d =
        std::make_shared<const Distribution>(MPI_COMM_SELF, std::vector<std::int64_t>{0}, std::vector<std::int64_t>{});
    Motion motion{Vector(d, 1), Vector(d, 1), Vector(d, 1)};
    motion.position.local()[0]     = x0;
    motion.velocity.local()[0]     = v0;
    motion.acceleration.local()[0] = force(x0, v0, 0.);
    double time = 0., previous = sizes.front();
    for (const double dt : sizes)
      {
        motion = step(integrator.stages(dt, previous), motion, time);
        time += dt;
        previous = dt;
      }
    return motion;
  }

  /// One step. The balance of each stage is linear in x_new, so that two evaluations of its residual give the solution.
  Motion step(const Stages &stages, const Motion &start, double time) const
  {
    Motion before = start;
    for (const Stage &stage : stages)
      {
        Motion next = predict(stage, start, before);
        if (stage.beta == 0.)
          accelerate(stage, next, 0, force(next.position.local()[0], 0., time + stage.dt));
        else
          solve(stage, start, next, time);
        before = next;
      }
    return before;
  }

private:
  void solve(const Stage &stage, const Motion &start, Motion &next, double time) const
  {
    const auto residual = [&](double dx) {
      move(stage, next, 0, dx);
      const auto level = [&](double alpha, const Vector &a, const Vector &b) {
        return interpolate(alpha, a, b).local()[0];
      };
      return level(stage.alpha_m, start.acceleration, next.acceleration) -
             force(level(stage.alpha_f, start.position, next.position),
                   level(stage.alpha_f, start.velocity, next.velocity), time + stage.alpha_f * stage.dt);
    };
    const double dx    = stage.dt * stage.dt;
    const double r0    = residual(0.);
    const double slope = (residual(dx) - r0) / dx;
    residual(-dx - r0 / slope);
  }
};

} // namespace sherd::test
