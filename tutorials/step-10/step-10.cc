// Step 10: a cylinder tears
//
// A thin tube with an axial notch is inflated until the notch runs. Half of the tube is computed; the other half is its
// mirror image. New here: a shell that bends and moves far, pressure that the crack lets out, symmetry.
// Run:     mpirun -np 2 ./step-10 demo.yaml --output output-demo
//          ./step-10 quick.yaml
//          ./step-10 --restart output-demo/checkpoint.h5   (goes on, on any number of ranks)
// Expect:  history.csv, tips.csv, frames in the output directory; pictures by scripts/figures output-demo
// Units:   any consistent ones; here radius, density by area and time scale are of order 1, and moduli are forces by
//          length (theory B.3)
#include <sherd/adapt/adaptivity.h>
#include <sherd/base/output_directory.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/solve/instances.h>
#include <sherd/time/generalized_alpha.h>

using namespace sherd;

namespace step_10
{

struct Material
{
  double youngs_modulus = 10.;
  double poissons_ratio = .3;
  double thickness      = .01;
  double density        = 1.;
  double toughness      = 5e-4;
  double length_scale   = .04;
  double slope          = 1e-4;

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "force/length", range::positive(), "surface modulus E");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 1.), "Poisson's ratio of the surface");
    section.value("thickness", thickness, "length", range::positive(), "thickness T; bending stiffness c = E T^2/12");
    section.value("density", density, "mass/area", range::positive(), "mass by reference area");
    section.value("toughness", toughness, "force", range::positive(), "fracture toughness Gc, energy by length");
    section.value("length_scale", length_scale, "length", range::positive(), "length scale l0 of the phase field");
    section.value("slope", slope, "-", range::left_open(0., 1.), "slope s = g'(1) of the degradation, paper Eq. (7)");
  }
};

struct Tube
{
  double             radius   = 1.;
  double             length   = 4.;
  double             notch    = .5;
  std::array<int, 2> elements = {50, 40};

  void declare(ParameterSection &section)
  {
    section.value("radius", radius, "length", range::positive(), "radius");
    section.value("length", length, "length", range::positive(), "length between the clamped ends");
    section.value("notch", notch, "length", range::positive(), "length of the axial notch, in the middle");
    section.value("elements", elements, range::at_least(1), "elements along the axis and around half the tube");
  }
};

struct Pressure
{
  double value = .05;
  double rise  = 1.;

  void declare(ParameterSection &section)
  {
    section.value("value", value, "force/area", range::any(), "pressure p0 inside; a crack lets it out: p = p0 phi");
    section.value("rise", rise, "time", range::positive(), "time in which it rises from zero");
  }
};

struct TimeSettings
{
  double              end     = 4.;
  double              rho_inf = .5;
  StepControlSettings steps{.initial = 1e-2};

  void declare(ParameterSection &section)
  {
    section.value("end", end, "time", range::positive(), "end of the run");
    section.value("rho_inf", rho_inf, "-", range::closed(0., 1.), "spectral radius of generalized-alpha");
    section.subsection("steps", steps, "step sizes, paper Eq. (13)");
  }
};

struct Parameters
{
  Material           material;
  Tube               tube;
  Pressure           pressure;
  RefinementSettings refinement{.target = .02, .halo = .16, .history_fraction = 1.};
  TimeSettings       time;
  NewtonSettings     newton;
  CheckpointSettings checkpoint;
  int                frames = 40;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "the sheet");
    section.subsection("tube", tube, "the tube");
    section.subsection("pressure", pressure, "what inflates it");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("time", time, "time integration");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

} // namespace step_10

// The paper's shell: a neo-Hookean membrane with Canham's bending energy, split by the stretch of each layer.
using Sheet = BrittleShell<2, 3, split::SurfaceStretch<material::NeoHooke, material::Canham>, degradation::Cubic,
                           crack_density::FourthOrder>;

Sheet make_sheet(const step_10::Material &prm)
{
  const auto moduli  = material::surface_moduli(prm.youngs_modulus, prm.poissons_ratio);
  const auto bending = material::Canham(prm.youngs_modulus * prm.thickness * prm.thickness / 12.);
  return Sheet({material::NeoHooke(moduli), bending, LayerSettings{.thickness = prm.thickness}},
               degradation::Cubic(prm.slope), {}, Toughness<3>(prm.toughness), prm.length_scale, prm.density);
}

void tear_tube(const Environment &env, const step_10::Parameters &prm)
{
  OutputDirectory directory(env);
  const Sheet     sheet = make_sheet(prm.material);

  // The upper half, X = (x, R sin(angle), R cos(angle)); the notch runs along its crest. A rational arc of half a turn
  // would have lines where it is only C^0, so the circle is interpolated: off by less than 1e-6 of the radius here.
  const auto &tube = prm.tube;
  const auto  blank =
      shapes::cylinder<2>(tube.radius, tube.length, {-M_PI / 2., M_PI / 2.}, tube.elements, shapes::Fit::smooth);
  auto       surface = blank;
  const auto middle  = .5 * tube.length;
  const auto notch   = PreCrack<3>({Polyline<3>({Point<3>(middle - .5 * tube.notch, 0., tube.radius),
                                                 Point<3>(middle + .5 * tube.notch, 0., tube.radius)})},
                                 prm.material.length_scale);

  // The straight edges lie in the plane z = 0, where the other half is the mirror image: no way out of the plane, no
  // rotation, and the phase field meets it at a right angle too (theory G.5). The ends are clamped.
  ShellSpace<2, 3> space(env, surface);
  Supports         supports;
  supports.symmetry("bottom", Component::z);
  supports.symmetry("top", Component::z);
  supports.clamp("left");
  supports.clamp("right");

  // The pressure follows the surface and grows with its area; where the sheet is broken it has nothing to push on.
  Loads<3> loads;
  loads.pressure([&](const Point<3> &, double t) { return prm.pressure.value * std::min(1., t / prm.pressure.rise); },
                 PressureRelease::by_phase);

  MonolithicSolver<Sheet, GeneralizedAlpha> solver(sheet, space, supports, loads, GeneralizedAlpha(prm.time.rho_inf),
                                                   prm.newton);
  Adaptivity<Sheet>                         adaptivity(blank, prm.refinement);
  StepController                            controller(prm.time.steps);
  const auto                                checkpoint = restart_checkpoint(env, blank); // with --restart
  if (env.command_line().check)
    return;

  State<2, 3> state(space);
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
  const RecorderSettings<3> recording{.crack    = {.length_scale   = prm.material.length_scale,
                                                   .rayleigh_speed = solver.rayleigh_speed(),
                                                   .target_size    = prm.refinement.target},
                                      .end_time = prm.time.end,
                                      .frames   = prm.frames,
                                      .points   = {{"side", Point<3>(middle, tube.radius, 0.)}},
                                      .edges    = {"left", "right"}};

  // Each step leaves its rows, and now and then a frame and a checkpoint; a signal or --max-wall ends the run between
  // two steps, with a checkpoint.
  RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
  while (state.time < prm.time.end)
    run.step([&] { return adaptivity.advance(solver, surface, space, state, controller, prm.time.end); });
  run.finish();
}

int main(int argc, char **argv)
{
  // What a restart may not change: the body, its mesh and its model.
  return run_restartable<step_10::Parameters>(argc, argv, {"material", "tube", "pressure", "refinement"}, tear_tube);
}
