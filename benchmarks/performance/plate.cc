// What one Newton iteration of the branching plate costs: element loop, preconditioner, solve.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/plate          [--benchmark_format=json]
#include <benchmark/benchmark.h>

#include <sherd/adapt/adaptivity.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/time/generalized_alpha.h>

using namespace sherd;
using Glass =
    BrittleShell<2, 2, split::SurfaceStretch<material::NeoHooke>, degradation::Cubic, crack_density::FourthOrder>;

namespace
{

/// The notched plate of step-7, strained and with a crack, on n x n/2 elements without refinement.
struct Plate
{
  explicit Plate(const Environment &env, int n)
      : l0(.2 / n),
        surface(shapes::plate<2, 2>({.1, .05}, {n, n / 2})),
        space(env, surface),
        glass(split::SurfaceStretch<material::NeoHooke>(material::NeoHooke(material::plane_strain_moduli(32e9, .2))),
              degradation::Cubic(), {}, 3., l0, 2450.),
        state(space),
        assembler(glass, space, state.distribution),
        matrix(assembler.make_matrix()),
        force(state.distribution, 3)
  {
    const PreCrack<2> notch({Segment<2>{{0., .025}, {.05, .025}}}, l0);
    const auto        X = surface.control_points();
    for (int a = 0; a < state.distribution->n_local(); ++a)
      {
        const Point<2> position = X.row(state.distribution->global(a)).transpose();
        state.phase.local()[a]  = notch.phase(position, glass.crack_density);
        state.position.local()[2 * a + 1] += 5e-5 * position[1];
      }
    for (int e = 0; e < space.n_active_elements(); ++e)
      for (int q = 0; q < state.n_q; ++q)
        state.history[e][q] = notch.history(assembler.quadrature_position(e, q), glass.degradation, 3.);
    for (int a = 0; a < state.distribution->n_owned(); ++a)
      for (int c = 0; c < 3; ++c)
        rhs().local()[3 * a + c] = std::sin(.1 * a + c);
  }

  Vector &rhs() { return force; }

  void linearise()
  {
    const double dt    = 2. * l0 / (.6 * 2125.);
    const Stage  stage = GeneralizedAlpha(.5).stage(dt, dt);
    Vector       residual(state.distribution, 3);
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, stage.mass_weight(),
                        PhaseTangent::consistent, residual, matrix);
  }

  double           l0;
  Surface<2, 2>    surface;
  ShellSpace<2, 2> space;
  Glass            glass;
  State<2, 2>      state;
  Assembler<Glass> assembler;
  Matrix           matrix;
  Vector           force;
};

const Environment &world()
{
  static const Environment env(MPI_COMM_WORLD);
  return env;
}

/// Element tangent and force, without extraction and scatter.
void kernel(benchmark::State &run)
{
  Plate                plate(world(), 20);
  const auto           data = element_data(plate.glass, plate.surface, 50);
  ElementFields<Glass> fields{};
  for (int b = 0; b < fields.n_b; ++b)
    {
      for (int d = 0; d < 2; ++d)
        fields.position[d][b] = data.geometry.bezier_points(d, b) * (1. + 1e-4 * d);
      fields.phase[b] = .9 + .01 * b;
    }
  const std::vector<double> history(9, 1.);
  ElementVector<Glass>      force;
  ElementMatrix<Glass>      matrix;
  for (auto _ : run)
    {
      element_tangent(plate.glass, data, fields, history.data(), 1e12, PhaseTangent::consistent, force, matrix);
      benchmark::DoNotOptimize(matrix);
    }
}
BENCHMARK(kernel)->Unit(benchmark::kMicrosecond);

void force_kernel(benchmark::State &run)
{
  Plate  plate(world(), static_cast<int>(run.range(0)));
  Vector force(plate.state.distribution, 3);
  for (auto _ : run)
    plate.assembler.force({plate.state.position, plate.state.acceleration, plate.state.phase}, plate.state.history,
                          force);
  run.counters["us_per_element"] = benchmark::Counter(
      plate.surface.n_elements() * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(force_kernel)->Arg(200)->Unit(benchmark::kMillisecond);

/// The element loop with extraction and scatter.
void assembly(benchmark::State &run)
{
  Plate plate(world(), static_cast<int>(run.range(0)));
  for (auto _ : run)
    plate.linearise();
  run.counters["us_per_element"] = benchmark::Counter(
      plate.surface.n_elements() * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(assembly)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

/// One linear solve to 1e-4. Arguments: elements along the plate, preconditioner.
void solve(benchmark::State &run)
{
  Plate                plate(world(), static_cast<int>(run.range(0)));
  LinearSolverSettings settings;
  settings.preconditioner = static_cast<Preconditioner>(run.range(1));
  settings.escalation     = Escalation::never;
  settings.reuse          = 0;
  LinearSolver solver(settings);
  Vector       solution(plate.state.distribution, 3);
  SolveReport  report;
  double       set_up = 0., iterate = 0.;
  for (auto _ : run)
    {
      run.PauseTiming();
      plate.linearise();
      run.ResumeTiming();
      report = solver.solve(plate.matrix, plate.rhs(), solution);
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
  const MpiSession session(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
