#include <sherd/base/timers.h>

#include <sherd/base/collective.h>

namespace sherd
{

PhaseTimers::Scope::Scope(PhaseTimers &timers, const std::string &phase) : timers_(timers), outer_(timers.running_)
{
  ++timers_.calls_[phase];
  timers_.switch_to(&timers_.seconds_[phase]);
}

PhaseTimers::Scope::~Scope()
{
  timers_.switch_to(outer_);
}

void PhaseTimers::switch_to(double *phase)
{
  const auto now = Clock::now();
  if (running_)
    *running_ += std::chrono::duration<double>(now - since_).count();
  running_ = phase;
  since_   = now;
}

std::map<std::string, PhaseStatistics> PhaseTimers::statistics(MPI_Comm comm) const
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  std::string names;
  for (const auto &[phase, seconds] : seconds_)
    names += phase + '\n';

  std::map<std::string, PhaseStatistics> result;
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      const auto from_rank = broadcast(comm, names, rank);
      for (std::size_t begin = 0; begin < from_rank.size();)
        {
          const auto end        = from_rank.find('\n', begin);
          const auto phase      = from_rank.substr(begin, end - begin);
          const auto mine       = seconds_.find(phase);
          const auto calls      = calls_.find(phase);
          result[phase].largest = mine == seconds_.end() ? 0. : mine->second;
          result[phase].calls   = calls == calls_.end() ? 0 : calls->second;
          begin                 = end + 1;
        }
    }
  for (auto &[phase, of_phase] : result)
    {
      of_phase.mean = of_phase.largest / n_ranks;
      MPI_Allreduce(MPI_IN_PLACE, &of_phase.mean, 1, MPI_DOUBLE, MPI_SUM, comm);
      MPI_Allreduce(MPI_IN_PLACE, &of_phase.largest, 1, MPI_DOUBLE, MPI_MAX, comm);
      MPI_Allreduce(MPI_IN_PLACE, &of_phase.calls, 1, MPI_INT64_T, MPI_MAX, comm);
    }
  return result;
}

std::map<std::string, double> PhaseTimers::maximum(MPI_Comm comm) const
{
  std::map<std::string, double> result;
  for (const auto &[phase, of_phase] : statistics(comm))
    result[phase] = of_phase.largest;
  return result;
}

} // namespace sherd
