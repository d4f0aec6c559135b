// What a refinement of the mesh costs beside the splines: refined surface, carried state, partition, numbering and
// graph, data of the elements. Times by point are those of all control points afterwards.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/space          [--benchmark_format=json]
#include "plate.h"

#include <sherd/space/partition.h>
#include <sherd/state/transfer.h>

using namespace sherd;
using namespace sherd::performance;

namespace
{

void count_points(benchmark::State &run, int n_points)
{
  run.counters["points"]       = n_points;
  run.counters["us_per_point"] = time_by(n_points * 1e-6);
}

/// One level along the middle line of the plate.
SurfaceRefinement refine(Surface<2, 2> &surface, double l0)
{
  const auto       X = surface.control_points();
  std::vector<int> points;
  for (int i = 0; i < X.rows(); ++i)
    if (std::abs(X(i, 1) - .025) <= 4. * l0)
      points.push_back(i);
  const auto size = surface.patch(0).basis.element(0).size();
  return surface.refine(points, {{size[0] / 2., size[1] / 2.}});
}

/// The surface with its check of independence. Argument: elements along the plate.
void refine_surface(benchmark::State &run)
{
  const Plate plate(static_cast<int>(run.range(0)));
  int         n = 0;
  for (auto _ : run)
    {
      run.PauseTiming();
      auto surface = plate.surface;
      run.ResumeTiming();
      refine(surface, plate.l0);
      n = surface.n_control_points();
    }
  run.counters["added"] = n - plate.surface.n_control_points();
  count_points(run, n);
}
BENCHMARK(refine_surface)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

/// Control values and history.
void transfer_state(benchmark::State &run)
{
  Plate      plate(static_cast<int>(run.range(0)));
  const auto old        = gather(plate.state, plate.space);
  auto       surface    = plate.surface;
  const auto boxes      = element_boxes(surface);
  const auto refinement = refine(surface, plate.l0);
  for (auto _ : run)
    benchmark::DoNotOptimize(transfer(old, boxes, refinement, surface));
  count_points(run, surface.n_control_points());
}
BENCHMARK(transfer_state)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

/// Numbering of control points and elements and the graph of the matrix, for one rank.
void number(benchmark::State &run)
{
  Plate plate(static_cast<int>(run.range(0)));
  for (auto _ : run)
    plate.space.rebuild();
  count_points(run, plate.surface.n_control_points());
}
BENCHMARK(number)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

/// METIS on the graph of control points. Arguments: elements along the plate, parts.
void partition_points(benchmark::State &run)
{
  const Plate plate(static_cast<int>(run.range(0)));
  const auto &graph = plate.space.distribution().graph;
  for (auto _ : run)
    benchmark::DoNotOptimize(partition(graph, {}, static_cast<int>(run.range(1))));
  count_points(run, graph.n_rows());
}
BENCHMARK(partition_points)->ArgsProduct({{100, 200, 400}, {2}})->Args({200, 8})->Unit(benchmark::kMillisecond);

/// A state brought together and given back to its ranks.
void gather_and_distribute(benchmark::State &run)
{
  const Plate plate(static_cast<int>(run.range(0)));
  for (auto _ : run)
    benchmark::DoNotOptimize(distribute(gather(plate.state, plate.space), plate.space));
  count_points(run, plate.surface.n_control_points());
}
BENCHMARK(gather_and_distribute)->Arg(200)->Unit(benchmark::kMillisecond);

/// Assembler and matrix of a new mesh.
void element_tables(benchmark::State &run)
{
  const Plate plate(static_cast<int>(run.range(0)));
  for (auto _ : run)
    {
      const Assembler<Plate::Model> assembler(plate.model, plate.space, plate.state.distribution);
      benchmark::DoNotOptimize(assembler.make_matrix());
    }
  count_points(run, plate.surface.n_control_points());
}
BENCHMARK(element_tables)->Arg(200)->Unit(benchmark::kMillisecond);

} // namespace

int main(int argc, char **argv)
{
  return run_benchmarks(argc, argv);
}
