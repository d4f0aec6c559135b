#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include <mpi.h>

/// Wall time by phase of the program.
namespace sherd
{

/// A phase over the ranks.
struct PhaseStatistics
{
  double       largest = 0.; ///< wall seconds of the rank that spent most
  double       mean    = 0.; ///< over all ranks
  std::int64_t calls   = 0;  ///< how often it began, of the rank that began it most often
};

/// Accumulates wall seconds under names ("assembly", "solve"). Phases exclude each other: while an inner phase is
/// measured, the clock of the outer one stands still, so the seconds of all phases add up to the time spent in any.
/// For one thread.
/// @code
/// const auto timing = timers.measure("assembly");   // until the end of the block
/// @endcode
class PhaseTimers
{
public:
  /// Measures a phase while it lives. Scopes of one PhaseTimers end in the reverse order of their beginning, as those
  /// of nested blocks do.
  class [[nodiscard]] Scope
  {
  public:
    Scope(PhaseTimers &timers, const std::string &phase);
    ~Scope();

    Scope(const Scope &)            = delete;
    Scope &operator=(const Scope &) = delete;

  private:
    PhaseTimers &timers_;
    double      *outer_;
  };

  PhaseTimers() = default;

  PhaseTimers(const PhaseTimers &)            = delete;
  PhaseTimers &operator=(const PhaseTimers &) = delete;

  Scope measure(const std::string &phase) { return {*this, phase}; }

  /// Books @p seconds of the phase @p from, which has been measured, on the phase @p to: for work that reports itself
  /// how its time divides.
  void reassign(const std::string &from, const std::string &to, double seconds)
  {
    seconds_[from] -= seconds;
    seconds_[to] += seconds;
  }

  /// Seconds of every phase that has ended or was interrupted by an inner one, on this rank.
  const std::map<std::string, double> &seconds() const { return seconds_; }

  /// Every phase met on any rank. Collective over @p comm, all ranks return the same.
  std::map<std::string, PhaseStatistics> statistics(MPI_Comm comm) const;

  /// For every phase met on any rank, the largest seconds of a rank. Collective over @p comm, all ranks return the
  /// same.
  std::map<std::string, double> maximum(MPI_Comm comm) const;

private:
  using Clock = std::chrono::steady_clock;

  /// Books the time since the last switch on the running phase and goes on with @p phase (null: none).
  void switch_to(double *phase);

  std::map<std::string, double>       seconds_;
  std::map<std::string, std::int64_t> calls_;
  double                             *running_ = nullptr;
  Clock::time_point                   since_   = Clock::now();
};

} // namespace sherd
