#pragma once

#include <sherd/algebra/linear_solver.h>

namespace sherd
{

/// When Newton's iteration is done and when it is given up (theory F.2, F.4).
///
/// The tolerances decide the number of iterations and so, through paper Eq. (13), the step size.
struct NewtonSettings
{
  /// |r_u| relative to the largest of the norms of load, reaction and inertia.
  double displacement_tolerance = 1e-6;
  /// max |r_phi,A| / int Gc/(2 l0) N_A dA.
  double phase_tolerance = 1e-5;
  int    max_iterations  = 12;
  /// Growth of the residual after the third iteration at which the step is given up.
  double divergence = 1e3;
  /// Iterations of a branch switch (theory C.2 2).
  int max_switch_iterations = 40;

  LinearSolverSettings linear;

  void declare(ParameterSection &section)
  {
    section.value("displacement_tolerance", displacement_tolerance, "-", range::open(0., 1.),
                  "residual of momentum over the largest of load, reaction and inertia");
    section.value("phase_tolerance", phase_tolerance, "-", range::open(0., 1.),
                  "residual of the phase over Gc/(2 l0) times the area of its control point");
    section.value("max_iterations", max_iterations, range::at_least(1), "Newton iterations before a step is rejected");
    section.value("divergence", divergence, "-", range::positive(),
                  "growth of the residual at which a step is rejected");
    section.value("max_switch_iterations", max_switch_iterations, range::at_least(1),
                  "iterations of a switch to the stable branch of the phase equation");
    section.subsection("linear", linear, "linear solver");
  }
};

} // namespace sherd
