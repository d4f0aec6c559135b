// Step 8: cracks around obstacles
//
// A sheet with a short notch is pulled apart slowly; two regions of it are ten times as tough. The crack that bursts
// out of the notch branches in front of the first one. New here: a toughness that depends on position, and edges that
// move.
//
// Run:     ./step-8 demo.yaml --output output-demo
//          mpirun -np 2 ./step-8 quick.yaml
//          ./step-8 --restart output-demo/checkpoint.h5    (goes on, on any number of ranks)
// Expect:  history.csv, tips.csv, frames in the output directory; pictures by scripts/figures output-demo --animate
// Units:   none: lengths over the side of the sheet, moduli over a reference stiffness E0 [force/length], times over T0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <sherd/adapt/adaptivity.h>
#include <sherd/base/output_directory.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/solve/instances.h>

using namespace sherd;

namespace step_8
{

struct Material
{
  double youngs_modulus = 100.;
  double poissons_ratio = .3;
  double density        = 1.;
  double toughness      = 1e-3;
  double length_scale   = .0025;
  double slope          = 1e-4;

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "E0", range::positive(), "Young's modulus of the sheet");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 1.), "Poisson's ratio of the sheet");
    section.value("density", density, "E0 T0^2/L0^2", range::positive(), "mass by area");
    section.value("toughness", toughness, "E0 L0", range::positive(), "fracture toughness Gc outside the obstacles");
    section.value("length_scale", length_scale, "L0", range::positive(), "length scale l0 of the phase field");
    section.value("slope", slope, "-", range::left_open(0., 1.), "slope s = g'(1) of the degradation, paper Eq. (7)");
  }
};

struct Box
{
  std::array<double, 2> lower = {0., 0.};
  std::array<double, 2> upper = {0., 0.};

  void declare(ParameterSection &section)
  {
    section.value("lower", lower, "L0", range::any(), "lower left corner");
    section.value("upper", upper, "L0", range::any(), "upper right corner");
  }

  // Largest component by which X lies outside; negative inside.
  double distance(const Point<2> &X) const
  {
    return std::max({lower[0] - X[0], X[0] - upper[0], lower[1] - X[1], X[1] - upper[1]});
  }
};

struct Obstacles
{
  std::vector<Box> boxes = {{{.22, .46}, {.30, .54}}, {{.80, .60}, {.90, .84}}};

  double factor     = 10.;
  double transition = 0.;

  void declare(ParameterSection &section)
  {
    section.list("boxes", boxes, "rectangles of higher toughness");
    section.value("factor", factor, "-", range::positive(), "their toughness over that of the rest");
    section.value("transition", transition, "L0", range::non_negative(),
                  "width of the cosine ramp around the outline of a box, half of it outside; 0: a jump");
  }

  // Toughness at X over that of the plain sheet. Where boxes overlap the one that X is deepest in counts.
  double operator()(const Point<2> &X) const
  {
    double distance = std::numeric_limits<double>::infinity();
    for (const auto &box : boxes)
      distance = std::min(distance, box.distance(X));
    if (2. * std::abs(distance) < transition)
      return 1. + (factor - 1.) * .5 * (1. - std::sin(std::numbers::pi * distance / transition));
    return distance > 0. ? 1. : factor;
  }
};

struct Sheet
{
  double                side     = 1.;
  int                   elements = 40;
  std::vector<Point<2>> notch    = {{0., .5}, {.025, .5}};
  double                velocity = .0025;

  void declare(ParameterSection &section)
  {
    section.value("side", side, "L0", range::positive(), "width and height");
    section.value("elements", elements, range::at_least(1), "elements along a side before refinement");
    section.value("notch", notch, "L0", range::any(), "corners of the initial crack, a polyline");
    section.value("velocity", velocity, "L0/T0", range::positive(), "of the top edge upwards, of the bottom downwards");
  }
};

struct TimeSettings
{
  double              end     = 2.5;
  double              rho_inf = .5;
  StepControlSettings steps{.initial = 1e-4};

