#pragma once

#include <cstdint>
#include <map>
#include <string>

#include <mpi.h>

#include <sherd/base/timers.h>

/// Where time and memory of a run went.
namespace sherd
{

/// Largest resident memory that the ranks have ever had, as the operating system counts it [bytes].
struct PeakMemory
{
  std::int64_t sum     = 0; ///< over the ranks
  std::int64_t largest = 0; ///< of a rank
};

/// Collective over @p comm, all ranks return the same.
PeakMemory peak_memory(MPI_Comm comm);

/// What --profile tells at the end of a run.
struct Profile
{
  std::map<std::string, PhaseStatistics> phases;
  PhaseStatistics                        other; ///< outside of all phases; calls: 0
  double                                 total_seconds = 0.;
  int                                    n_ranks = 1, n_threads = 1; ///< threads of a rank
  PeakMemory                             memory;
  int                                    n_unknowns = 0;

  /// Peak memory of all ranks together per unknown.
  double bytes_per_unknown() const { return n_unknowns > 0 ? static_cast<double>(memory.sum) / n_unknowns : 0.; }
};

/// Profile of a program that has run for @p total_seconds. Collective over @p comm, all ranks return the same.
/// @param n_unknowns   of the largest system solved
Profile make_profile(MPI_Comm comm, const PhaseTimers &timers, double total_seconds, int n_unknowns);

/// The profile as a table, phases by decreasing time: seconds of the rank that spent most, mean over the ranks, the
/// share of the mean in the total (shares add up to 100 %), calls; then memory. A phase whose largest value is well
/// above its mean is one in which other ranks wait, there or in the phase that follows.
std::string table(const Profile &profile);

} // namespace sherd
