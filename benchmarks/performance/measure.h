#pragma once

#include <algorithm>
#include <ctime>
#include <limits>
#include <vector>

#include <benchmark/benchmark.h>

#include <sherd/base/environment.h>

/// What the benchmarks measure with: processor time, the limits of one core found in the same program, counters.
namespace sherd::performance
{

inline const Environment &world()
{
  static const Environment env(MPI_COMM_WORLD);
  return env;
}

/// Processor time of the calling thread [s]: what other programs take does not count.
inline double cpu_seconds()
{
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

/// The shortest of @p repetitions calls of @p work, processor time [s].
template <class Work>
double shortest(int repetitions, const Work &work)
{
  double best = std::numeric_limits<double>::infinity();
  for (int r = 0; r < repetitions; ++r)
    {
      const double start = cpu_seconds();
      work();
      best = std::min(best, cpu_seconds() - start);
    }
  return best;
}

typedef double Register32 __attribute__((vector_size(32)));
typedef double Register64 __attribute__((vector_size(64)));

/// Floating point operations per second of a loop of fused multiply-adds on registers.
template <class Register>
double multiply_add_rate()
{
  constexpr int width  = sizeof(Register) / sizeof(double);
  constexpr int n_sums = 12, n_rounds = 2000000; // as many chains as hide the latency
  Register      sum[n_sums], factor, shift;
  for (int i = 0; i < width; ++i)
    {
      factor[i] = 1. - 1e-9 * i;
      shift[i]  = 1e-9;
    }
  for (auto &s : sum)
    s = shift;
  const double seconds = shortest(10, [&] {
    benchmark::DoNotOptimize(factor);
    benchmark::DoNotOptimize(shift);
    for (int round = 0; round < n_rounds; ++round)
#pragma GCC unroll 12
      for (int i = 0; i < n_sums; ++i)
        sum[i] = sum[i] * factor + shift;
    for (auto &s : sum)
      benchmark::DoNotOptimize(s);
  });
  return 2. * width * n_sums * n_rounds / seconds;
}

/// Peak of one core [flop/s]: the faster of registers of 32 and of 64 bytes.
inline double peak_flops()
{
#ifdef __AVX512F__
  static const double peak = std::max(multiply_add_rate<Register32>(), multiply_add_rate<Register64>());
#else
  static const double peak = multiply_add_rate<Register32>();
#endif
  return peak;
}

/// Bandwidth of memory for one core [byte/s]: a = b + s c on arrays of 64 MB, three times 8 bytes an entry.
inline double triad_bandwidth()
{
  static const double bandwidth = [] {
    constexpr std::size_t n = 8 << 20;
    std::vector<double>   a(n), b(n, 1.), c(n, 2.);
    const double          seconds = shortest(8, [&] {
      for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + 3. * c[i];
      benchmark::DoNotOptimize(a.data());
      benchmark::ClobberMemory();
    });
    return 24. * n / seconds;
  }();
  return bandwidth;
}

/// Counter: @p amount of an iteration over its time.
inline benchmark::Counter rate(double amount)
{
  return {amount, benchmark::Counter::kIsIterationInvariantRate};
}

/// Counter: time of an iteration over @p amount. For microseconds give the amount in millionths.
inline benchmark::Counter time_by(double amount)
{
  return {amount, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

inline void count_elements(benchmark::State &run, double n_elements)
{
  run.counters["us_per_element"] = time_by(n_elements * 1e-6);
}

/// Gigabytes a second and their ratio to the triad.
inline void count_bytes(benchmark::State &run, double bytes)
{
  run.counters["GB/s"]       = rate(bytes * 1e-9);
  run.counters["of_triad"]   = rate(bytes / triad_bandwidth());
  run.counters["triad_GB/s"] = triad_bandwidth() * 1e-9;
}

/// Runs what the arguments ask for, inside one MPI environment.
inline int run_benchmarks(int argc, char **argv)
{
  const MpiSession session(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

} // namespace sherd::performance
