// Step 7: dynamic crack branching
//
// A glass plate with a notch is pulled suddenly. The notch runs, the crack branches. New here: the whole machine, mesh
// and step size following the crack.
// Run:     ./step-7 demo.yaml --output output-demo            (all threads: OMP_NUM_THREADS)
//          mpirun -np 2 ./step-7 quick.yaml
//          ./step-7 --restart output-demo/checkpoint.h5    (goes on, on any number of ranks)
// Expect:  history.csv, tips.csv, frames in the output directory; pictures by scripts/figures output-demo
// Units:   m, s, kg, N; energies in J per metre of thickness
#include <sherd/adapt/adaptivity.h>
#include <sherd/base/formula.h>
#include <sherd/base/output_directory.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/solve/instances.h>
#include <sherd/time/generalized_alpha.h>

using namespace sherd;

namespace step_7
{

// Everything a user may want to change, with the paper's glass as default. `step-7 --help` prints this table.
struct Material
{
  double  youngs_modulus = 32e9;
  double  poissons_ratio = .2;
  double  density        = 2450.;
  double  length_scale   = .25e-3;
  double  slope          = 1e-4;
  Formula toughness      = Formula("3", {"x", "y"});

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "Pa", range::positive(), "Young's modulus of the glass");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., .5), "Poisson's ratio; plane strain");
    section.value("density", density, "kg/m^3", range::positive(), "mass density");
    section.value("toughness", toughness, "J/m^2", "fracture toughness Gc, a formula of the position x, y");
    section.value("length_scale", length_scale, "m", range::positive(), "length scale l0 of the phase field");
    section.value("slope", slope, "-", range::left_open(0., 1.), "slope s = g'(1) of the degradation, paper Eq. (7)");
  }
};

struct Plate
{
  std::array<double, 2> size     = {.1, .04};
  std::array<int, 2>    elements = {100, 40};
  int                   degree   = 2;
  std::vector<Point<2>> notch    = {{0., .02}, {.05, .02}};

  void declare(ParameterSection &section)
  {
    section.value("size", size, "m", range::positive(), "width and height");
    section.value("elements", elements, range::at_least(1), "elements along width and height before refinement");
    section.choice("degree", degree, {{"2", 2}}, "degree of the splines; this program is built for 2");
    section.value("notch", notch, "m", range::any(), "corners of the initial crack, a polyline");
  }
};

struct TimeSettings
{
  double              end     = 80e-6;
  double              rho_inf = .5;
  StepControlSettings steps{.initial = 1e-7};

  void declare(ParameterSection &section)
  {
    section.value("end", end, "s", range::positive(), "end of the run");
    section.value("rho_inf", rho_inf, "-", range::closed(0., 1.), "spectral radius of generalized-alpha");
    section.subsection("steps", steps, "step sizes, paper Eq. (13)");
  }
};

struct Parameters
{
  Material           material;
  Plate              plate;
  double             traction = 1e6;
  RefinementSettings refinement{.target = .125e-3, .halo = 1.e-3};
  TimeSettings       time;
  NewtonSettings     newton;
  CheckpointSettings checkpoint;
  int                frames = 40;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "the glass");
    section.subsection("plate", plate, "the plate");
    section.value("traction", traction, "Pa", range::any(), "pulls top and bottom edge apart from t = 0 on");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("time", time, "time integration");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

} // namespace step_7

// The model is one type. To compare splits or degradation functions change this line; the compiler does the rest.
using Glass =
    BrittleShell<2, 2, split::SurfaceStretch<material::NeoHooke>, degradation::Cubic, crack_density::FourthOrder>;

void break_plate(const Environment &env, const step_7::Parameters &prm)
{
  OutputDirectory directory(env);

  // Plane strain: a slice of unit thickness behaves like a membrane with K = lambda + mu and G = mu (theory B.3).
  const auto &material = prm.material;
  const auto  membrane =
      material::NeoHooke(material::plane_strain_moduli(material.youngs_modulus, material.poissons_ratio));
  const Toughness<2> toughness([Gc = material.toughness](const Point<2> &X) { return Gc(X[0], X[1]); });
  const Glass        glass(split::SurfaceStretch<material::NeoHooke>(membrane), degradation::Cubic(material.slope), {},
                           toughness, material.length_scale, material.density);

  const auto blank = shapes::plate<2, 2>(prm.plate.size, prm.plate.elements);
  auto       plate = blank;
  const auto notch = PreCrack<2>({Polyline<2>(prm.plate.notch)}, material.length_scale);

  // Nothing holds the plate: the two tractions balance each other, and inertia does the rest.
  ShellSpace<2, 2> space(env, plate);
  Supports         supports;
  Loads<2>         loads;
  loads.traction("top", [&](const Point<2> &, double) { return Point<2>(0., prm.traction); });
  loads.traction("bottom", [&](const Point<2> &, double) { return Point<2>(0., -prm.traction); });

  MonolithicSolver<Glass, GeneralizedAlpha> solver(glass, space, supports, loads, GeneralizedAlpha(prm.time.rho_inf),
                                                   prm.newton);
  Adaptivity<Glass>                         adaptivity(blank, prm.refinement);
  StepController                            controller(prm.time.steps);
  const auto                                checkpoint = restart_checkpoint(env, blank); // with --restart
  if (env.command_line().check)
    return;

  // A notch is an initial history, not an initial phase: the mesh is refined around it first (theory D).
  State<2, 2> state(space);
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
  const RecorderSettings<2> recording{.crack    = {.length_scale   = material.length_scale,
                                                   .rayleigh_speed = solver.rayleigh_speed(),
                                                   .target_size    = prm.refinement.target},
                                      .end_time = prm.time.end,
                                      .frames   = prm.frames,
                                      .points   = {{"upper_corner", {prm.plate.size[0], prm.plate.size[1]}}},
                                      .edges    = {"top", "bottom"}};

  // Each step leaves its rows, and now and then a frame and a checkpoint; a signal or --max-wall ends the run between
  // two steps, with a checkpoint.
  RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
  while (state.time < prm.time.end)
    run.step([&] { return adaptivity.advance(solver, plate, space, state, controller, prm.time.end); });
  run.finish();
}

int main(int argc, char **argv)
{
  // What a restart may not change: the body, its mesh and its model.
  return run_restartable<step_7::Parameters>(argc, argv, {"material", "plate", "traction", "refinement"}, break_plate);
}
