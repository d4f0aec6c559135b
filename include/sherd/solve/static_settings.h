#pragma once

#include <sherd/algebra/linear_solver.h>
#include <sherd/solve/line_search.h>

namespace sherd
{

/// When a static equilibrium is found and when it is given up.
struct StaticSettings
{
  double               tolerance      = 1e-8; ///< |r| relative to the larger of the norms of load and reaction
  int                  max_iterations = 30;
  double               divergence     = 1e6; ///< growth of the residual after the third iteration that gives up
  LineSearchSettings   line_search{.max_trials = 0};
  LinearSolverSettings linear{.preconditioner = Preconditioner::mumps, .tolerance = 1e-6};

  void declare(ParameterSection &section)
  {
    declare_equilibrium(section);
    section.value("max_iterations", max_iterations, range::at_least(1), "Newton iterations of a load step");
    section.value("divergence", divergence, "-", range::positive(), "growth of the residual that ends a load step");
    section.subsection("line_search", line_search, "length of Newton's steps");
  }

  /// What the arc length asks of its points: its corrector has iterations of its own.
  void declare_equilibrium(ParameterSection &section)
  {
    section.value("tolerance", tolerance, "-", range::open(0., 1.), "residual over the larger of load and reaction");
    section.subsection("linear", linear, "linear solver");
  }
};

/// Steps along an equilibrium path.
struct ArcLengthSettings
{
  double first_factor      = .05;  ///< load factor that sets the length of the first step
  int    wanted_iterations = 6;    ///< steps grow while the corrector takes fewer iterations, and shrink beyond
  double largest           = 4.;   ///< longest step, relative to the first
  double smallest          = 1e-4; ///< a failed step shorter than this, relative to the first, ends the run
  int    max_iterations    = 15;   ///< of the corrector

  void declare(ParameterSection &section)
  {
    section.value("first_factor", first_factor, "-", range::positive(), "load factor that sets the first step");
    section.value("wanted_iterations", wanted_iterations, range::at_least(1),
                  "steps grow while the corrector takes fewer iterations, and shrink beyond");
    section.value("largest", largest, "-", range::positive(), "longest step, relative to the first");
    section.value("smallest", smallest, "-", range::positive(), "shortest step, relative to the first");
    section.value("max_iterations", max_iterations, range::at_least(1), "iterations of the corrector");
  }
};

} // namespace sherd
