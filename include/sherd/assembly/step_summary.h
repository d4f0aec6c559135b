#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sherd/assembly/external_work.h>
#include <sherd/forms/element_energies.h>

namespace sherd
{

/// What it took to get one accepted step.
struct StepSummary
{
  double                   dt       = 0.; ///< of the accepted step [time]
  int                      newton   = 0;  ///< iterations of the accepted attempt
  int                      linear   = 0;  ///< linear iterations of all attempts
  int                      attempts = 0;
  int                      rejected = 0;       ///< attempts that failed
  int                      repeated = 0;       ///< attempts discarded because the mesh was too coarse for them
  int                      switched = 0;       ///< branch switches
  int                      refined  = 0;       ///< refinements of the mesh
  double                   error    = 0.;      ///< of the step, estimated by the integrator; 0: no estimate
  StepWork                 work;               ///< over the step
  double                   withheld_work = 0.; ///< by the history over the step [energy]
  double                   largest_phase = 0.;
  std::optional<Energies>  before;   ///< at its beginning, if the mesh has changed since the step before
  Energies                 energies; ///< at the end of the step, before a refinement
  std::vector<std::string> messages; ///< rejections and escalations, one line each
};

} // namespace sherd
