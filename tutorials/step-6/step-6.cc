// Step 6: a notched plate under slow loads
//
// The single-edge-notched square of the literature, in tension and in shear: reactions, peak loads and crack paths that
// many have published. New here: loading so slow that inertia does not count, and what to do when the crack does not
// wait for it; policies that are chosen by name at run time.
// Run:     ./step-6 demo.yaml --output output-tension
//          ./step-6 shear.yaml --output output-shear
//          mpirun -np 3 ./step-6 quick.yaml
// Expect:  probes.csv (reactions), history.csv, frames in the output directory; pictures by doc/figures output-tension
//          and scripts/figures output-tension
// Units:   mm, kN, s; energies in kN mm = J by mm of thickness
#include <optional>

#include <sherd/adapt/adaptivity.h>
#include <sherd/adapt/refine_along.h>
#include <sherd/base/output_directory.h>
#include <sherd/driver/case_plate.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>
#include <sherd/material/st_venant_kirchhoff.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/time/backward_euler.h>
#include <sherd/time/quasi_static.h>

using namespace sherd;

namespace step_6
{

enum class Loading
{
  tension,
  shear
};
enum class Notch
{
  slit, ///< in the geometry: two edges without traction
  crack ///< a crack of the phase field that is there from the start
};
enum class Split
{
  none,
  spectral,
  volumetric_deviatoric
};
enum class Method
{
  staggered,  ///< equilibrium in each step, displacement and phase in turn
  monolithic, ///< equilibrium, both together
  damped      ///< both together, with inertia by backward Euler
};

struct Material
{
  double lambda       = 121.15;
  double mu           = 80.77;
  double density      = 7.8e-12;
  double toughness    = 2.7e-3;
  double length_scale = 7.5e-3;
  double residual     = 1e-8;
  Split  split        = Split::spectral;

  void declare(ParameterSection &section)
  {
    section.value("lambda", lambda, "kN/mm^2", range::positive(), "first constant of Lame; plane strain");
    section.value("mu", mu, "kN/mm^2", range::positive(), "shear modulus");
    section.value("density", density, "kN s^2/mm^4", range::positive(), "mass density");
    section.value("toughness", toughness, "kN/mm", range::positive(), "fracture toughness Gc");
    section.value("length_scale", length_scale, "mm", range::positive(), "l0; most authors give 2 l0");
    section.value("residual", residual, "-", range::non_negative(), "share of the stiffness that a crack keeps");
    section.choice(
        "split", split,
        {{"none", Split::none}, {"spectral", Split::spectral}, {"volumetric_deviatoric", Split::volumetric_deviatoric}},
        "which part of the energy drives the crack");
  }
};

struct Parameters
{
  Material              material;
  Loading               loading      = Loading::tension;
  Notch                 notch        = Notch::slit;
  double                side         = 1.;
  std::array<int, 2>    elements     = {18, 18};
  Method                method       = Method::staggered;
  double                speed        = 1e-2;
  double                end          = .65;
  double                largest_step = 1e-2;
  StepControlSettings   steps{.initial = 1e-2};
  RefinementSettings    refinement{.target = 3.75e-3, .phase = .85, .phase_with = .9, .history_fraction = 1.};
  std::vector<Point<2>> path;
  double                path_width = 1.8e-2;
  NewtonSettings        newton;
  CheckpointSettings    checkpoint;
  int                   frames = 13;

