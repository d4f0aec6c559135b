#pragma once

#include <array>
#include <cmath>

#include <Eigen/Dense>

#include <sherd/output/csv_table.h>
#include <sherd/time/central_difference.h>

#include "schemes.h"

namespace sherd::integrators
{

/// (x, v, a) of one unit mass on a spring of stiffness omega^2.
using Motion1 = Eigen::Vector3d;

/// One step of x'' + omega^2 x = 0, as the formulas of Stage have it.
inline Motion1 step(const Stages &stages, double omega2, const Motion1 &start)
{
  Motion1 before = start;
  for (const Stage &stage : stages)
    {
      const auto  &s = stage.start, &b = stage.before;
      const double dt = stage.dt;
      const double X  = s.x_of_x * start[0] + b.x_of_x * before[0] + dt * (s.x_of_v * start[1] + b.x_of_v * before[1]) +
                       dt * dt * (s.x_of_a * start[2] + b.x_of_a * before[2]);
      const double V = s.v_of_v * start[1] + b.v_of_v * before[1] + dt * (s.v_of_a * start[2] + b.v_of_a * before[2]);
      const double a =
          -((1. - stage.alpha_m) * start[2] + omega2 * ((1. - stage.alpha_f) * start[0] + stage.alpha_f * X)) /
          (stage.alpha_m + omega2 * stage.alpha_f * stage.beta * dt * dt);
      before = {X + stage.beta * dt * dt * a, V + stage.gamma * dt * a, a};
    }
  return before;
}

/// Largest absolute eigenvalue of a step of size one, in units in which x, dt v and dt^2 a are alike.
inline double spectral_radius(const Stages &stages, double omega2)
{
  Eigen::Matrix3d A;
  for (int c = 0; c < 3; ++c)
    A.col(c) = step(stages, omega2, Motion1::Unit(c));
  return A.eigenvalues().cwiseAbs().maxCoeff();
}

/// Error of position and velocity at t = 2 with omega = 2, over @p n_cycles cycles of a pattern of step sizes.
template <class Integrator>
double oscillator_error(const Integrator &integrator, const std::vector<double> &pattern, int n_cycles)
{
  constexpr double omega2 = 4., end = 2., x0 = 1., v0 = -.5;
  double           sum = 0.;
  for (const double s : pattern)
    sum += s;
  Motion1 motion(x0, v0, -omega2 * x0);
  double  previous = end / (sum * n_cycles) * pattern.front();
  for (int c = 0; c < n_cycles; ++c)
    for (const double s : pattern)
      {
        const double dt = end / (sum * n_cycles) * s;
        motion          = step(integrator.stages(dt, previous), omega2, motion);
        previous        = dt;
      }
  const double w = 2. * end;
  return std::hypot(motion[0] - (x0 * std::cos(w) + v0 / 2. * std::sin(w)),
                    motion[1] - (v0 * std::cos(w) - 2. * x0 * std::sin(w)));
}

/// orders.csv and radii.csv: errors under constant and changing steps, spectral radii over omega dt.
inline void measure_oscillators(const std::filesystem::path &directory)
{
  struct Pattern
  {
    std::string         name;
    std::vector<double> sizes;
  };
  const std::vector<Pattern> patterns{
      {"constant", {1.}}, {"alternate", {1., 1.5, .5}}, {"sawtooth", {1., 1.5, 2.25, 3.375, 5.0625, 1.0125}}};
  CsvTable   orders(directory / "orders.csv", {"scheme", "pattern", "steps", "error", "order"});
  CsvTable   radii(directory / "radii.csv", {"scheme", "omega_dt", "radius"});
  const auto measure = [&](const std::string &name, const auto &integrator) {
    for (const auto &pattern : patterns)
      {
        double before = 0.;
        for (int n = 20; n <= 2560; n *= 2)
          {
            const int    n_cycles = std::max<int>(1, n / static_cast<int>(pattern.sizes.size()));
            const double error    = oscillator_error(integrator, pattern.sizes, n_cycles);
            orders.append(CsvRow() << name << pattern.name << n_cycles * static_cast<int>(pattern.sizes.size()) << error
                                   << (before > 0. ? std::log2(before / error) : std::nan("")));
            before = error;
          }
      }
    for (int k = -8; k <= 24; ++k)
      {
        const double omega_dt = std::pow(10., k / 4.);
        radii.append(CsvRow() << name << omega_dt << spectral_radius(integrator.stages(1., 1.), omega_dt * omega_dt));
      }
  };
  for (const auto &scheme : schemes())
    measure(scheme.name, scheme.integrator);
  measure("central_difference", CentralDifference());
}

} // namespace sherd::integrators
