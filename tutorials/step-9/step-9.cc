// Step 9: write your own split in thirty lines
//
// A split says which part of the elastic energy drives a crack. Here is one that the library does not have, for cracks
// with rough faces; it is proved in one line, compared with its shipped relatives by the stresses at which damage
// starts, and breaks the plate of step-7.
// Run:     ./step-9 demo.yaml --output output-demo
//          mpirun -np 3 ./step-9 quick.yaml
// Expect:  strength.csv, history.csv, tips.csv, frames in the output directory; pictures by doc/figures output-demo and
//          scripts/figures output-demo
// Units:   m, s, kg, N; energies in J per metre of thickness
#include <cmath>
#include <numbers>
#include <sstream>

#include <sherd/adapt/adaptivity.h>
#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/driver/case_plate.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>
#include <sherd/material/st_venant_kirchhoff.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/time/generalized_alpha.h>
#include <sherd/verify/split.h>

using namespace sherd;

namespace step_9
{

// A crack with rough faces can open, and it can slip only if it opens with the slip: what it takes away from the strain
// E is a strain P with tr P >= beta |dev P|. The energy that it cannot take away is that of the strain left over by the
// best such P, and this is passive:
//
//   Psi- = min_P K/2 (tr E - tr P)^2 + G |dev E - dev P|^2,   Psi+ = Psi - Psi-.
//
// With t = tr E and e = |dev E| the minimum is found by projecting on a cone:
//
//   open,     t >= beta e:           P = E, everything is active;
//   stuck,    beta K t + 2 G e <= 0: P = 0, nothing is;
//   sliding:  Psi+ = m/2 (beta K t + 2 G e)^2,  Psi- = m K G (t - beta e)^2  with  m = 1 / (beta^2 K + 2 G).
//
// Energies and stresses are continuous from case to case. For beta = 0 this is the split into change of area and
// distortion, split::VolumetricDeviatoricLayer; after it come materials that bear more and more under pressure, and
// from beta = sqrt(2) on uniaxial compression drives no crack at all. This is Drucker and Prager's strength in a phase
// field, after De Lorenzis and Maurini (2022).
class RoughFaces
{
public:
  RoughFaces(const material::Moduli &moduli, double dilatancy) : moduli_(moduli), beta_(dilatancy) {}

  double bulk() const { return moduli_.bulk; }
  double shear() const { return moduli_.shear; }

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    // In an orthonormal frame of the reference surface, components (11, 22, 12): no indices up and down.
    const double         K = moduli_.bulk, G = moduli_.shear, beta = beta_;
    const Voigt          E = cartesian_strain(point), one(1., 1., 0.);
    const double         t = E[0] + E[1], half = .5 * (E[0] - E[1]), e = std::sqrt(2. * (half * half + E[2] * E[2]));
    const Voigt          deviator(half, -half, E[2]);
    const Voigt4         projector{{.5, -.5, 0.}, {-.5, .5, 0.}, {0., 0., .5}}; // on deviators
    const StrainResponse whole{.5 * K * t * t + G * e * e, K * t * one + 2. * G * deviator,
                               K * one * one.transpose() + 2. * G * projector};

    StrainParts parts = StrainParts::zero();
    if (t >= beta * e - strain_tolerance)
      parts.active = whole;
    else if (beta * K * t + 2. * G * e <= 0.)
      parts.passive = whole;
    else
      {
        const double m = 1. / (beta * beta * K + 2. * G), y = beta * K * t + 2. * G * e;
        const double c = 2. * m * K * G, z = t - beta * e;
        const Voigt  N = deviator / e, a = beta * K * one + 2. * G * N, p = one - beta * N; // N = de/dE
        const Voigt4 turn = (projector - N * N.transpose()) / e;                            // dN/dE
        parts.active      = {.5 * m * y * y, m * y * a, m * (a * a.transpose() + 2. * G * y * turn)};
        parts.passive     = {.5 * c * z * z, c * z * p, c * (p * p.transpose() - beta * z * turn)};
      }
    return membrane_response(point.reference.frame, parts);
  }

private:
  material::Moduli moduli_;
  double           beta_;
};

// If a member were missing, the compiler would name it here.
static_assert(EnergySplit<RoughFaces, 2>);

struct Material
{
  double youngs_modulus = 32e9;
  double poissons_ratio = .2;
  double density        = 2450.;
  double toughness      = 3.;
  double length_scale   = .75e-3;
  double slope          = 1e-4;
  double dilatancy      = .8;

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "Pa", range::positive(), "Young's modulus");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., .5), "Poisson's ratio; plane strain");
    section.value("density", density, "kg/m^3", range::positive(), "mass density");
    section.value("toughness", toughness, "J/m^2", range::positive(), "fracture toughness Gc");
    section.value("length_scale", length_scale, "m", range::positive(), "length scale l0 of the phase field");
    section.value("slope", slope, "-", range::left_open(0., 1.), "slope s = g'(1) of the degradation");
    section.value("dilatancy", dilatancy, "-", range::non_negative(), "beta: opening of a crack by its slip");
  }
};

