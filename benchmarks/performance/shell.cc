// What the element loop and a Newton iteration of shells cost, on a bent sheet, by degree and material.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/shell          [--benchmark_format=json]
#include "sheet.h"
#include "element_loop.h"

using namespace sherd;
using namespace sherd::performance;

namespace
{

template <class Model, shapes::Fit fit>
void assembly(benchmark::State &run)
{
  Sheet<Model> sheet(48, fit);
  measure_assembly(run, sheet);
}
BENCHMARK(assembly<models::Shell, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::Shell, shapes::Fit::exact>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<2>, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<3>, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<4>, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<4>, shapes::Fit::exact>)->Unit(benchmark::kMillisecond);

template <class Model>
void force_assembly(benchmark::State &run)
{
  Sheet<Model> sheet(48);
  measure_force(run, sheet);
}
BENCHMARK(force_assembly<models::Shell>)->Unit(benchmark::kMillisecond);
BENCHMARK(force_assembly<models::KoiterShell<4>>)->Unit(benchmark::kMillisecond);

void newton(benchmark::State &run)
{
  Sheet<models::Shell> sheet(static_cast<int>(run.range(0)));
  measure_newton(run, sheet);
}
BENCHMARK(newton)->Arg(48)->Arg(96)->Unit(benchmark::kMillisecond);

} // namespace

int main(int argc, char **argv)
{
  return run_benchmarks(argc, argv);
}
