#pragma once

#include <sherd/driver/case_model.h>
#include <sherd/assembly/half_kernels.h>
#include <sherd/solve/explicit_solver.h>
#include <sherd/solve/monolithic_solver.h>
#include <sherd/solve/staggered_solver.h>
#include <sherd/time/any_integrator.h>

/// What is compiled for each degree and dimension of the program sherd, in units of its own (src/driver/kernels).
#define SHERD_CASE_ASSEMBLER(prefix, degree, spacedim) prefix template class Assembler<CaseModel<degree, spacedim>>;
#define SHERD_CASE_HALVES(prefix, degree, spacedim) SHERD_HALF_KERNELS(prefix, CaseModel<degree, spacedim>)
#define SHERD_CASE_SOLVERS(prefix, degree, spacedim)                                                                   \
  prefix template class StepEquations<CaseModel<degree, spacedim>>;                                                    \
  prefix template class NewtonIteration<CaseModel<degree, spacedim>>;                                                  \
  prefix template class NewtonIteration<CaseModel<degree, spacedim>, Unknowns::displacement>;                          \
  prefix template class NewtonIteration<CaseModel<degree, spacedim>, Unknowns::phase>;                                 \
  prefix template class MonolithicSolver<CaseModel<degree, spacedim>, AnyIntegrator>;                                  \
  prefix template class StaggeredSolver<CaseModel<degree, spacedim>, AnyIntegrator>;                                   \
  prefix template class ExplicitSolver<CaseModel<degree, spacedim>>;
