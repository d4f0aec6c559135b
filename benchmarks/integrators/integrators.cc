// Time integrators and nonlinear solvers measured against each other: an oscillator, a vibrating shell, the branching
// plate of step-7. benchmarks/integrators/compare runs all of it and writes a report; this program makes one run.
#include <iostream>

#include <sherd/adapt/adaptivity.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/solve/instances.h>

#include "oscillator.h"

using namespace sherd;
using namespace sherd::integrators;

namespace
{

/// The branching plate, step-7 at demo size.
struct PlateSettings
{
  double              length_scale = .75e-3;
  std::array<int, 2>  elements     = {68, 28};
  double              traction     = 1.2e6;
  double              end          = 65e-6;
  int                 frames       = 26;
  RefinementSettings  refinement{.target = .375e-3, .halo = 2.5e-3, .history_fraction = 1.};
  StepControlSettings steps{.initial = 1e-7};

  void declare(ParameterSection &section)
  {
    section.value("length_scale", length_scale, "m", range::positive(), "length scale l0 of the phase field");
    section.value("elements", elements, range::at_least(1), "elements along width and height before refinement");
    section.value("traction", traction, "Pa", range::any(), "pulls top and bottom edge apart from t = 0 on");
    section.value("end", end, "s", range::positive(), "end of the run");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("steps", steps, "step sizes");
  }
};

struct ShellSettings
{
  int    elements = 8;
  double end      = .05;
  int    steps    = 200;

  void declare(ParameterSection &section)
  {
    section.value("elements", elements, range::at_least(2), "elements along a side of the quarter that is computed");
    section.value("end", end, "s", range::positive(), "end of the run");
    section.value("steps", steps, range::at_least(1), "steps of equal size");
  }
};

struct Parameters
{
  std::string        problem = "plate";
  std::string        scheme  = "generalized_alpha_0.5";
  Method             method  = Method::newton;
  double             damping = 0.;
  PlateSettings      plate;
  ShellSettings      shell;
  NewtonSettings     newton;
  CheckpointSettings checkpoint;

  void declare(ParameterSection &section)
  {
    std::vector<std::string> names;
    for (const auto &scheme : schemes())
      names.push_back(scheme.name);
    section.choice("problem", problem, std::vector<std::string>{"oscillator", "shell", "plate"}, "what is computed");
    section.choice("scheme", scheme, names, "implicit integrator; nothing to method: explicit");
    section.choice("method", method, methods(), "how the system of a step is solved");
    section.value("damping", damping, "-", range::right_open(0., 1.),
                  "share of critical damping, of the explicit method");
    section.subsection("plate", plate, "the branching plate");
    section.subsection("shell", shell, "the vibrating shell");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
  }
};

AnyIntegrator integrator_of(const Parameters &prm)
{
  for (const auto &scheme : schemes())
    if (scheme.name == prm.scheme)
      return scheme.integrator;
  throw InvalidParameter("scheme = " + prm.scheme + " is unknown");
}

NewtonSettings newton_of(const Parameters &prm)
{
  auto newton = prm.newton;
  if (prm.method == Method::line_search)
    newton.globalisation = Globalisation::line_search;
  if (prm.method == Method::lagged_history)
    newton.tangent = TangentRule::lagged_history;
  if (prm.method == Method::modified)
    newton.tangent = TangentRule::modified;
  return newton;
}

/// Makes the solver that the method needs and hands it over.
template <class Model, class Use>
void with_solver(const Parameters &prm, const Model &model, const ShellSpace<Model::degree, Model::spacedim> &space,
                 const Supports &supports, const Loads<Model::spacedim> &loads, const Use &use)
{
  const auto newton = newton_of(prm);
  if (prm.damping != 0. && prm.method != Method::explicit_scheme)
    throw InvalidParameter("damping is given, but belongs to method = explicit; leave it out");
  if (prm.method == Method::explicit_scheme)
    {
      ExplicitSolver<Model> solver(model, space, supports, loads, CentralDifference(prm.damping), newton);
      use(solver);
    }
  else if (prm.method == Method::staggered)
    {
      StaggeredSolver<Model, AnyIntegrator> solver(model, space, supports, loads, integrator_of(prm), newton);
      use(solver);
    }
  else
    {
      MonolithicSolver<Model, AnyIntegrator> solver(model, space, supports, loads, integrator_of(prm), newton);
      use(solver);
    }
}

void break_plate(const Environment &env, const Parameters &prm)
{
  OutputDirectory     directory(env);
  const auto         &settings = prm.plate;
  const double        density  = 2450.;
  const auto          membrane = material::NeoHooke(material::plane_strain_moduli(32e9, .2));
  const models::Plate glass(split::SurfaceStretch<material::NeoHooke>(membrane), degradation::Cubic(1e-4), {},
                            Toughness<2>(3.), settings.length_scale, density);
  const auto          blank = shapes::plate<2, 2>({.1, .04}, settings.elements);
  auto                plate = blank;
  const PreCrack<2>   notch({Segment<2>{{0., .02}, {.05, .02}}}, settings.length_scale);
  ShellSpace<2, 2>    space(env, plate);
  const Supports      supports;
  Loads<2>            loads;
  loads.traction("top", [&](const Point<2> &, double) { return Point<2>(0., settings.traction); });
  loads.traction("bottom", [&](const Point<2> &, double) { return Point<2>(0., -settings.traction); });

  with_solver(prm, glass, space, supports, loads, [&](auto &solver) {
    Adaptivity<models::Plate> adaptivity(blank, settings.refinement);
    StepController            controller(settings.steps);
    const auto                checkpoint = restart_checkpoint(env, blank);
    State<2, 2>               state(space);
    if (checkpoint)
      resume(*checkpoint, solver, plate, space, state, controller);
    else
      {
        adaptivity.prepare(solver, plate, space, state, notch);
        solver.set_initial_acceleration(state);
      }
    controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());
    directory.prepare();
    write_parameters(env, directory.file("used.yaml"), prm);
    const RecorderSettings<2> recording{.crack    = {.length_scale   = settings.length_scale,
                                                     .rayleigh_speed = solver.rayleigh_speed(),
                                                     .target_size    = settings.refinement.target},
                                        .end_time = settings.end,
                                        .frames   = settings.frames};
    RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
    while (state.time < settings.end)
      run.step([&] { return adaptivity.advance(solver, plate, space, state, controller, settings.end); });
    run.finish();
  });
}

