#pragma once

#include <sherd/algebra/linear_solver.h>
#include <sherd/solve/line_search.h>

namespace sherd
{

/// Which tangent Newton's method takes.
enum class TangentRule
{
  full,           ///< that of the present iterate, or one that will do as well (theory F.2)
  lagged_history, ///< without the derivative of the history by the displacement
  modified        ///< an earlier one as long as each solve with it halves the residual at least
};

/// How far Newton goes along its direction.
enum class Globalisation
{
  none,       ///< all the way
  line_search ///< to where the slope of the energy has fallen enough
};

/// How the phase of a staggered solver follows.
enum class Relaxation
{
  none,
  aitken
};

/// Alternate solves for displacement and phase (StaggeredSolver).
struct AlternationSettings
{
  int        max_alternations = 200; ///< before a step is given up
  Relaxation relaxation       = Relaxation::aitken;

  void declare(ParameterSection &section)
  {
    section.value("max_alternations", max_alternations, range::at_least(1),
                  "solves of displacement and phase before a step is rejected");
    section.choice("relaxation", relaxation, {{"none", Relaxation::none}, {"aitken", Relaxation::aitken}},
                   "how the phase follows from one alternation to the next");
  }
};

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

  TangentRule         tangent       = TangentRule::full;
  Globalisation       globalisation = Globalisation::none;
  LineSearchSettings  line_search;
  AlternationSettings alternation;

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
    section.choice("tangent", tangent,
                   {{"full", TangentRule::full},
                    {"lagged_history", TangentRule::lagged_history},
                    {"modified", TangentRule::modified}},
                   "tangent: full, without the derivative of the history, or kept while it halves the residual");
    section.choice("globalisation", globalisation,
                   {{"none", Globalisation::none}, {"line_search", Globalisation::line_search}},
                   "how far Newton goes along its direction");
    section.subsection("line_search", line_search, "length of Newton's steps, for globalisation: line_search");
    section.subsection("alternation", alternation, "alternate solves of a staggered solver");
    section.subsection("linear", linear, "linear solver");
  }
};

} // namespace sherd
