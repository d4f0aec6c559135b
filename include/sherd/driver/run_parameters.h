#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sherd/base/parameter_section.h>
#include <sherd/time/any_integrator.h>
#include <sherd/time/central_difference.h>
#include <sherd/time/step_controller.h>

namespace sherd
{

/// Time integrator by name, step sizes, end.
struct TimeParameters
{
  std::string           integrator = "generalized_alpha";
  std::optional<double> rho_inf, alpha, beta, gamma, damping;
  double                end = NAN;
  std::optional<double> largest_step;
  StepControlSettings   steps;

  void declare(ParameterSection &section);

  /// @pre not central_difference
  /// @throws InvalidParameter   from the integrator; parameters that it does not have
  AnyIntegrator make_integrator() const;

  /// @pre central_difference
  /// @throws InvalidParameter   from the integrator; parameters that it does not have
  CentralDifference make_explicit() const;
};

/// What ends a run before its end time.
struct StopParameters
{
  std::vector<std::string> crack_at;
  double                   threshold = .1;
  std::optional<double>    crack_length, elastic_share;
  int                      steps = 0;

  void declare(ParameterSection &section);

  bool any() const { return !crack_at.empty() || crack_length || elastic_share || steps > 0; }
};

/// A point of the surface whose displacement and phase are written to probes.csv.
struct ProbeParameters
{
  std::string         name;
  std::vector<double> at;

  void declare(ParameterSection &section)
  {
    section.value("name", name, "names its columns in probes.csv");
    section.value("at", at, "length", range::any(), "its place on the reference surface, [x, y] or [x, y, z]");
  }
};

/// What is written, and how often.
struct OutputParameters
{
  int                          frames = 40;
  std::vector<ProbeParameters> points;
  std::vector<std::string>     reactions;

  void declare(ParameterSection &section)
  {
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
    section.list("points", points, "points of which probes.csv has displacement and phase");
    section.value("reactions", reactions, "edges of which probes.csv has the reactions");
  }
};

} // namespace sherd
