# Environment of every test: as root, on more ranks than cores, one thread a rank.
set(SHERD_TEST_ENVIRONMENT
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
    OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none OMP_NUM_THREADS=1
    # Open MPI and the linear algebra below it keep memory until the process ends.
    ASAN_OPTIONS=detect_leaks=0)
