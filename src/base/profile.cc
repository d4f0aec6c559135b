#include <sherd/base/profile.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include <omp.h>
#include <sys/resource.h>

namespace sherd
{
namespace
{

std::string line(const char *format, auto... values)
{
  char text[160];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

constexpr double megabyte = 1e6;

} // namespace

PeakMemory peak_memory(MPI_Comm comm)
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const std::int64_t mine = 1024 * static_cast<std::int64_t>(usage.ru_maxrss); // given in KiB
  PeakMemory         peak;
  MPI_Allreduce(&mine, &peak.sum, 1, MPI_INT64_T, MPI_SUM, comm);
  MPI_Allreduce(&mine, &peak.largest, 1, MPI_INT64_T, MPI_MAX, comm);
  return peak;
}

Profile make_profile(MPI_Comm comm, const PhaseTimers &timers, double total_seconds, int n_unknowns)
{
  Profile profile;
  profile.phases     = timers.statistics(comm);
  profile.n_threads  = omp_get_max_threads();
  profile.memory     = peak_memory(comm);
  profile.n_unknowns = n_unknowns;
  MPI_Comm_size(comm, &profile.n_ranks);

  double other = total_seconds;
  for (const auto &[phase, seconds] : timers.seconds())
    other -= seconds;
  MPI_Allreduce(&other, &profile.other.mean, 1, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(&other, &profile.other.largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(&total_seconds, &profile.total_seconds, 1, MPI_DOUBLE, MPI_MAX, comm);
  profile.other.mean /= profile.n_ranks;
  return profile;
}

std::string table(const Profile &profile)
{
  std::vector<std::pair<std::string, PhaseStatistics>> rows(profile.phases.begin(), profile.phases.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto &a, const auto &b) { return a.second.mean > b.second.mean; });
  rows.emplace_back("other", profile.other);

  auto result = line("%-16s %12s %12s %8s %9s\n", "phase", "largest [s]", "mean [s]", "share", "calls");
  for (const auto &[name, phase] : rows)
    {
      const double share = profile.total_seconds > 0. ? 100. * phase.mean / profile.total_seconds : 0.;
      result += line("%-16s %12.3f %12.3f %6.1f %%", name.c_str(), phase.largest, phase.mean, share);
      result += phase.calls > 0 ? line(" %9lld\n", static_cast<long long>(phase.calls)) : "\n";
    }
  result += line("%-16s %12.3f, ranks: %d, threads of a rank: %d\n", "total", profile.total_seconds, profile.n_ranks,
                 profile.n_threads);
  result += line("peak memory of a rank: largest %.1f MB, mean %.1f MB; %.0f bytes per unknown (%d unknowns)\n",
                 profile.memory.largest / megabyte, profile.memory.sum / megabyte / profile.n_ranks,
                 profile.bytes_per_unknown(), profile.n_unknowns);
  return result;
}

} // namespace sherd
