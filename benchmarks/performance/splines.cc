// Refinement and extraction of LR bases: five levels along the diagonal band |u - v| <= 11 h, h the finest size.
//
// Run:  build/benchmarks/splines          [--benchmark_format=json]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include <sherd/spline/extraction.h>
#include <sherd/spline/independence.h>

using namespace sherd;

namespace
{

constexpr int n_levels = 5;

template <int degree>
LRBasis<degree> uniform(int n)
{
  std::vector<double> knots(degree, 0.);
  for (int i = 0; i <= n; ++i)
    knots.push_back(i);
  knots.insert(knots.end(), degree, n);
  return {knots, knots};
}

/// Halves all functions whose support meets the band, level by level.
template <int degree>
void refine_band(LRBasis<degree> &basis)
{
  const double finest = 1. / (1 << n_levels);
  for (int level = 1; level <= n_levels; ++level)
    {
      std::vector<int> marked;
      for (int i = 0; i < basis.n_functions(); ++i)
        {
          const auto   support  = basis.function(i).support();
          const double distance = std::max(support.min[0] - support.max[1], support.min[1] - support.max[0]);
          if (distance <= 11. * finest)
            marked.push_back(i);
        }
      const double length = 1. / (1 << level);
      basis.refine(marked, {{length, length}});
    }
}

template <int degree>
void refinement(benchmark::State &run)
{
  int n_functions = 0;
  for (auto _ : run)
    {
      auto basis = uniform<degree>(static_cast<int>(run.range(0)));
      refine_band(basis);
      n_functions = basis.n_functions();
    }
  run.counters["functions"]       = n_functions;
  run.counters["us_per_function"] = benchmark::Counter(
      n_functions * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_TEMPLATE(refinement, 2)->Arg(20)->Arg(40)->Arg(80)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(refinement, 3)->Arg(20)->Unit(benchmark::kMillisecond);

template <int degree>
void extract(benchmark::State &run)
{
  auto basis = uniform<degree>(20);
  refine_band(basis);
  for (auto _ : run)
    for (int e = 0; e < basis.n_elements(); ++e)
      benchmark::DoNotOptimize(extraction(basis, e));
  run.counters["us_per_element"] = benchmark::Counter(
      basis.n_elements() * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_TEMPLATE(extract, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(extract, 3)->Unit(benchmark::kMillisecond);

void independence(benchmark::State &run)
{
  auto basis = uniform<2>(20);
  refine_band(basis);
  for (auto _ : run)
    benchmark::DoNotOptimize(check_independence(basis));
}
BENCHMARK(independence)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
