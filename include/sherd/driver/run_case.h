#pragma once

#include <vector>

#include <sherd/driver/case.h>

namespace sherd
{

/// Runs a case from its pre-cracks, or from the checkpoint of --restart, to its end; with --check it builds everything
/// and stops. Collective.
/// @pre prm resolved (Case::resolve), of this degree and dimension
/// @throws InvalidParameter, FileError   bad input
/// @throws NoConvergence, StoppedEarly   see RecordedRun
template <int degree, int spacedim>
void run_case(const Environment &env, const Case &prm);

/// One degree and dimension that the program was built for.
struct CaseKernel
{
  int degree, spacedim;
  void (*run)(const Environment &, const Case &);
};

/// All of them; src/cmake/SherdDriver.cmake says which.
const std::vector<CaseKernel> &case_kernels();

/// The main program: resolves @p prm and runs it with the kernel of its degree and dimension.
/// @throws InvalidParameter   also where there is no such kernel
void run_case(const Environment &env, Case prm);

} // namespace sherd
