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
};

} // namespace sherd
