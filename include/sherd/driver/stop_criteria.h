#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <sherd/driver/run_parameters.h>
#include <sherd/output/recorder_memory.h>
#include <sherd/space/shell_space.h>
#include <sherd/state/state.h>

namespace sherd
{

/// Smallest control value of the phase on a named edge. Collective.
/// @throws InvalidParameter   an edge that does not exist
template <int degree, int spacedim>
double smallest_phase_on(const std::string &edge, const ShellSpace<degree, spacedim> &space,
                         const State<degree, spacedim> &state)
{
  double      smallest = std::numeric_limits<double>::infinity();
  const auto &d        = space.distribution();
  for (const auto &side : space.surface().edge(edge))
    for (const int point : points_along(space.surface(), side))
      if (const int a = d.local[point]; a >= 0)
        smallest = std::min(smallest, state.phase.local()[a]);
  MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, space.environment().comm());
  return smallest;
}

/// What the rows of a run say: why it should end, nothing if it goes on. For rank 0, which knows the cracks.
std::optional<std::string> reason_to_stop(const StopParameters &stop, const RecorderMemory &memory);

/// Why a run should end after the present step, the same text on all ranks. Collective.
/// @param memory   of the recorder; the cracks on rank 0 only
template <int degree, int spacedim>
std::optional<std::string> reason_to_stop(const StopParameters &stop, const ShellSpace<degree, spacedim> &space,
                                          const State<degree, spacedim> &state, const RecorderMemory &memory)
{
  for (const auto &edge : stop.crack_at)
    if (smallest_phase_on(edge, space, state) < stop.threshold)
      return "a crack reached edge " + edge;
  const auto text = broadcast(space.environment().comm(), reason_to_stop(stop, memory).value_or(""));
  return text.empty() ? std::nullopt : std::optional(text);
}

} // namespace sherd