struct Parameters
{
  Material              material;
  std::array<double, 2> size     = {.1, .04};
  std::array<int, 2>    elements = {68, 28};
  std::vector<Point<2>> notch    = {{0., .02}, {.05, .02}};
  double                traction = 1.2e6;
  double                end      = 65e-6;
  StepControlSettings   steps{.initial = 1e-7};
  RefinementSettings    refinement{.target = .375e-3, .halo = 2.5e-3};
  NewtonSettings        newton;
  CheckpointSettings    checkpoint;
  int                   frames = 26;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "the glass");
    section.value("size", size, "m", range::positive(), "width and height of the plate");
    section.value("elements", elements, range::at_least(1), "elements along width and height before refinement");
    section.value("notch", notch, "m", range::any(), "corners of the initial crack, a polyline");
    section.value("traction", traction, "Pa", range::any(), "pulls top and bottom edge apart from t = 0 on");
    section.value("end", end, "s", range::positive(), "end of the run");
    section.subsection("steps", steps, "step sizes, paper Eq. (13)");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

// The proof. Every derivative of the split is compared with difference quotients at random states, energies must not be
// negative nor depend on coordinates; see what the report says of a wrong sign.
void prove(const RoughFaces &split)
{
  const auto report = verify::split(split);
  if (!report.passed())
    {
      std::ostringstream text;
      text << "step-9: the split does not do what it says\n" << report;
      throw Error(text.str());
    }
}

// At which stresses does damage start? In the direction `angle` of the plane of principal strains the active energy of
// a unit strain is Psi+; a strain sqrt(Psi_0 / Psi+) times as large has the energy Psi_0 that damages. Stresses here
// are over that of uniaxial tension; a split that has no active energy in a direction bears everything there.
template <class Split>
void write_strength(CsvTable &table, const std::string &name, const Split &split)
{
  const auto at = [&](double strain_1, double strain_2) {
    constexpr double small     = 1e-6; // strain, so that all laws are linear
    const Metric     reference = metric(Voigt(1., 1., 0.));
    return split.respond(SurfacePoint<2>(ReferencePoint<2>(reference),
                                         metric(Voigt(1. + 2. * small * strain_1, 1. + 2. * small * strain_2, 0.))));
  };
  const double  nu       = (split.bulk() - split.shear()) / (split.bulk() + split.shear());
  const auto    uniaxial = at(1., -nu);
  const double  limit    = uniaxial.energy_active;
  const double  unit     = (uniaxial.stress_active + uniaxial.stress_passive).membrane[0];
  constexpr int n        = 72;
  for (int k = 0; k < n; ++k)
    {
      const double angle    = 2. * std::numbers::pi * k / n;
      const auto   response = at(std::cos(angle), std::sin(angle));
      if (response.energy_active <= 1e-9 * limit)
        continue;
      const Voigt stress = std::sqrt(limit / response.energy_active) / unit *
                           (response.stress_active + response.stress_passive).membrane;
      table.append(CsvRow() << name << angle << stress[0] << stress[1]);
    }
}

void write_strengths(const std::filesystem::path &file, const material::Moduli &moduli)
{
  CsvTable table(file, {"split", "angle", "stress_1", "stress_2"});
  write_strength(table, "none", split::None(material::StVenantKirchhoff(moduli)));
  write_strength(table, "spectral", split::SpectralMembrane(moduli));
  write_strength(table, "volumetric_deviatoric", split::VolumetricDeviatoricLayer(moduli));
  for (const double beta : {0., .4, .8, 1.2, 1.6})
    write_strength(table, "rough " + print(beta), RoughFaces(moduli, beta));
}

// From here on nothing knows whose split it is. The type below takes any of them at run time, those of users too, and
// the library has its element loop compiled: this program is built in seconds. Written into the type,
//   BrittleShell<2, 2, RoughFaces, degradation::Cubic, crack_density::FourthOrder>,
// it is compiled for this split alone, which takes a minute and makes the loop faster.
using Plate = CaseModel<2, 2>;

void break_plate(const Environment &env, const Parameters &prm)
{
  OutputDirectory  directory(env);
  const auto      &m      = prm.material;
  const auto       moduli = material::plane_strain_moduli(m.youngs_modulus, m.poissons_ratio);
  const RoughFaces split(moduli, m.dilatancy);
  prove(split);
  const Plate model(split::Any<2>(split), degradation::Any(degradation::Cubic(m.slope)),
                    crack_density::Any(crack_density::FourthOrder()), m.toughness, m.length_scale, m.density);

  const auto       blank = shapes::plate<2, 2>(prm.size, prm.elements);
  auto             plate = blank;
  ShellSpace<2, 2> space(env, plate);
  Supports         supports;
  Loads<2>         loads;
  loads.traction("top", [&](const Point<2> &, double) { return Point<2>(0., prm.traction); });
  loads.traction("bottom", [&](const Point<2> &, double) { return Point<2>(0., -prm.traction); });

  MonolithicSolver<Plate, AnyIntegrator> solver(model, space, supports, loads, GeneralizedAlpha(), prm.newton);
  Adaptivity<Plate>                      adaptivity(blank, prm.refinement);
  StepController                         controller(prm.steps);
  const auto                             checkpoint = restart_checkpoint(env, blank);
  if (env.command_line().check)
    return;

  State<2, 2> state(space);
  if (checkpoint)
    resume(*checkpoint, solver, plate, space, state, controller);
  else
    {
      adaptivity.prepare(solver, plate, space, state, PreCrack<2>({Polyline<2>(prm.notch)}, m.length_scale));
      solver.set_initial_acceleration(state);
    }
  controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());

  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  on_root(env.comm(), [&] { write_strengths(directory.file("strength.csv"), moduli); });
  const RecorderSettings<2> recording{.crack    = {.length_scale   = m.length_scale,
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

} // namespace step_9

int main(int argc, char **argv)
{
  return run_restartable<step_9::Parameters>(
      argc, argv, {"material", "size", "elements", "notch", "traction", "refinement"}, step_9::break_plate);
}
