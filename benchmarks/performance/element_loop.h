#pragma once

#include <vector>

#include "measure.h"

#include <sherd/assembly/assembler.h>

/// Element loop and Newton iteration of a problem with model, surface, state, assembler, force, matrix, mass_weight and
/// linearise(), as Plate and Sheet have them.
namespace sherd::performance
{

/// Element forces and tangents of the state alone: what linearise() does but for extraction and scatter.
template <class Problem>
class ElementKernels
{
public:
  using Model = typename Problem::Model;

  explicit ElementKernels(const Problem &problem) : problem_(&problem)
  {
    constexpr int dim      = Model::spacedim;
    const auto    position = problem.state.position.local();
    const auto    phase    = problem.state.phase.local();
    for (int e = 0; e < problem.space.n_active_elements(); ++e)
      {
        elements_.push_back(element_data(problem.model, problem.surface, problem.space.distribution().elements[e]));
        const auto           &extraction = elements_.back().geometry.extraction;
        const auto            points     = problem.space.points_of(e);
        ElementFields<Model> &f          = fields_.emplace_back();
        f                                = {};
        for (std::size_t A = 0; A < points.size(); ++A)
          for (int b = 0; b < f.n_b; ++b)
            {
              for (int d = 0; d < dim; ++d)
                f.position[d][b] += extraction(A, b) * position[dim * points[A] + d];
              f.phase[b] += extraction(A, b) * phase[points[A]];
            }
      }
  }

  void linearise()
  {
    for (std::size_t e = 0; e < elements_.size(); ++e)
      {
        element_tangent(problem_->model, elements_[e], fields_[e], problem_->state.history[e], problem_->mass_weight,
                        PhaseTangent::consistent, force_, matrix_);
        benchmark::DoNotOptimize(force_);
        benchmark::DoNotOptimize(matrix_);
      }
  }

private:
  const Problem                    *problem_;
  std::vector<ElementData<Model>>   elements_;
  std::vector<ElementFields<Model>> fields_;
  ElementVector<Model>              force_;
  ElementMatrix<Model>              matrix_;
};

/// The element loop with extraction and scatter, and what of it the kernels are on the same elements and fields.
template <class Problem>
void measure_assembly(benchmark::State &run, Problem &problem)
{
  const int    n      = problem.surface.n_elements();
  const double kernel = [&] {
    ElementKernels<Problem> kernels(problem);
    return shortest(5, [&] { kernels.linearise(); });
  }();
  problem.linearise();
  const double whole = shortest(5, [&] { problem.linearise(); });
  for (auto _ : run)
    problem.linearise();
  count_elements(run, n);
  run.counters["kernel_us"]  = kernel * 1e6 / n;
  run.counters["scatter_us"] = (whole - kernel) * 1e6 / n;
}

/// Element forces with extraction and scatter.
template <class Problem>
void measure_force(benchmark::State &run, Problem &problem)
{
  for (auto _ : run)
    problem.assembler.force({problem.state.position, problem.state.acceleration, problem.state.phase},
                            problem.state.history, problem.force);
  count_elements(run, problem.surface.n_elements());
}

/// One iteration of Newton's method: linearise, equilibrate, factor, solve to the default tolerance.
template <class Problem>
void measure_newton(benchmark::State &run, Problem &problem)
{
  LinearSolverSettings settings;
  settings.reuse = 0;
  LinearSolver solver(settings);
  Vector       increment(problem.state.distribution, Problem::Model::n_fields);
  SolveReport  report;
  double       set_up = 0., iterate = 0.;
  for (auto _ : run)
    {
      problem.linearise();
      report = solver.solve(problem.matrix, problem.force, increment);
      set_up += report.setup_seconds;
      iterate += report.solve_seconds;
    }
  run.counters["unknowns"]       = problem.space.n_unknowns();
  run.counters["us_per_unknown"] = time_by(problem.space.n_unknowns() * 1e-6);
  run.counters["iterations"]     = report.iterations;
  run.counters["set_up_s"]       = benchmark::Counter(set_up, benchmark::Counter::kAvgIterations);
  run.counters["solve_s"]        = benchmark::Counter(iterate, benchmark::Counter::kAvgIterations);
}

} // namespace sherd::performance
