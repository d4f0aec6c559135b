#include <sherd/base/threads.h>

#include <algorithm>
#include <cstdlib>

#include <omp.h>
#include <sched.h>

namespace sherd
{

int threads_of_rank(MPI_Comm comm)
{
  MPI_Comm node;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int n_ranks;
  MPI_Comm_size(node, &n_ranks);

  // Where the cores do not fit into the set (more than 1024), only their number is known.
  cpu_set_t cores;
  CPU_ZERO(&cores);
  int known = sched_getaffinity(0, sizeof(cores), &cores) == 0 ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &known, 1, MPI_INT, MPI_MIN, node);
  const int own = known ? CPU_COUNT(&cores) : omp_get_num_procs();
  MPI_Allreduce(MPI_IN_PLACE, &cores, sizeof(cores), MPI_BYTE, MPI_BOR, node);
  const int all = known ? CPU_COUNT(&cores) : own;
  MPI_Comm_free(&node);
  return std::max(1, std::min(own, all / n_ranks));
}

void set_threads_of_rank(MPI_Comm comm)
{
  const int   n_threads = threads_of_rank(comm);
  const char *given     = std::getenv("OMP_NUM_THREADS");
  if (given == nullptr || *given == '\0')
    omp_set_num_threads(n_threads);
}

} // namespace sherd
