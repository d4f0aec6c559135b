#pragma once

#include <iostream>

#include <sherd/adapt/adaptivity.h>
#include <sherd/adapt/refine_along.h>
#include <sherd/base/parameters.h>
#include <sherd/driver/case_kernel.h>
#include <sherd/driver/case_solver.h>
#include <sherd/driver/make_surface.h>
#include <sherd/driver/resting_body.h>
#include <sherd/driver/run_case.h>
#include <sherd/driver/stop_criteria.h>
#include <sherd/output/probes.templates.h>
#include <sherd/output/recorded_run.h>

namespace sherd
{

namespace internal
{

template <int spacedim>
std::vector<PointProbe<spacedim>> make_probes(const OutputParameters &output)
{
  std::vector<PointProbe<spacedim>> probes;
  for (const auto &point : output.points)
    {
      if (point.at.size() != spacedim)
        throw InvalidParameter("output.points: \"" + point.name + "\" has " + std::to_string(point.at.size()) +
                               " coordinates, expected " + std::to_string(spacedim));
      probes.push_back({point.name, Eigen::Map<const Point<spacedim>>(point.at.data())});
    }
  return probes;
}

template <int degree, int spacedim>
void check_edges(const Surface<degree, spacedim> &surface, const std::string &parameter,
                 const std::vector<std::string> &edges)
{
  for (const auto &edge : edges)
    try
      {
        surface.edge(edge);
      }
    catch (const InvalidParameter &error)
      {
        throw InvalidParameter(parameter + ": " + error.what());
      }
}

} // namespace internal

/// A case that is put together and ready to run.
template <int degree, int spacedim>
class PreparedCase
{
public:
  using Model  = CaseModel<degree, spacedim>;
  using Solver = CaseSolver<Model>;

  PreparedCase(const Environment &env, const Case &prm)
      : env_(env),
        prm_(prm),
        blank_(make_surface<degree, spacedim>(env, prm.surface)),
        surface_(blank_),
        model_(make_model<degree, spacedim>(prm)),
        cracks_(make_cracks(prm, blank_)),
        fine_lines_(make_fine_lines(prm, blank_)),
        space_(env, surface_, prm.surface.continuity.make())
  {
    for (std::size_t i = 0; i < prm.supports.size(); ++i)
      {
        const auto where = "supports." + std::to_string(i);
        internal::check_edges(blank_, where, prm.supports[i].edges);
        internal::check_edges(blank_, where, prm.supports[i].corner);
        prm.supports[i].add_to(supports_, spacedim, where);
      }
    for (std::size_t i = 0; i < prm.loads.size(); ++i)
      {
        const auto where = "loads." + std::to_string(i);
        internal::check_edges(blank_, where, prm.loads[i].edges);
        prm.loads[i].add_to(loads_, prm.material.density, where);
      }
    internal::check_edges(blank_, "output.reactions", prm.output.reactions);
    internal::check_edges(blank_, "stop.crack_at", prm.stop.crack_at);
    recording_.crack    = {.length_scale   = prm.fracture.length_scale,
                           .rayleigh_speed = wave_speeds(model_.split.bulk(), model_.split.shear(), model_.mass).rayleigh,
                           .target_size    = prm.refinement.target};
    recording_.end_time = prm.time.end;
    recording_.frames   = prm.output.frames;
    recording_.points   = internal::make_probes<spacedim>(prm.output);
    recording_.edges    = prm.output.reactions;
    internal::probe_columns(recording_.points, recording_.edges);
    internal::probe_places(blank_, recording_.points);
  }

  /// Builds what a run builds first on the mesh before refinement: formulas, edges and points are evaluated.
  void check()
  {
    Solver                  solver = make_solver();
    State<degree, spacedim> state(space_);
    solver.rebuild(state);
    solver.assembler().evaluate(loads_, 0.);
    for (const auto &support : supports_.list())
      support.displacement(0.);
    const Adaptivity<Model> adaptivity(blank_, prm_.refinement);
    const StepController    controller(prm_.time.steps);
    if (prm_.solver == SolverChoice::arc_length || prm_.solver == SolverChoice::modes)
      refuse_restart(env_);
    if (prm_.solver == SolverChoice::arc_length)
      StaticSolver<Model>(model_, space_, supports_, loads_, prm_.statics).rebuild(state);
    restart_checkpoint(env_, blank_); // with --restart
    on_root(env_.comm(), [&] {
      std::cout << "input is valid: " << prm_.surface.shape << ", " << surface_.n_patches()
                << (surface_.n_patches() == 1 ? " patch" : " patches") << ", degree " << degree << ", "
                << surface_.n_elements() << " elements and " << space_.n_unknowns()
                << " unknowns before refinement; split " << prm_.material.split << " with " << prm_.material.membrane
                << (spacedim == 3 ? " and " + prm_.material.bending : "") << "; " << prm_.time.integrator
                << " up to t = " << prm_.time.end << std::endl;
    });
  }

