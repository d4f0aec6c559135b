#include <sherd/base/collective.h>

#include <stdexcept>

namespace sherd
{

Failure describe(const std::exception_ptr &error)
{
  if (!error)
    return {};
  try
    {
      std::rethrow_exception(error);
    }
  catch (const InvalidParameter &e)
    {
      return {ErrorKind::invalid_parameter, e.what()};
    }
  catch (const FileError &e)
    {
      return {ErrorKind::file_error, e.what()};
    }
  catch (const DimensionMismatch &e)
    {
      return {ErrorKind::dimension_mismatch, e.what()};
    }
  catch (const NoConvergence &e)
    {
      return {ErrorKind::no_convergence, e.what()};
    }
  catch (const StoppedEarly &e)
    {
      return {ErrorKind::stopped_early, e.what()};
    }
  catch (const Error &e)
    {
      return {ErrorKind::error, e.what()};
    }
  catch (const std::exception &e)
    {
      return {ErrorKind::unexpected, e.what()};
    }
  catch (...)
    {
      return {ErrorKind::unexpected, "an exception of unknown type"};
    }
}

void rethrow(const Failure &failure)
{
  switch (failure.kind)
    {
    case ErrorKind::none:
      return;
    case ErrorKind::unexpected:
      throw std::runtime_error(failure.message);
    case ErrorKind::error:
      throw Error(failure.message);
    case ErrorKind::invalid_parameter:
      throw InvalidParameter(failure.message);
    case ErrorKind::file_error:
      throw FileError(failure.message);
    case ErrorKind::dimension_mismatch:
      throw DimensionMismatch(failure.message);
    case ErrorKind::no_convergence:
      throw NoConvergence(failure.message);
    case ErrorKind::stopped_early:
      throw StoppedEarly(failure.message);
    }
}

Failure agree(MPI_Comm comm, const Failure &local)
{
  int rank, n_ranks;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &n_ranks);

  const int candidate = local.kind == ErrorKind::none ? n_ranks : rank;
  int       first     = n_ranks;
  MPI_Allreduce(&candidate, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == n_ranks)
    return {};

  int kind = static_cast<int>(local.kind);
  MPI_Bcast(&kind, 1, MPI_INT, first, comm);
  return {static_cast<ErrorKind>(kind), broadcast(comm, local.message, first)};
}

std::string broadcast(MPI_Comm comm, const std::string &text, int root)
{
  int rank;
  MPI_Comm_rank(comm, &rank);

  unsigned long size = text.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, root, comm);
  std::string result = rank == root ? text : std::string(size, '\0');
  MPI_Bcast(result.data(), static_cast<int>(size), MPI_CHAR, root, comm);
  return result;
}

void on_root(MPI_Comm comm, const std::function<void()> &task)
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  collectively(comm, [&] {
    if (rank == 0)
      task();
  });
}

} // namespace sherd
