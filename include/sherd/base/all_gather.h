#pragma once

#include <type_traits>
#include <vector>

#include <mpi.h>

namespace sherd
{

/// The values of all ranks on every rank, in the order of the ranks. Collective over @p comm.
template <class T>
std::vector<T> all_gather(MPI_Comm comm, const std::vector<T> &local)
{
  static_assert(std::is_trivially_copyable_v<T>);
  int n_ranks = 1;
  MPI_Comm_size(comm, &n_ranks);
  const int        count = static_cast<int>(local.size() * sizeof(T));
  std::vector<int> counts(n_ranks), offsets(n_ranks + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 0; r < n_ranks; ++r)
    offsets[r + 1] = offsets[r] + counts[r];
  std::vector<T> all(offsets.back() / sizeof(T));
  MPI_Allgatherv(local.data(), count, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, comm);
  return all;
}

} // namespace sherd
