#include <sherd/base/timers.h>

#include <sherd/base/collective.h>

namespace sherd
{

PhaseTimers::Scope::Scope(PhaseTimers &timers, const std::string &phase) : timers_(timers), outer_(timers.running_)
{
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

std::map<std::string, double> PhaseTimers::maximum(MPI_Comm comm) const
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  std::string names;
  for (const auto &[phase, seconds] : seconds_)
    names += phase + '\n';

  std::map<std::string, double> result;
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      const auto from_rank = broadcast(comm, names, rank);
      for (std::size_t begin = 0; begin < from_rank.size();)
        {
          const auto end   = from_rank.find('\n', begin);
          const auto phase = from_rank.substr(begin, end - begin);
          const auto mine  = seconds_.find(phase);
          result[phase]    = mine == seconds_.end() ? 0. : mine->second;
          begin            = end + 1;
        }
    }
  for (auto &[phase, seconds] : result)
    MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, comm);
  return result;
}

} // namespace sherd
