#pragma once

#include <optional>
#include <string>

#include <sherd/base/environment.h>

/// Requests to end a run before its end time, from outside.
namespace sherd
{

/// While it lives, SIGTERM, SIGINT and SIGUSR1 ask the run to stop at the end of the step instead of killing it; the
/// earlier handlers come back on destruction. A second signal of the same kind acts as it would without this object.
/// One at a time; run() holds it.
///
/// SIGUSR1 is there because mpirun and batch systems pass it on and leave the run as much time as it needs, whereas
/// Open MPI's mpirun kills all ranks one second after a SIGTERM (longer with `--mca odls_base_sigkill_timeout 600`).
class StopSignals
{
public:
  StopSignals();
  ~StopSignals();

  StopSignals(const StopSignals &)            = delete;
  StopSignals &operator=(const StopSignals &) = delete;
};

/// Number of the signal that asked this rank to stop since StopSignals was made, 0 if none.
int received_stop_signal();

/// Why the run should stop, the same text on every rank ("signal SIGTERM", "the limit of 30 minutes (--max-wall)"), or
/// nothing if it should go on. A signal on one rank is enough; wall time is that of rank 0.
/// Collective over the ranks of @p env; meant for the end of every step:
/// `if (const auto reason = stop_requested(env)) { write checkpoint; throw StoppedEarly(...); }`
std::optional<std::string> stop_requested(const Environment &env);

} // namespace sherd
