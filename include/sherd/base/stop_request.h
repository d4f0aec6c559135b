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
/// Under mpirun, send SIGUSR1 to mpirun: it passes it on at once and returns the status of the ranks. Open MPI's mpirun
/// answers a SIGTERM or SIGINT of its own differently: the ranks get SIGTERM a second later, are killed after another
/// second (both waits: `--mca odls_base_sigkill_timeout SECONDS`), and mpirun returns 1 whatever they return.
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