/// A shallow cylindrical roof with hinged straight edges, at rest and hit by an impulse that starts many modes: its
/// deflection at the centre and at the middle of the free edge over time.
void vibrate_shell(const Environment &env, const Parameters &prm)
{
  OutputDirectory     directory(env);
  const auto         &settings  = prm.shell;
  const double        thickness = 12.7, E = 3102.75, nu = .3, density = 1.2e-9;
  const int           n       = settings.elements;
  const auto          surface = shapes::roof<2>(2540., 508., .1, {n, n}, shapes::Fit::exact, shapes::Part::quarter);
  const auto          laws    = material::neo_hooke_canham_shell(E, nu, thickness);
  const models::Shell shell(split::SurfaceStretch<material::NeoHooke, material::Canham>(laws.membrane, laws.bending,
                                                                                        {.thickness = thickness}),
                            degradation::Cubic(), {}, Toughness<3>(1e9), 100., density * thickness);
  ShellSpace<2, 3>    space(env, surface);
  Supports            supports;
  const Loads<3>      loads;
  supports.fix("top");
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  const auto centre = evaluate(surface, SurfacePlace{0, 1. * n, 0.});
  const auto edge   = evaluate(surface, SurfacePlace{0, 0., 0.});

  with_solver(prm, shell, space, supports, loads, [&](auto &solver) {
    State<2, 3> state(space);
    const auto  X = surface.control_points();
    // Downward speed with a wide profile across the roof and a narrower one along it; zero at the hinges.
    for (int a = 0; a < state.distribution->n_local(); ++a)
      {
        const auto   point                = state.distribution->global(a);
        const double s                    = std::cos(.5 * M_PI * std::min(1., X(point, 1) / (2540. * std::sin(.1))));
        const double r                    = (X(point, 0) - 254.) / 254.;
        state.velocity.local()[3 * a + 2] = -400. * s * s * std::exp(-4. * r * r);
      }
    solver.rebuild(state);
    solver.complete_velocity(state); // the profile is not exactly level at the planes of symmetry
    solver.set_initial_acceleration(state);
    directory.prepare();
    write_parameters(env, directory.file("used.yaml"), prm);
    EnergyBalance           book(solver.energies(state));
    std::optional<CsvTable> table;
    on_root(env.comm(), [&] {
      table.emplace(directory.file("motion.csv"),
                    std::vector<std::string>{"time", "centre", "edge", "elastic", "kinetic", "dissipation", "closure",
                                             "newton", "wall"});
    });
    const auto value_at = [&](const PlaceValues &place) {
      const auto x   = gather(state.position);
      double     sum = 0.;
      for (std::size_t i = 0; i < place.points.size(); ++i)
        sum += place.value[i] * (x[place.points[i] * 3 + 2] - X(place.points[i], 2));
      return sum;
    };
    const double dt     = settings.end / settings.steps;
    int          newton = 0;
    const auto   write  = [&] {
      const double c = value_at(centre), e = value_at(edge);
      on_root(env.comm(), [&] {
        table->append(CsvRow() << state.time << c << e << book.state().now.elastic() << book.state().now.kinetic
                                  << book.dissipation() << book.closure() << newton << env.elapsed_seconds());
      });
    };
    write();
    // Steps of equal size; an explicit scheme divides each into stable ones.
    for (int k = 1; k <= settings.steps; ++k)
      {
        const double end = k * dt;
        while (state.time < end)
          {
            const double left   = end - state.time;
            const double size   = left / std::max(1., std::ceil(left / solver.largest_step() * (1. - 1e-12)));
            auto         result = solver.attempt(state, size);
            if (!result.state)
              throw NoConvergence("vibrating shell at t = " + print(state.time) + ": " + result.failure);
            StepSummary step;
            step.dt            = size;
            step.work          = result.work;
            step.withheld_work = result.withheld_work;
            step.energies      = solver.energies(*result.state);
            book.add(step);
            newton += result.newton;
            state = std::move(*result.state);
            if (size == left)
              state.time = end;
          }
        write();
      }
  });
}

void measure(const Environment &env, const Parameters &prm)
{
  if (prm.problem == "plate")
    break_plate(env, prm);
  else if (prm.problem == "shell")
    vibrate_shell(env, prm);
  else
    {
      OutputDirectory directory(env);
      directory.prepare();
      on_root(env.comm(), [&] { measure_oscillators(directory.path()); });
    }
}

} // namespace

int main(int argc, char **argv)
{
  return run_restartable<Parameters>(argc, argv, {"plate.length_scale", "plate.elements", "plate.refinement"}, measure);
}
