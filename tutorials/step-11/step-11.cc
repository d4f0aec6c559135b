// Step 11: a balloon bursts
//
// The paper's second example (its section 3.2): a closed sphere of six patches, inflated suddenly, with three cracks
// in it, about on a great circle. They run, fork, and their branches meet. New here: a surface of many patches, and
// what keeps it smooth across their interfaces.
//
// Run:     mpirun -np 2 ./step-11 demo.yaml --output output-penalty
//          mpirun -np 2 ./step-11 demo.yaml --set balloon.continuity=lagrange_multiplier --output output-multiplier
//          ./step-11 quick.yaml
//          ./step-11 --restart output-penalty/checkpoint.h5   (goes on, on any number of ranks)
// Expect:  history.csv, tips.csv, frames in the output directory; pictures by
//          scripts/figures output-penalty --opacity 0.5 --patch-lines --threshold 0.005
//          scripts/compare-runs output-penalty output-multiplier
// Units:   those of the paper: lengths in L0, moduli in E0 (force by length, theory B.3), time in T0
#include <sherd/adapt/adaptivity.h>
#include <sherd/base/output_directory.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/solve/instances.h>
#include <sherd/time/generalized_alpha.h>

using namespace sherd;

namespace step_11
{

// What of bending the crack takes away.
enum class Bending
{
  active, ///< all of it
  layers  ///< that of the stretched layers, paper Eq. (11)
};

struct Material
{
  double  youngs_modulus    = 10.;
  double  poissons_ratio    = .3;
  double  thickness         = 1e-4;
  double  bending_stiffness = 1e-5;
  Bending bending           = Bending::active;
  double  density           = 1.;
  double  toughness         = 5e-4;
  double  length_scale      = .015;
  double  slope             = 1e-4;

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "E0", range::positive(), "surface modulus E");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 1.), "Poisson's ratio of the surface");
    section.value("thickness", thickness, "L0", range::positive(), "thickness T, of the split of bending alone");
    section.value("bending_stiffness", bending_stiffness, "E0 L0^2", range::positive(), "Canham's c");
    section.choice("bending", bending, {{"active", Bending::active}, {"layers", Bending::layers}},
                   "what of the bending energy is degraded: all, or that of the stretched layers, paper Eq. (11)");
    section.value("density", density, "E0 T0^2/L0^2", range::positive(), "mass by reference area");
    section.value("toughness", toughness, "E0 L0", range::positive(), "fracture toughness Gc");
    section.value("length_scale", length_scale, "L0", range::positive(), "length scale l0 of the phase field");
    section.value("slope", slope, "-", range::left_open(0., 1.), "slope s = g'(1) of the degradation, paper Eq. (7)");
  }
};

enum class Method
{
  none,
  penalty,
  lagrange_multiplier
};

struct Balloon
{
  double radius     = 1.;
  int    elements   = 16;
  Method continuity = Method::penalty;
  double pressure   = .1;

  void declare(ParameterSection &section)
  {
    section.value("radius", radius, "L0", range::positive(), "radius");
    section.value("elements", elements, range::at_least(2), "elements along a side of a patch before refinement");
    section.choice(
        "continuity", continuity,
        {{"none", Method::none}, {"penalty", Method::penalty}, {"lagrange_multiplier", Method::lagrange_multiplier}},
        "what keeps angle and phase smooth across the interfaces of the patches");
    section.value("pressure", pressure, "E0/L0", range::any(), "p0 inside, at once; a crack lets it out: p = p0 phi");
  }

  Continuity method() const
  {
    switch (continuity)
      {
      case Method::penalty:
        return continuity::Penalty{};
      case Method::lagrange_multiplier:
        return continuity::LagrangeMultiplier{};
      case Method::none:
        break;
      }
    return continuity::None{};
  }
};

// An initial crack along a great circle.
struct Crack
{
  std::array<double, 3> centre = {.8, -.57, -.2};
  std::array<double, 3> along  = {.46, .79, -.42};
  double                length = .8;

  void declare(ParameterSection &section)
  {
    section.value("centre", centre, "-", range::any(), "direction of its centre, seen from the centre of the balloon");
    section.value("along", along, "-", range::any(), "direction in which it runs; its part along the sphere counts");
    section.value("length", length, "L0", range::positive(), "arc length");
  }

