// Element force and tangent alone, plane and shell, degrees 2, 3 and 4, against the peak of the core and against the
// textbook loop of the tests. The laws are the paper's; half of the points load, the layers of shells are cut.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/kernels          [--benchmark_format=json]
#include "measure.h"

#include <forms/textbook_element.h>

using namespace sherd;
using namespace sherd::performance;

namespace
{

template <int degree>
using Plane = test::Membrane<degradation::Cubic, crack_density::FourthOrder, split::SurfaceStretch, degree>;
template <int degree>
using Shell = test::StretchShell<degree>;

/// Floating point operations of the products in theory E.2 at one quadrature point, with n_b shape functions, n_u
/// displacements and n_e strains (3, in space 6):
///
///   D B                                    2 n_e^2 n_u
///   B^T (D B)                              2 n_e n_u^2
///   geometric part of bending, in space    2 * 4 n_u^2     (p^c u^c + u^c p^c, c = 1, 2)
///   tau^ab N,a N,b and the mass            2 * 3 n_b^2
///   displacement by phase, phase by displacement   2 * 2 n_u n_b
///   phase                                  2 * 4 n_b^2
///
/// Counted by these formulas whatever the kernel does: material law, tables, force and padding are left out, and what a
/// kernel saves by another arrangement counts as done.
template <class Model>
double tangent_operations()
{
  constexpr double n_b = ElementMatrix<Model>::n_b, n_u = Model::spacedim * n_b, n_e = Model::spacedim == 2 ? 3. : 6.;
  constexpr double bending = Model::spacedim == 2 ? 0. : 8. * n_u * n_u;
  return 2. * n_e * n_e * n_u + 2. * n_e * n_u * n_u + bending + 14. * n_b * n_b + 4. * n_u * n_b;
}

template <class Model>
struct Element
{
  using Problem = test::ElementProblem<Model>;

  Element()
      : surface(test::sample_surface<Model::degree, Model::spacedim>(test::Shape::distorted)),
        problem(test::sample_model<Model>(test::thick_layers(test::Shape::distorted)), surface, number),
        y(problem.deformed(test::deformation<Model::spacedim>(1.02), .03 * std::sqrt(problem.area()), 21)),
        fields(problem.fields(y)),
        history(test::past_history(problem, y, test::Past::both))
  {
  }

  void tangent()
  {
    element_tangent(problem.model, problem.data, fields, history.data(), .8, PhaseTangent::consistent, force_, matrix_);
    benchmark::DoNotOptimize(matrix_);
  }
  void force()
  {
    element_force(problem.model, problem.data, fields, history.data(), force_);
    benchmark::DoNotOptimize(force_);
  }
  void textbook() const
  {
    benchmark::DoNotOptimize(test::textbook_element(problem.model, surface, number, y, Eigen::VectorXd::Zero(y.size()),
                                                    {history.begin(), history.end()}, .8));
  }

  static constexpr int                    number = 5;
  Surface<Model::degree, Model::spacedim> surface;
  Problem                                 problem;
  Eigen::VectorXd                         y;
  ElementFields<Model>                    fields;
  typename Problem::History               history;

private:
  ElementVector<Model> force_;
  ElementMatrix<Model> matrix_;
};

template <class Model>
void tangent(benchmark::State &run)
{
  constexpr double n_q = ElementData<Model>::n_q;
  Element<Model>   element;
  const double     flops    = n_q * tangent_operations<Model>();
  const double     textbook = shortest(20, [&] { element.textbook(); });
  for (auto _ : run)
    element.tangent();
  run.counters["ns_per_point"] = time_by(n_q * 1e-9);
  run.counters["GFlop/s"]      = rate(flops * 1e-9);
  run.counters["of_peak"]      = rate(flops / peak_flops());
  run.counters["peak_GFlop/s"] = peak_flops() * 1e-9;
  run.counters["textbook_us"]  = textbook * 1e6;
  run.counters["times_faster"] = rate(textbook);
}

template <class Model>
void force(benchmark::State &run)
{
  Element<Model> element;
  for (auto _ : run)
    element.force();
  run.counters["ns_per_point"] = time_by(ElementData<Model>::n_q * 1e-9);
}

BENCHMARK(tangent<Plane<2>>)->Name("tangent/plane/2")->Unit(benchmark::kMicrosecond);
BENCHMARK(tangent<Plane<3>>)->Name("tangent/plane/3")->Unit(benchmark::kMicrosecond);
BENCHMARK(tangent<Plane<4>>)->Name("tangent/plane/4")->Unit(benchmark::kMicrosecond);
BENCHMARK(tangent<Shell<2>>)->Name("tangent/shell/2")->Unit(benchmark::kMicrosecond);
BENCHMARK(tangent<Shell<3>>)->Name("tangent/shell/3")->Unit(benchmark::kMicrosecond);
BENCHMARK(tangent<Shell<4>>)->Name("tangent/shell/4")->Unit(benchmark::kMicrosecond);
BENCHMARK(force<Plane<2>>)->Name("force/plane/2")->Unit(benchmark::kMicrosecond);
BENCHMARK(force<Plane<3>>)->Name("force/plane/3")->Unit(benchmark::kMicrosecond);
BENCHMARK(force<Plane<4>>)->Name("force/plane/4")->Unit(benchmark::kMicrosecond);
BENCHMARK(force<Shell<2>>)->Name("force/shell/2")->Unit(benchmark::kMicrosecond);
BENCHMARK(force<Shell<3>>)->Name("force/shell/3")->Unit(benchmark::kMicrosecond);
BENCHMARK(force<Shell<4>>)->Name("force/shell/4")->Unit(benchmark::kMicrosecond);

} // namespace

int main(int argc, char **argv)
{
  return run_benchmarks(argc, argv);
}
