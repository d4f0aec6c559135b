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

/// One Newton iteration with fresh factors by a part of the unknowns: what the coupled system costs and what its
/// halves. Argument: elements along the plate.
template <Unknowns part>
void iteration(benchmark::State &run)
{
  Plate              plate(static_cast<int>(run.range(0)));
  const BalanceLevel level{plate.state.position, plate.state.acceleration, plate.state.phase};
  const auto         range  = fields_of(part, 2);
  Matrix             matrix = plate.assembler.make_matrix(part);
  Vector             external(plate.state.distribution, 3), rhs(plate.state.distribution, range.count), solution = rhs;
  LinearSolver       solver({.escalation = Escalation::never, .reuse = 0});
  for (std::size_t i = 0; i < rhs.owned().size(); ++i)
    rhs.owned()[i] = std::sin(.1 * static_cast<double>(i / range.count) + static_cast<double>(i % range.count));
  double assembly = 0., set_up = 0., iterate = 0.;
  for (auto _ : run)
    {
      const double start = cpu_seconds();
      if constexpr (part == Unknowns::all)
        plate.assembler.linearise(level, plate.state.history, plate.mass_weight, PhaseTangent::consistent, {},
                                  plate.force, external, matrix);
      else
        plate.assembler.template linearise_part<part>(level, plate.state.history, plate.mass_weight,
                                                      PhaseTangent::consistent, {}, plate.force, external, matrix);
      assembly += cpu_seconds() - start;
      const auto report = solver.solve(matrix, rhs, solution);
      set_up += report.setup_seconds;
      iterate += report.solve_seconds;
    }
  const auto average       = [](double sum) { return benchmark::Counter(sum, benchmark::Counter::kAvgIterations); };
  run.counters["unknowns"] = range.count * plate.space.n_control_points();
  run.counters["us_an_element"] = average(1e6 * assembly / plate.space.n_active_elements());
  run.counters["set_up_s"]      = average(set_up);
  run.counters["solve_s"]       = average(iterate);
  run.counters["matrix_MB"]     = 8e-6 * static_cast<double>(matrix.values().size());
}
BENCHMARK_TEMPLATE(iteration, Unknowns::all)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(iteration, Unknowns::displacement)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(iteration, Unknowns::phase)->Arg(200)->Unit(benchmark::kMillisecond);

/// The forces of the displacement alone, as an explicit step needs them. Argument: elements along the plate.
void displacement_force(benchmark::State &run)
{
  Plate              plate(static_cast<int>(run.range(0)));
  const BalanceLevel level{plate.state.position, plate.state.acceleration, plate.state.phase};
  Vector             external(plate.state.distribution, 3);
  double             seconds = 0.;
  for (auto _ : run)
    {
      const double start = cpu_seconds();
      plate.assembler.part_force<Unknowns::displacement>(level, plate.state.history, {}, plate.force, external);
      seconds += cpu_seconds() - start;
    }
  run.counters["us_an_element"] =
      benchmark::Counter(1e6 * seconds / plate.space.n_active_elements(), benchmark::Counter::kAvgIterations);
}
BENCHMARK(displacement_force)->Arg(200)->Unit(benchmark::kMillisecond);

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
