// What one Newton iteration of the branching plate costs: element loop, scatter, preconditioner, solve.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/plate          [--benchmark_format=json]
#include "plate.h"
#include "element_loop.h"

using namespace sherd;
using namespace sherd::performance;

namespace
{

void assembly(benchmark::State &run)
{
  Plate plate(static_cast<int>(run.range(0)));
  measure_assembly(run, plate);
}
BENCHMARK(assembly)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

void force_assembly(benchmark::State &run)
{
  Plate plate(static_cast<int>(run.range(0)));
  measure_force(run, plate);
}
BENCHMARK(force_assembly)->Arg(200)->Unit(benchmark::kMillisecond);

void newton(benchmark::State &run)
{
  Plate plate(static_cast<int>(run.range(0)));
  measure_newton(run, plate);
}
BENCHMARK(newton)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

/// One linear solve to 1e-4 with a right-hand side on all unknowns. Arguments: elements along the plate,
/// preconditioner.
void solve(benchmark::State &run)
{
  Plate                plate(static_cast<int>(run.range(0)));
  LinearSolverSettings settings;
  settings.preconditioner = static_cast<Preconditioner>(run.range(1));
  settings.escalation     = Escalation::never;
  settings.reuse          = 0;
  LinearSolver solver(settings);
  Vector       rhs(plate.state.distribution, 3), solution(plate.state.distribution, 3);
  for (std::size_t i = 0; i < rhs.owned().size(); ++i)
    rhs.owned()[i] = std::sin(.1 * static_cast<double>(i / 3) + static_cast<double>(i % 3));
  SolveReport report;
  double      set_up = 0., iterate = 0.;
  for (auto _ : run)
    {
      run.PauseTiming();
      plate.linearise();
      run.ResumeTiming();
      report = solver.solve(plate.matrix, rhs, solution);
      set_up += report.setup_seconds;
      iterate += report.solve_seconds;
    }
  run.SetLabel(to_string(settings.preconditioner));
  run.counters["unknowns"]   = plate.space.n_unknowns();
  run.counters["iterations"] = report.iterations;
  run.counters["set_up_s"]   = benchmark::Counter(set_up, benchmark::Counter::kAvgIterations);
  run.counters["solve_s"]    = benchmark::Counter(iterate, benchmark::Counter::kAvgIterations);
}
BENCHMARK(solve)->ArgsProduct({{100, 200}, {0, 1, 2}})->Unit(benchmark::kMillisecond)->MinTime(.1);

} // namespace

int main(int argc, char **argv)
{
  return run_benchmarks(argc, argv);
}
