// What the element loop of shells costs: one tangent of a bent sheet by degree and material.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/shell          [--benchmark_format=json]
#include <benchmark/benchmark.h>

#include <sherd/geometry/shapes.h>
#include <sherd/solve/instances.h>

using namespace sherd;

namespace
{

models::Shell make_model(std::type_identity<models::Shell>)
{
  const auto laws = material::neo_hooke_canham_shell(1e6, .3, .01);
  return models::Shell({laws.membrane, laws.bending, {.thickness = .01}}, degradation::Cubic(), {}, 1., .02, 1.);
}

template <int degree>
models::KoiterShell<degree> make_model(std::type_identity<models::KoiterShell<degree>>)
{
  const auto laws = material::koiter_shell(1e6, .3, .01);
  return models::KoiterShell<degree>(split::None(laws.membrane, laws.bending), degradation::Cubic(), {}, 1., .02, 1.);
}

/// A part of a cylinder that unbends and stretches, so that its layers are cut; n x n elements.
template <class Model>
struct Sheet
{
  static constexpr int degree = Model::degree;

  Sheet(const Environment &env, int n, shapes::Fit fit)
      : surface(shapes::cylinder<degree>(1., 1., {-.5, .5}, {n, n}, fit)),
        space(env, surface),
        model(make_model(std::type_identity<Model>())),
        state(space),
        assembler(model, space, state.distribution),
        matrix(assembler.make_matrix()),
        force(state.distribution, 4)
  {
    auto x = state.position.local();
    for (int a = 0; a < state.distribution->n_local(); ++a)
      x[3 * a + 2] *= .9;
  }

  void linearise()
  {
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, 1., PhaseTangent::consistent,
                        force, matrix);
  }

  Surface<degree, 3>    surface;
  ShellSpace<degree, 3> space;
  Model                 model;
  State<degree, 3>      state;
  Assembler<Model>      assembler;
  Matrix                matrix;
  Vector                force;
};

const Environment &world()
{
  static const Environment env(MPI_COMM_WORLD);
  return env;
}

template <class Model>
void count_elements(benchmark::State &run, const Sheet<Model> &sheet)
{
  run.counters["us_per_element"] = benchmark::Counter(
      sheet.surface.n_elements() * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Element force, tangent, extraction and scatter.
template <class Model, shapes::Fit fit>
void assembly(benchmark::State &run)
{
  Sheet<Model> sheet(world(), 48, fit);
  for (auto _ : run)
    sheet.linearise();
  count_elements(run, sheet);
}
BENCHMARK(assembly<models::Shell, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::Shell, shapes::Fit::exact>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<2>, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<3>, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<4>, shapes::Fit::smooth>)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly<models::KoiterShell<4>, shapes::Fit::exact>)->Unit(benchmark::kMillisecond);

/// Element force and scatter, without a tangent.
template <class Model>
void force_kernel(benchmark::State &run)
{
  Sheet<Model> sheet(world(), 48, shapes::Fit::smooth);
  for (auto _ : run)
    sheet.assembler.force({sheet.state.position, sheet.state.acceleration, sheet.state.phase}, sheet.state.history,
                          sheet.force);
  count_elements(run, sheet);
}
BENCHMARK(force_kernel<models::Shell>)->Unit(benchmark::kMillisecond);
BENCHMARK(force_kernel<models::KoiterShell<4>>)->Unit(benchmark::kMillisecond);

/// Element tangent alone.
template <class Model>
void kernel(benchmark::State &run)
{
  const Sheet<Model>   sheet(world(), 8, shapes::Fit::smooth);
  const auto           data   = element_data(sheet.model, sheet.surface, 27);
  ElementFields<Model> fields = {};
  for (int b = 0; b < fields.n_b; ++b)
    {
      for (int d = 0; d < 3; ++d)
        fields.position[d][b] = data.geometry.bezier_points(d, b) * (d == 2 ? .9 : 1.);
      fields.phase[b] = 1.;
    }
  const std::vector<double> history(ElementData<Model>::n_q, 0.);
  ElementVector<Model>      force;
  ElementMatrix<Model>      matrix;
  for (auto _ : run)
    {
      element_tangent(sheet.model, data, fields, history.data(), 1., PhaseTangent::consistent, force, matrix);
      benchmark::DoNotOptimize(matrix);
    }
}
BENCHMARK(kernel<models::Shell>)->Unit(benchmark::kMicrosecond);
BENCHMARK(kernel<models::KoiterShell<2>>)->Unit(benchmark::kMicrosecond);
BENCHMARK(kernel<models::KoiterShell<3>>)->Unit(benchmark::kMicrosecond);
BENCHMARK(kernel<models::KoiterShell<4>>)->Unit(benchmark::kMicrosecond);

} // namespace

int main(int argc, char **argv)
{
  const MpiSession session(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
