// label: unit
// ranks: 1 2 3
#include <cstdlib>
#include <optional>
#include <string>

#include <catch2/catch.hpp>
#include <omp.h>
#include <sched.h>

#include <sherd/base/threads.h>

using namespace sherd;

namespace
{

/// Binds the rank to some of its cores, and back.
class Binding
{
public:
  explicit Binding(const cpu_set_t &cores)
  {
    sched_getaffinity(0, sizeof(before_), &before_);
    sched_setaffinity(0, sizeof(cores), &cores);
  }
  ~Binding() { sched_setaffinity(0, sizeof(before_), &before_); }
  Binding(const Binding &)            = delete;
  Binding &operator=(const Binding &) = delete;

private:
  cpu_set_t before_;
};

/// Sets OMP_NUM_THREADS and the number of threads, and back.
class Threads
{
public:
  Threads(const char *variable, int n_threads) : n_threads_(omp_get_max_threads())
  {
    if (const char *value = std::getenv("OMP_NUM_THREADS"))
      variable_ = value;
    set(variable);
    omp_set_num_threads(n_threads);
  }
  ~Threads()
  {
    set(variable_ ? variable_->c_str() : nullptr);
    omp_set_num_threads(n_threads_);
  }
  Threads(const Threads &)            = delete;
  Threads &operator=(const Threads &) = delete;

private:
  static void set(const char *variable)
  {
    if (variable == nullptr)
      unsetenv("OMP_NUM_THREADS");
    else
      setenv("OMP_NUM_THREADS", variable, 1);
  }

  std::optional<std::string> variable_;
  int                        n_threads_;
};

cpu_set_t own_cores()
{
  cpu_set_t cores;
  CPU_ZERO(&cores);
  sched_getaffinity(0, sizeof(cores), &cores);
  return cores;
}

cpu_set_t first_core()
{
  const auto all = own_cores();
  cpu_set_t  one;
  CPU_ZERO(&one);
  for (int core = 0; CPU_COUNT(&one) == 0; ++core)
    if (CPU_ISSET(core, &all))
      CPU_SET(core, &one);
  return one;
}

} // namespace

TEST_CASE("Ranks that may use the same cores share them")
{
  int n_ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const auto cores   = own_cores();
  const int  n_cores = CPU_COUNT(&cores);
  CHECK(threads_of_rank(MPI_COMM_WORLD) == std::max(1, n_cores / n_ranks));
  CHECK(threads_of_rank(MPI_COMM_SELF) == n_cores);
}

TEST_CASE("A rank that is bound to one core has one thread")
{
  const Binding binding(first_core());
  CHECK(threads_of_rank(MPI_COMM_WORLD) == 1);
  CHECK(threads_of_rank(MPI_COMM_SELF) == 1);
}

TEST_CASE("OMP_NUM_THREADS has precedence")
{
  const int expected = threads_of_rank(MPI_COMM_SELF);
  {
    const Threads threads("7", 7);
    set_threads_of_rank(MPI_COMM_SELF);
    CHECK(omp_get_max_threads() == 7);
  }
  {
    const Threads threads(nullptr, expected + 5);
    set_threads_of_rank(MPI_COMM_SELF);
    CHECK(omp_get_max_threads() == expected);
  }
}
