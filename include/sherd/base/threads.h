#pragma once

#include <mpi.h>

namespace sherd
{

/// Threads that a rank may run without getting in the way of others: the cores that the ranks of @p comm on this node
/// may use together, divided by the number of these ranks, at least 1 and no more than the rank may use itself (a rank
/// that is bound to one core has one thread). Collective over @p comm.
int threads_of_rank(MPI_Comm comm);

/// Makes threads_of_rank() the number of OpenMP threads, unless the environment variable OMP_NUM_THREADS says another.
/// Collective over @p comm.
void set_threads_of_rank(MPI_Comm comm);

} // namespace sherd
