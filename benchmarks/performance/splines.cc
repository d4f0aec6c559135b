// Refinement and extraction of LR bases: five levels along a diagonal band |u - v| <= 11 h of n x n elements of size 1.
//
// Run:  build/benchmarks/splines          [--benchmark_format=json]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
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

/// Which functions a level halves.
enum class Band
{
  graded, ///< their centre has |u - v| <= 11 h, h the size that is halved: the band narrows with the size
  narrow  ///< their support meets |u - v| <= 11 h, h the finest size
};

template <int degree>
bool is_in_band(const LRFunction<degree> &function, Band band, double halved)
{
  const auto support = function.support();
  if (band == Band::graded)
    return std::abs(support.min[0] + support.max[0] - support.min[1] - support.max[1]) <= 2. * 11. * halved;
  return std::max(support.min[0] - support.max[1], support.min[1] - support.max[0]) <= 11. / (1 << n_levels);
}

template <int degree>
void refine_band(LRBasis<degree> &basis, Band band)
{
  for (double size = 1.; size > 1. / (1 << n_levels); size /= 2.)
    {
      std::vector<int> marked;
      for (int i = 0; i < basis.n_functions(); ++i)
        if (is_in_band(basis.function(i), band, size))
          marked.push_back(i);
      basis.refine(marked, {{size / 2., size / 2.}});
    }
}

/// Argument: elements in each direction of the start. The fit over all starts is that of a time linear in the functions
/// added.
template <int degree, Band band>
void refinement(benchmark::State &run)
{
  const int n       = static_cast<int>(run.range(0));
  int       n_start = 0, n_functions = 0;
  for (auto _ : run)
    {
      auto basis = uniform<degree>(n);
      n_start    = basis.n_functions();
      refine_band(basis, band);
      n_functions = basis.n_functions();
    }
  const int n_added         = n_functions - n_start;
  run.counters["functions"] = n_functions;
  run.counters["added"]     = n_added;
  run.counters["us_per_added"] =
      benchmark::Counter(n_added * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  run.SetComplexityN(n_added);
}
BENCHMARK(refinement<2, Band::graded>)
    ->Arg(20)
    ->Arg(40)
    ->Arg(80)
    ->Arg(160)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(refinement<2, Band::narrow>)->Arg(20)->Arg(40)->Arg(80)->Arg(160)->Unit(benchmark::kMillisecond);
BENCHMARK(refinement<3, Band::graded>)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(refinement<4, Band::graded>)->Arg(20)->Unit(benchmark::kMillisecond);

template <int degree>
void extract(benchmark::State &run)
{
  auto basis = uniform<degree>(20);
  refine_band(basis, Band::graded);
  for (auto _ : run)
    for (int e = 0; e < basis.n_elements(); ++e)
      benchmark::DoNotOptimize(extraction(basis, e));
  run.counters["us_per_element"] = benchmark::Counter(
      basis.n_elements() * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(extract<2>)->Unit(benchmark::kMillisecond);
BENCHMARK(extract<3>)->Unit(benchmark::kMillisecond);
BENCHMARK(extract<4>)->Unit(benchmark::kMillisecond);

void independence(benchmark::State &run)
{
  auto basis = uniform<2>(20);
  refine_band(basis, Band::graded);
  for (auto _ : run)
    benchmark::DoNotOptimize(check_independence(basis));
}
BENCHMARK(independence)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