  Polyline<3> on_sphere(double radius) const
  {
    const Point<3>        out   = Point<3>(centre[0], centre[1], centre[2]).normalized();
    const Point<3>        given = Point<3>(along[0], along[1], along[2]);
    const Point<3>        side  = given - given.dot(out) * out;
    constexpr int         n     = 64; // chords, off the sphere by less than 1e-4 of the length
    std::vector<Point<3>> corners;
    if (!(side.norm() > 1e-6 * given.norm()))
      throw InvalidParameter("crack.along: it points along crack.centre, expected a direction along the sphere there");
    for (int k = 0; k <= n; ++k)
      {
        const double angle = length / radius * (double(k) / n - .5);
        corners.push_back(radius * (std::cos(angle) * out + std::sin(angle) * side.normalized()));
      }
    return Polyline<3>(std::move(corners));
  }
};

struct TimeSettings
{
  double              end     = 2.;
  double              rho_inf = .5;
  StepControlSettings steps{.initial = 1e-3};

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
  Balloon            balloon;
  std::vector<Crack> cracks = {
      Crack{}, {{-.1, .96, -.27}, {-.93, 0., .38}, .8}, {{-.75, -.41, .52}, {.6, -.79, .22}, .8}};
  RefinementSettings refinement{.target = .0075, .halo = .06, .history_fraction = 1.};
  TimeSettings       time;
  NewtonSettings     newton;
  CheckpointSettings checkpoint;
  int                frames = 60;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "the sheet");
    section.subsection("balloon", balloon, "the sphere and what inflates it");
    section.list("cracks", cracks, "what it begins with; an intact balloon does not break (theory J.5)");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("time", time, "time integration");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

} // namespace step_11

// The paper's shell: a neo-Hookean membrane with Canham's bending energy, split by the surface stretch. So stiff a
// bending on so thin a shell makes energy where broken elements flap, if it comes and goes with the stretch of the
// layers (theory B.4); so all of it is active here, which until something is compressed is the same.
using Sheet = BrittleShell<2, 3, split::SurfaceStretch<material::NeoHooke, material::Canham>, degradation::Cubic,
                           crack_density::FourthOrder>;

Sheet make_sheet(const step_11::Material &prm)
{
  const material::NeoHooke membrane(material::surface_moduli(prm.youngs_modulus, prm.poissons_ratio));
  const material::Canham   bending(prm.bending_stiffness);
  const auto               sheet = [&](const auto &share) {
    return Sheet({membrane, bending, share}, degradation::Cubic(prm.slope), {}, Toughness<3>(prm.toughness),
                               prm.length_scale, prm.density);
  };
  if (prm.bending == step_11::Bending::layers)
    return sheet(LayerSettings{.thickness = prm.thickness});
  return sheet(BendingPart::active);
}

void burst_balloon(const Environment &env, const step_11::Parameters &prm)
{
  OutputDirectory directory(env);
  const Sheet     sheet = make_sheet(prm.material);

  // Six faces of a cube, blown up: quadratic NURBS that miss the radius by less than 1e-5 with 8 elements a side.
  const auto               blank   = shapes::sphere<2>(prm.balloon.radius, prm.balloon.elements);
  auto                     surface = blank;
  std::vector<Polyline<3>> cracks;
  for (const auto &crack : prm.cracks)
    cracks.push_back(crack.on_sphere(prm.balloon.radius));
  const PreCrack<3> pre_crack(std::move(cracks), prm.material.length_scale);

  // Patches share the control points of their edges, so that the surface is closed. That it stays smooth there is asked
  // for in weak form: the angle between the normals of two patches and the slope of the phase (theory G). With
  // multipliers each piece of an interface has two unknowns of its own.
  ShellSpace<2, 3> space(env, surface, prm.balloon.method());

  // Nothing holds the balloon: the pressure has no resultant on a closed surface. Where the sheet is broken it has
  // nothing to push on.
  Supports supports;
  Loads<3> loads;
  loads.pressure([&](const Point<3> &, double) { return prm.balloon.pressure; }, PressureRelease::by_phase);

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
      adaptivity.prepare(solver, surface, space, state, pre_crack);
      solver.set_initial_acceleration(state);
    }
  controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());

  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  const double              r = prm.balloon.radius;
  const RecorderSettings<3> recording{.crack    = {.length_scale   = prm.material.length_scale,
                                                   .rayleigh_speed = solver.rayleigh_speed(),
                                                   .target_size    = prm.refinement.target},
                                      .end_time = prm.time.end,
                                      .frames   = prm.frames,
                                      .points   = {{"top", Point<3>(0., 0., r)}, {"bottom", Point<3>(0., 0., -r)}},
                                      .edges    = {}};

  RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
  while (state.time < prm.time.end)
    run.step([&] { return adaptivity.advance(solver, surface, space, state, controller, prm.time.end); });
  run.finish();
}

int main(int argc, char **argv)
{
  // What a restart may not change: the body, its mesh and its model.
  return run_restartable<step_11::Parameters>(argc, argv, {"material", "balloon", "cracks", "refinement"},
                                              burst_balloon);
}