  // Static systems defeat incomplete factors, and at the peak displacement and phase take many turns.
  Parameters()
  {
    newton.linear.preconditioner        = Preconditioner::mumps;
    newton.alternation.max_alternations = 1000;
  }

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "steel, linear elastic");
    section.choice("loading", loading, {{"tension", Loading::tension}, {"shear", Loading::shear}},
                   "how the upper edge moves");
    section.choice("notch", notch, {{"slit", Notch::slit}, {"crack", Notch::crack}},
                   "a slit between patches of the plate or a crack of the phase field");
    section.value("side", side, "mm", range::positive(), "of the square; the notch runs from the left to the centre");
    section.value("elements", elements, range::at_least(1), "elements along both sides before refinement");
    section.choice("method", method,
                   {{"staggered", Method::staggered}, {"monolithic", Method::monolithic}, {"damped", Method::damped}},
                   "equilibrium in each step by one of two solvers, or inertia damped by backward Euler");
    section.value("speed", speed, "mm/s", range::positive(), "of the upper edge");
    section.value("end", end, "s", range::positive(), "end of the run");
    section.value("largest_step", largest_step, "s", range::positive(), "largest step");
    section.subsection("steps", steps, "step sizes, paper Eq. (13)");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.value("path", path, "mm", range::any(), "where the crack is expected, a polyline: fine from the start");
    section.value("path_width", path_width, "mm", range::non_negative(), "how far from it the mesh is fine");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

// One compiled kernel serves all policies that have a name: the split, the degradation function and the crack density
// are objects here, not types. A program that needs only one of each names it in the type and is faster (step-7).
using Plate = CaseModel<2, 2>;

split::Any<2> make_split(const Material &material)
{
  // Plane strain by unit thickness: K = lambda + mu, G = mu (theory B.3).
  const material::Moduli moduli{material.lambda + material.mu, material.mu};
  switch (material.split)
    {
    case Split::none:
      return split::None(material::StVenantKirchhoff(moduli));
    case Split::spectral:
      return split::SpectralMembrane<>(moduli);
    default:
      return split::VolumetricDeviatoricLayer<2>(moduli);
    }
}

// A slit is a line along which patches are not joined. Where it ends, four patches share a corner.
Surface<2, 2> make_blank(const Parameters &prm)
{
  if (prm.notch == Notch::slit)
    return shapes::notched_plate<2, 2>({prm.side, prm.side}, {.5 * prm.side, .5 * prm.side}, prm.elements);
  return shapes::plate<2, 2>({prm.side, prm.side}, prm.elements);
}

// The other notch is a crack as it looks when it has grown: the phase ahead of its end is below 1 from the start.
std::vector<Polyline<2>> initial_cracks(const Parameters &prm)
{
  if (prm.notch == Notch::slit)
    return {};
  return {Polyline<2>({{0., .5 * prm.side}, {.5 * prm.side, .5 * prm.side}})};
}

// The lower edge is held. In shear the sides may not move up or down either, as in the publications.
Supports make_supports(const Parameters &prm)
{
  Supports   supports;
  const auto moved = [speed = prm.speed](double t) { return speed * t; };
  if (prm.loading == Loading::shear)
    for (const auto edge : {"left", "right"})
      supports.fix(edge, Component::y);
  supports.fix("bottom");
  supports.fix("top");
  supports.prescribe("top", prm.loading == Loading::tension ? Component::y : Component::x, moved);
  return supports;
}

// The program for one type of solver; everything else is the same for all of them.
template <class Solver>
void load_plate(const Environment &env, const Parameters &prm, const AnyIntegrator &integrator)
{
  OutputDirectory directory(env);

  // What the publications use: the second-order density, whose length is 2 l0 here, and the quadratic function, which
  // needs no check for false branches. A remainder of the stiffness keeps the matrix regular when the plate has parted.
  const auto &material = prm.material;
  const Plate model(make_split(material), degradation::Any(degradation::Quadratic(), material.residual),
                    crack_density::Any(crack_density::SecondOrder()), material.toughness, material.length_scale,
                    material.density);

  // Patches share values where they are joined. In the plane, with a density that has no second derivatives, no more is
  // asked for: continuity::None.
  const auto        blank = make_blank(prm);
  auto              plate = blank;
  ShellSpace<2, 2>  space(env, plate, continuity::None());
  const auto        supports = make_supports(prm);
  const Loads<2>    loads;
  const PreCrack<2> cracks(initial_cracks(prm), material.length_scale);

  Solver            solver(model, space, supports, loads, integrator, prm.newton);
  Adaptivity<Plate> adaptivity(blank, prm.refinement);

  // The usual bound of steps, one element at 0.6 c_R, would take a million of them to the peak: a longer one is wanted.
  auto steps    = prm.steps;
  steps.courant = prm.largest_step / prm.refinement.target * .6 *
                  wave_speeds(model.split.bulk(), model.split.shear(), model.mass).rayleigh;
  StepController controller(steps);
  const auto     checkpoint = restart_checkpoint(env, blank);
  if (env.command_line().check)
    return;

  State<2, 2> state(space);
  if (checkpoint)
    resume(*checkpoint, solver, plate, space, state, controller);
  else
    {
      // In an unstable step the crack does not wait for the mesh.
      if (!prm.path.empty())
        refine_along(plate, Polyline<2>(prm.path), prm.path_width, prm.refinement.target);
      adaptivity.prepare(solver, plate, space, state, cracks);
      controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());
    }

  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  const RecorderSettings<2> recording{.crack    = {.length_scale   = material.length_scale,
                                                   .rayleigh_speed = solver.rayleigh_speed(),
                                                   .target_size    = prm.refinement.target},
                                      .end_time = prm.end,
                                      .frames   = prm.frames,
                                      .points   = {},
                                      .edges    = {"top", "bottom"},
                                      .times    = {},
                                      .loads    = {}};
  RecordedRun run(env, directory, blank, checkpoint, recording, prm.checkpoint, solver, space, state, controller);
  while (state.time < prm.end)
    run.step([&] { return adaptivity.advance(solver, plate, space, state, controller, prm.end); });
  run.finish();
}

// Without inertia time only orders the loads, and the solver has to find the next equilibrium by itself. Up to the peak
// it is nearby. There the crack runs through the plate while the load stands still: the next equilibrium is that of a
// parted plate, and Newton's method, for which the energy of both fields together is not convex, is not expected
// to get there. Displacement and phase in turn do: each half is a convex problem, and hundreds of turns carry the crack
// through.
//
// The other way out is that of nature: with inertia there is always a next state. Backward Euler damps all that is fast
// against the step, so that large steps see no waves and stay in equilibrium, while at the peak the steps shrink to the
// time that a crack takes.
void choose_method(const Environment &env, const Parameters &prm)
{
  using Together = MonolithicSolver<Plate, AnyIntegrator>;
  using InTurn   = StaggeredSolver<Plate, AnyIntegrator>;
  if (prm.method == Method::staggered)
    load_plate<InTurn>(env, prm, QuasiStatic());
  else if (prm.method == Method::monolithic)
    load_plate<Together>(env, prm, QuasiStatic());
  else
    load_plate<Together>(env, prm, BackwardEuler());
}

} // namespace step_6

int main(int argc, char **argv)
{
  return run_restartable<step_6::Parameters>(
      argc, argv, {"material", "loading", "notch", "side", "elements", "speed", "refinement", "path", "path_width"},
      step_6::choose_method);
}
