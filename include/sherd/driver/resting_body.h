#pragma once

#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/print.h>
#include <sherd/base/stop_request.h>
#include <sherd/driver/case_model.h>
#include <sherd/output/frames.h>
#include <sherd/output/probes.templates.h>
#include <sherd/solve/arc_length.h>
#include <sherd/solve/modal_analysis.h>

namespace sherd
{

/// What a case is about when nothing cracks and nothing moves fast: a body with its cracks, as it is before the first
/// step, and what holds and loads it. All of it has to outlive the object.
template <int degree, int spacedim>
struct RestingBody
{
  const Environment                  &env;
  const CaseModel<degree, spacedim>  &model;
  const Surface<degree, spacedim>    &surface;
  const ShellSpace<degree, spacedim> &space;
  const Supports                     &supports;
  const Loads<spacedim>              &loads;
  const State<degree, spacedim>      &state;
};

/// Follows the path of equilibria of @p body through limit points of load and displacement until the load factor, the
/// time of its loads and supports, first passes @p end, or for @p most_steps steps if that is not 0. The phase stays as
/// it is. Writes
///
///   path.csv     a row a step: step, load_factor, iterations of the corrector
///   probes.csv   points and edges, a row a step; its time is the load factor, which may fall
///   frames       one a step; their time is the number of the step, since a load factor may come twice
///
/// Collective.
/// @throws InvalidParameter   loads or supports that are not affine in time
/// @throws NoConvergence      when the shortest step fails
/// @throws StoppedEarly       when the run was asked to stop
template <int degree, int spacedim>
void follow_path(const RestingBody<degree, spacedim> &body, const OutputDirectory &directory,
                 const StaticSettings &statics, const ArcLengthSettings &arc_length, double end, int most_steps,
                 const std::vector<PointProbe<spacedim>> &points, const std::vector<std::string> &edges)
{
  struct Files
  {
    CsvTable         path;
    Probes<spacedim> probes;
    FrameWriter      frames;
  };
  const auto                                comm = body.env.comm();
  StaticSolver<CaseModel<degree, spacedim>> solver(body.model, body.space, body.supports, body.loads, statics);
  solver.rebuild(body.state);
  solver.residual(body.state);

  std::optional<Files> files;
  on_root(comm, [&] {
    files.emplace(Files{CsvTable(directory.file("path.csv"), {"step", "load_factor", "iterations"}),
                        Probes<spacedim>(directory.path(), body.surface, points, edges),
                        FrameWriter(directory.path())});
  });
  const auto write = [&](const State<degree, spacedim> &state, int iterations) {
    auto                         at = snapshot(state);
    std::vector<Point<spacedim>> reactions;
    for (const auto &edge : edges)
      reactions.push_back(solver.reaction(edge));
    on_root(comm, [&] {
      files->path.append(CsvRow() << state.step << at.time << iterations);
      files->probes.append(body.surface, at, reactions);
      at.time = state.step;
      files->frames.write(body.surface, at);
      std::cout << "step " << state.step << ": load factor " << print(state.time) << ", " << iterations
                << (iterations == 1 ? " iteration" : " iterations") << std::endl;
    });
    if (const auto reason = stop_requested(body.env))
      throw StoppedEarly("stopped at load factor " + print(state.time) + ": " + *reason);
  };

  ArcLength<CaseModel<degree, spacedim>> path(solver, body.state, arc_length);
  write(path.state(), 0);
  while (path.state().time < end && (most_steps == 0 || path.state().step < most_steps))
    {
      const int iterations = path.advance();
      write(path.state(), iterations);
    }
}

/// Lowest free vibrations of @p body about its state at rest. Writes
///
///   modes.csv   a row a mode: mode, omega [1/time], frequency = omega / 2 pi; negative: see VibrationMode
///   frames      one a mode, whose number is its time: the shape, with a displacement of a tenth of the body at most
///
/// Collective.
/// @throws as vibration_modes
template <int degree, int spacedim>
void write_modes(const RestingBody<degree, spacedim> &body, const OutputDirectory &directory,
                 const EigenSettings &settings)
{
  const auto modes = vibration_modes(body.model, body.space, body.supports, body.state, settings);
  const auto rest  = snapshot(body.state);
  struct Files
  {
    CsvTable    modes;
    FrameWriter frames;
  };
  std::optional<Files> files;
  on_root(body.env.comm(), [&] {
    files.emplace(
        Files{CsvTable(directory.file("modes.csv"), {"mode", "omega", "frequency"}), FrameWriter(directory.path())});
  });
  for (std::size_t m = 0; m < modes.size(); ++m)
    {
      const auto values = gather(modes[m].shape);
      on_root(body.env.comm(), [&] {
        const int    number = static_cast<int>(m) + 1;
        const double omega  = modes[m].omega;
        files->modes.append(CsvRow() << number << omega << omega / (2. * M_PI));
        const Eigen::Map<const ControlValues<spacedim>> shape(values.data(), values.size() / spacedim, spacedim);
        const double size = (rest.position.colwise().maxCoeff() - rest.position.colwise().minCoeff()).norm();
        auto         at   = rest;
        at.time           = number;
        at.position += .1 * size / shape.rowwise().norm().maxCoeff() * shape;
        files->frames.write(body.surface, at);
        std::cout << "mode " << number << ": omega " << print(omega) << std::endl;
      });
    }
}

} // namespace sherd
