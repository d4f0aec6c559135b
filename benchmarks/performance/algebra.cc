// Sparse product and incomplete factors against the bandwidth of memory, on the matrices of a plate (blocks of 3) and
// of a shell (blocks of 4) that no cache holds.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/algebra          [--benchmark_format=json]
#include "plate.h"
#include "sheet.h"

#include <sherd/algebra/block_ilu.h>

using namespace sherd;
using namespace sherd::performance;

namespace
{

Matrix plate_matrix()
{
  Plate plate(400);
  plate.linearise();
  return std::move(plate.matrix);
}

Matrix shell_matrix()
{
  Sheet<models::Shell> sheet(256);
  sheet.linearise();
  return std::move(sheet.matrix);
}

/// The matrix of a problem, made once.
template <Matrix (*make)()>
const Matrix &matrix_of()
{
  static const Matrix matrix = make();
  return matrix;
}

/// Reads values and columns of the matrix and x once, writes y.
template <Matrix (*make)()>
void multiply(benchmark::State &run)
{
  const Matrix &A = matrix_of<make>();
  Vector        x(A.shared_distribution(), A.block_size()), y = x;
  x.fill(1.);
  for (auto _ : run)
    {
      A.multiply(x, y);
      benchmark::ClobberMemory();
    }
  run.counters["flops"] = rate(2. * static_cast<double>(A.values().size()));
  count_bytes(run, 8. * A.values().size() + 4. * A.graph().columns.size() + 8. * (x.local().size() + y.local().size()));
}
BENCHMARK(multiply<plate_matrix>)->Unit(benchmark::kMillisecond);
BENCHMARK(multiply<shell_matrix>)->Unit(benchmark::kMillisecond);

double factor_bytes(const BlockIlu &ilu)
{
  return static_cast<double>(ilu.n_blocks()) * (4. * ilu.block_size() * ilu.block_size() + 4.);
}

/// Symbolic phase: the graph of the factors. Argument: level of fill.
template <Matrix (*make)()>
void ilu_graph(benchmark::State &run)
{
  const Matrix &A = matrix_of<make>();
  for (auto _ : run)
    benchmark::DoNotOptimize(BlockIlu(A.graph(), A.block_size(), static_cast<int>(run.range(0))));
}
BENCHMARK(ilu_graph<plate_matrix>)->Arg(1)->Unit(benchmark::kMillisecond);

/// Reads the matrix, writes the factors. Argument: level of fill.
template <Matrix (*make)()>
void ilu_factor(benchmark::State &run)
{
  const Matrix &A = matrix_of<make>();
  BlockIlu      ilu(A.graph(), A.block_size(), static_cast<int>(run.range(0)));
  for (auto _ : run)
    ilu.factor(A.graph(), A.values());
  run.counters["us_per_row"] = time_by(ilu.n_rows() * 1e-6);
  count_bytes(run, 8. * A.values().size() + 4. * A.graph().columns.size() + factor_bytes(ilu));
}
BENCHMARK(ilu_factor<plate_matrix>)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(ilu_factor<shell_matrix>)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Reads the factors once, reads and writes x twice.
template <Matrix (*make)()>
void ilu_apply(benchmark::State &run)
{
  const Matrix &A = matrix_of<make>();
  BlockIlu      ilu(A.graph(), A.block_size(), static_cast<int>(run.range(0)));
  ilu.factor(A.graph(), A.values());
  std::vector<double> x(static_cast<std::size_t>(ilu.n_rows()) * ilu.block_size(), 1.);
  for (auto _ : run)
    {
      std::fill(x.begin(), x.end(), 1.);
      ilu.solve(x);
    }
  count_bytes(run, factor_bytes(ilu) + 5. * 8. * x.size());
}
BENCHMARK(ilu_apply<plate_matrix>)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(ilu_apply<shell_matrix>)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

} // namespace

int main(int argc, char **argv)
{
  return run_benchmarks(argc, argv);
}
