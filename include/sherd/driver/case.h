#pragma once

#include <string>
#include <vector>

#include <sherd/adapt/marking.h>
#include <sherd/algebra/eigen_solver.h>
#include <sherd/driver/boundary_parameters.h>
#include <sherd/driver/fracture_parameters.h>
#include <sherd/driver/material_parameters.h>
#include <sherd/driver/run_parameters.h>
#include <sherd/driver/surface_parameters.h>
#include <sherd/output/checkpoint_writer.h>
#include <sherd/solve/newton_settings.h>
#include <sherd/solve/static_settings.h>

/// Case files of the program sherd (doc/case-files.md).
namespace sherd
{

/// How the equations of a step are solved.
enum class SolverChoice
{
  monolithic,
  staggered,
  explicit_,
  arc_length, ///< the path of equilibria of the body as it is; time is the load factor
  modes       ///< free vibrations of the body as it is
};

/// Equilibria of a path: what of StaticSettings the arc length uses.
struct EquilibriumParameters : StaticSettings
{
  void declare(ParameterSection &section) { declare_equilibrium(section); }
};

/// Everything a case file says.
struct Case
{
  SurfaceParameters               surface;
  MaterialParameters              material;
  FractureParameters              fracture;
  std::vector<RegionParameters>   regions;
  std::vector<CrackParameters>    cracks;
  std::vector<SupportParameters>  supports;
  std::vector<LoadParameters>     loads;
  TimeParameters                  time;
  SolverChoice                    solver = SolverChoice::monolithic;
  NewtonSettings                  newton;
  EquilibriumParameters           statics;
  ArcLengthSettings               arc_length;
  EigenSettings                   modes;
  RefinementSettings              refinement;
  std::vector<FineMeshParameters> fine_mesh;
  StopParameters                  stop;
  OutputParameters                output;
  CheckpointSettings              checkpoint;

  void declare(ParameterSection &section);

  /// Puts chosen names in the place of defaults and checks what no single parameter can be checked for.
  /// @throws InvalidParameter
  void resolve();

  /// @throws InvalidParameter   a setting of a choice that was not made
  void check_unused() const;
};

/// Sections that a restart may repeat but not change: body, mesh and model.
const std::vector<std::string> &model_sections();

} // namespace sherd
