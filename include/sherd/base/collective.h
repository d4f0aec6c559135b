#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <mpi.h>

#include <sherd/base/exceptions.h>

/// Failures of one rank that all ranks share, so that they leave together.
namespace sherd
{

/// Which error it is, in a form that can be sent.
enum class ErrorKind
{
  none,
  unexpected, ///< any other std::exception; thrown on other ranks as std::runtime_error
  error,      ///< Error itself
  invalid_parameter,
  file_error,
  dimension_mismatch,
  no_convergence,
  stopped_early
};

/// An error as data.
struct Failure
{
  ErrorKind   kind = ErrorKind::none;
  std::string message;
};

/// Describes @p error; kind none for a null pointer.
Failure describe(const std::exception_ptr &error);

/// Throws the error that @p failure describes; does nothing for kind none.
void rethrow(const Failure &failure);

/// Agrees on the failure of the lowest rank that has one. Collective over @p comm.
Failure agree(MPI_Comm comm, const Failure &local);

/// The text of rank @p root on every rank. Collective over @p comm.
std::string broadcast(MPI_Comm comm, const std::string &text, int root = 0);

/// Runs @p task on every rank and returns its result. If it throws on any rank, then all ranks throw the error of the
/// lowest rank that failed: the same type and message. Collective over @p comm; @p task itself must not communicate
/// over ranks after the first point where it can fail.
template <class Task>
auto collectively(MPI_Comm comm, Task &&task)
{
  using Result = decltype(task());

  const auto attempt = [comm](const auto &action) {
    std::exception_ptr error;
    try
      {
        action();
      }
    catch (...)
      {
        error = std::current_exception();
      }
    rethrow(agree(comm, describe(error)));
  };

  if constexpr (std::is_void_v<Result>)
    attempt(task);
  else
    {
      std::optional<Result> result;
      attempt([&] { result.emplace(task()); });
      return std::move(*result);
    }
}

/// Runs @p task on rank 0 only; if it throws there, all ranks throw the same error. Collective over @p comm.
void on_root(MPI_Comm comm, const std::function<void()> &task);

} // namespace sherd