  void declare(ParameterSection &section)
  {
    section.value("end", end, "T0", range::positive(), "end of the run");
    section.value("rho_inf", rho_inf, "-", range::closed(0., 1.), "spectral radius of generalized-alpha");
    section.subsection("steps", steps, "step sizes, paper Eq. (13)");
  }
};

struct Parameters
{
  Material           material;
  Sheet              sheet;
  Obstacles          obstacles;
  RefinementSettings refinement{.target = .00125, .halo = .01};
  TimeSettings       time;
  NewtonSettings     newton;
  CheckpointSettings checkpoint;
  int                frames = 250;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "the sheet where it is plain");
    section.subsection("sheet", sheet, "geometry and load");
    section.subsection("obstacles", obstacles, "where it is tough");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("time", time, "time integration");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

} // namespace step_8

// The library ships this model compiled: neo-Hooke, split of the surface stretch, cubic degradation, fourth order.
using Model = models::Plate;

void pull_sheet(const Environment &env, const step_8::Parameters &prm)
{
  OutputDirectory directory(env);

  // A sheet: its moduli are per length, and plane stress needs no thickness (theory B.3).
  const auto &material = prm.material;
  const auto &sheet    = prm.sheet;
  const auto  membrane = material::NeoHooke(material::surface_moduli(material.youngs_modulus, material.poissons_ratio));
  const Toughness<2> toughness(
      [plain = material.toughness, obstacles = prm.obstacles](const Point<2> &X) { return plain * obstacles(X); });
  const Model model(split::SurfaceStretch<material::NeoHooke>(membrane), degradation::Cubic(material.slope), {},
                    toughness, material.length_scale, material.density);

  const auto blank   = shapes::plate<2, 2>({sheet.side, sheet.side}, {sheet.elements, sheet.elements});
  auto       surface = blank;
  const auto notch   = PreCrack<2>({Polyline<2>(sheet.notch)}, material.length_scale);

  // Top and bottom move apart; sideways they are free, or the sheet would crack at its corners. Nothing holds it
  // sideways: inertia does.
  ShellSpace<2, 2> space(env, surface);
  const Loads<2>   loads; // none
  Supports         supports;
  supports.prescribe("top", Component::y, [&](double t) { return sheet.velocity * t; });
  supports.prescribe("bottom", Component::y, [&](double t) { return -sheet.velocity * t; });

  MonolithicSolver<Model, GeneralizedAlpha> solver(model, space, supports, loads, GeneralizedAlpha(prm.time.rho_inf),
                                                   prm.newton);
  Adaptivity<Model>                         adaptivity(blank, prm.refinement);
  StepController                            controller(prm.time.steps);
  const auto                                checkpoint = restart_checkpoint(env, blank); // with --restart
  if (env.command_line().check)
    return;

  State<2, 2> state(space);
  if (checkpoint)
    resume(*checkpoint, solver, surface, space, state, controller);
  else
    {
      adaptivity.prepare(solver, surface, space, state, notch);
      solver.set_initial_acceleration(state);
    }
  controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());

  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  const RecorderSettings<2> recording{.crack    = {.length_scale   = material.length_scale,
                                                   .rayleigh_speed = solver.rayleigh_speed(),
                                                   .target_size    = prm.refinement.target},
                                      .end_time = prm.time.end,
                                      .frames   = prm.frames,
                                      .points   = {{"upper_corner", {sheet.side, sheet.side}}},
                                      .edges    = {"top", "bottom"}};

  RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
  while (state.time < prm.time.end)
    run.step([&] { return adaptivity.advance(solver, surface, space, state, controller, prm.time.end); });
  run.finish();
}

int main(int argc, char **argv)
{
  // What a restart may not change: the body, its mesh and its model.
  return run_restartable<step_8::Parameters>(argc, argv, {"material", "sheet", "obstacles", "refinement"}, pull_sheet);
}
