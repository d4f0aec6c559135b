#include <sherd/base/stop_request.h>

#include <array>
#include <csignal>

#include <signal.h>

#include <sherd/base/print.h>

namespace sherd
{
namespace
{

constexpr std::array watched{SIGTERM, SIGINT, SIGUSR1};
constexpr int        wall_limit = 1 << 16;

// A signal handler can reach nothing but an object of static storage duration.
volatile std::sig_atomic_t                   received = 0;
std::array<struct sigaction, watched.size()> earlier;

void remember(int signal)
{
  received = signal;
}

std::string reason(int code, const Environment &env)
{
  if (code >= wall_limit)
    return "the limit of " + print(*env.command_line().max_wall_minutes) + " minutes (--max-wall)";
  return std::string("signal ") + (code == SIGTERM ? "SIGTERM" : code == SIGINT ? "SIGINT" : "SIGUSR1");
}

} // namespace

StopSignals::StopSignals()
{
  received                = 0;
  struct sigaction action = {};
  action.sa_handler       = remember;
  // Resethand: an impatient second signal acts as usual. Restart: reading and writing files is not disturbed.
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < watched.size(); ++i)
    sigaction(watched[i], &action, &earlier[i]);
}

StopSignals::~StopSignals()
{
  for (std::size_t i = 0; i < watched.size(); ++i)
    sigaction(watched[i], &earlier[i], nullptr);
  received = 0;
}

int received_stop_signal()
{
  return received;
}

std::optional<std::string> stop_requested(const Environment &env)
{
  int        local = received;
  const auto limit = env.command_line().max_wall_minutes;
  if (local == 0 && env.rank() == 0 && limit && env.elapsed_seconds() >= 60. * *limit)
    local = wall_limit;

  int code = 0;
  MPI_Allreduce(&local, &code, 1, MPI_INT, MPI_MAX, env.comm());
  if (code == 0)
    return std::nullopt;
  return reason(code, env);
}

} // namespace sherd