  /// The run as Case::solver asks.
  void run(const OutputDirectory &directory)
  {
    if (prm_.solver == SolverChoice::arc_length || prm_.solver == SolverChoice::modes)
      run_at_rest(directory);
    else
      run_in_time(directory);
  }

private:
  void run_in_time(const OutputDirectory &directory)
  {
    Solver            solver = make_solver();
    Adaptivity<Model> adaptivity(blank_, prm_.refinement);
    StepController    controller(prm_.time.steps);
    const auto        checkpoint = restart_checkpoint(env_, blank_); // with --restart
    if (prm_.time.largest_step)
      controller.cap(*prm_.time.largest_step);

    State<degree, spacedim> state(space_);
    if (checkpoint)
      resume(*checkpoint, solver, surface_, space_, state, controller);
    else
      {
        prepare(solver, adaptivity, state);
        if (has_inertia())
          solver.set_initial_acceleration(state);
      }
    controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());

    directory.prepare();
    write_parameters(env_, directory.file("used.yaml"), prm_);
    RecordedRun run(env_, directory, blank_, checkpoint, recording_, prm_.checkpoint, solver, space_, state,
                    controller);
    while (state.time < prm_.time.end)
      {
        run.step([&] { return adaptivity.advance(solver, surface_, space_, state, controller, prm_.time.end); });
        if (!prm_.stop.any())
          continue;
        if (const auto reason = reason_to_stop(prm_.stop, space_, state, run.memory()))
          {
            on_root(env_.comm(), [&] { std::cout << *reason << ": the run ends here" << std::endl; });
            return run.finish(*reason);
          }
      }
    run.finish();
  }

  void run_at_rest(const OutputDirectory &directory)
  {
    refuse_restart(env_);
    State<degree, spacedim> state(space_);
    {
      // The cracks there are: the phase of the state at rest.
      Solver            solver = make_solver();
      Adaptivity<Model> adaptivity(blank_, prm_.refinement);
      prepare(solver, adaptivity, state);
    }
    directory.prepare();
    write_parameters(env_, directory.file("used.yaml"), prm_);
    const RestingBody<degree, spacedim> body{env_, model_, surface_, space_, supports_, loads_, state};
    if (prm_.solver == SolverChoice::modes)
      write_modes(body, directory, prm_.modes);
    else
      follow_path(body, directory, prm_.statics, prm_.arc_length, prm_.time.end, prm_.stop.steps, recording_.points,
                  recording_.edges);
  }

  /// The mesh and the state before the first step.
  void prepare(Solver &solver, Adaptivity<Model> &adaptivity, State<degree, spacedim> &state)
  {
    for (std::size_t i = 0; i < fine_lines_.size(); ++i)
      refine_along(surface_, fine_lines_[i], prm_.fine_mesh[i].width, prm_.refinement.target);
    adaptivity.prepare(solver, surface_, space_, state, cracks_);
  }

  bool has_inertia() const { return prm_.time.integrator != "quasi_static"; }

  Solver make_solver()
  {
    const auto bound = has_inertia() ? StepBound::by_waves : StepBound::none;
    switch (prm_.solver)
      {
      case SolverChoice::explicit_:
        return {std::make_unique<ExplicitSolver<Model>>(model_, space_, supports_, loads_, prm_.time.make_explicit(),
                                                        prm_.newton),
                bound};
      case SolverChoice::staggered:
        return {std::make_unique<StaggeredSolver<Model, AnyIntegrator>>(model_, space_, supports_, loads_,
                                                                        prm_.time.make_integrator(), prm_.newton),
                bound};
      case SolverChoice::monolithic:
      case SolverChoice::arc_length:
      case SolverChoice::modes:
        break;
      }
    return {std::make_unique<MonolithicSolver<Model, AnyIntegrator>>(model_, space_, supports_, loads_,
                                                                     prm_.time.make_integrator(), prm_.newton),
            bound};
  }

  Environment                     env_;
  const Case                     &prm_;
  Surface<degree, spacedim>       blank_, surface_;
  Model                           model_;
  PreCrack<spacedim>              cracks_;
  std::vector<Polyline<spacedim>> fine_lines_;
  Supports                        supports_;
  Loads<spacedim>                 loads_;
  ShellSpace<degree, spacedim>    space_;
  RecorderSettings<spacedim>      recording_;
};

template <int degree, int spacedim>
void run_case(const Environment &env, const Case &prm)
{
  const OutputDirectory          directory(env);
  PreparedCase<degree, spacedim> prepared(env, prm);
  if (env.command_line().check)
    return prepared.check();
  prepared.run(directory);
}

} // namespace sherd
