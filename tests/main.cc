// Runs the tests inside one MPI environment; a failure on any rank fails all of them.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <mpi.h>

#include <sherd/base/environment.h>

int main(int argc, char **argv)
{
  const sherd::MpiSession session(argc, argv);
  const int               local  = Catch::Session().run(argc, argv);
  int                     global = local;
  MPI_Allreduce(&local, &global, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return global;
}
