#pragma once

#include <sherd/driver/case_model.h>
#include <sherd/solve/monolithic_solver.h>
#include <sherd/time/any_integrator.h>

/// The plate of case files, compiled in the library: a program that takes its policies by name and has a loop of its own
/// compiles in seconds.
namespace sherd
{

extern template class Assembler<CaseModel<2, 2>>;
extern template class MonolithicSolver<CaseModel<2, 2>, AnyIntegrator>;

} // namespace sherd
