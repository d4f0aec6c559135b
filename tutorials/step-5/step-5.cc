// Step 5: the phase field alone
//
// A crack as a field: how wide it is, what it costs, how its mesh has to be, and what the degradation function makes of
// a body that is loaded evenly. Nothing moves in this step. New here: crack densities, degradation functions, initial
// cracks, and the branch of stable states.
// Run:     ./step-5 demo.yaml --output output-demo
//          mpirun -np 3 ./step-5 quick.yaml
// Expect:  profiles.csv, costs.csv, responses.csv in the output directory; pictures by doc/figures output-demo
// Units:   none: lengths over l0, energies by length over Gc, stresses over (E Gc / l0)^1/2
#include <cmath>
#include <iostream>
#include <optional>

#include <sherd/adapt/adaptivity.h>
#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/driver/case_plate.h>
#include <sherd/fracture/homogeneous.h>
#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/neo_hooke.h>
#include <sherd/material/split/none.h>
#include <sherd/output/csv_table.h>
#include <sherd/time/quasi_static.h>

using namespace sherd;

namespace step_5
{

struct Parameters
{
  double              half_length = 12.;
  double              place       = .0;
  std::vector<double> sizes       = {1., .5, .25, .125};
  int                 samples     = 240;
  NewtonSettings      newton{.displacement_tolerance = 1e-8,
                             .phase_tolerance        = 1e-9,
                             .max_iterations         = 40,
                             .line_search            = {},
                             .alternation            = {},
                             .linear                 = {.preconditioner = Preconditioner::mumps}};

  void declare(ParameterSection &section)
  {
    section.value("half_length", half_length, "l0", range::positive(), "from the middle of the strip to its ends");
    section.value("place", place, "l0", range::any(), "of the crack, from the middle");
    section.value("sizes", sizes, "l0", range::positive(), "element sizes at the crack, coarse to fine");
    section.value("samples", samples, range::at_least(1), "points of a profile");
    section.subsection("newton", newton, "nonlinear and linear solver");
  }
};

struct NamedDensity
{
  std::string        name;
  crack_density::Any density;
};
const std::vector<NamedDensity> densities{{"fourth_order", {crack_density::FourthOrder()}},
                                          {"second_order", {crack_density::SecondOrder()}},
                                          {"at1", {crack_density::AT1()}}};

struct NamedDegradation
{
  std::string      name;
  degradation::Any g;
};
const std::vector<NamedDegradation> degradations{{"quadratic", {degradation::Quadratic()}},
                                                 {"cubic", {degradation::Cubic(1e-4)}},
                                                 {"quartic", {degradation::Quartic()}},
                                                 {"rational", {degradation::Rational(2., -.5)}}};

// A strip with a crack across it, in units of l0 and Gc. With Psi+ = 0 the energy is that of the crack alone,
//
//   Psi_frac = Gc / (4 l0) [w(phi) + c1 |grad phi|^2 + c2 (lap phi)^2]                                 (theory C.1),
//
// and the field that has the least of it with phi = 0 on a line is its profile. Policies are chosen by name at run time
// here; the stiffness of the material has no influence.
struct Strip
{
  using Model  = CaseModel<2, 2>;
  using Solver = MonolithicSolver<Model, AnyIntegrator>;

  Model            model;
  Surface<2, 2>    blank, surface;
  ShellSpace<2, 2> space;
  Supports         supports;
  Loads<2>         loads;
  State<2, 2>      state;
  Solver           solver;

  Strip(const Environment &env, const Parameters &prm, const crack_density::Any &density, double size)
      : model(split::Any<2>(split::None(material::NeoHooke(1., 1.))), degradation::Any(degradation::Quadratic()),
              density, 1., 1., 1.),
        blank(shapes::plate<2, 2>({2. * prm.half_length, 1.}, {static_cast<int>(std::ceil(prm.half_length)), 1})),
        surface(blank),
        space(env, surface),
        state(space),
        solver(model, space, supports, loads, QuasiStatic(), prm.newton)
  {
    // The sides of the strip are planes of symmetry, so that it is a piece of an infinite body. At free edges, where
    // the fourth-order density has lap phi = 0, a crack costs less.
    supports.phase_symmetry("bottom");
    supports.phase_symmetry("top");

    // A crack that is there from the beginning is a history in a narrow strip (theory D): the phase itself would be
    // forgotten in the first step. prepare() refines around it, sets this history and solves for the phase.
    const double      x = prm.half_length + prm.place;
    const PreCrack<2> crack({Polyline<2>({{x, -1.}, {x, 2.}})}, model.length_scale);
    Adaptivity<Model> adaptivity(blank, {.target = size});
    adaptivity.prepare(solver, surface, space, state, crack);
  }
  Strip(const Strip &) = delete;

  double energy() { return solver.energies(state).fracture; }

  // Phase along the middle of the strip. Collective: every rank gets all of it.
  std::vector<double> sample(const std::vector<double> &x) const
  {
    const auto            values = gather(state.phase);
    const Eigen::VectorXd phase  = Eigen::Map<const Eigen::VectorXd>(values.data(), surface.n_control_points());
    const auto           &patch  = surface.patch(0);
    const auto            domain = patch.basis.domain();
    std::vector<double>   result;
    for (const double xi : x)
      {
        const double u = domain.max[0] * xi / surface.control_points().col(0).maxCoeff(), v = .5 * domain.max[1];
        result.push_back(bezier_element<1>(patch, patch.basis.element_at(u, v), phase)(u, v)[0]);
      }
    return result;
  }
};

// Profile and cost of each density on finer and finer elements. The exact profile has the cost 1; what a computation
// adds is its mesh, and the strip in which the history holds the crack open.
void measure_cracks(const Environment &env, const Parameters &prm, const OutputDirectory &directory)
{
  std::optional<CsvTable> profiles, costs;
  on_root(env.comm(), [&] {
    profiles.emplace(directory.file("profiles.csv"), std::vector<std::string>{"density", "distance", "phase", "exact"});
    costs.emplace(directory.file("costs.csv"),
                  std::vector<std::string>{"density", "size", "elements", "cost", "smallest_phase", "largest_phase"});
  });
  std::vector<double> x;
  for (int k = 0; k < prm.samples; ++k)
    x.push_back((k + .5) / prm.samples * 2. * prm.half_length);

  for (const auto &[name, density] : densities)
    for (std::size_t i = 0; i < prm.sizes.size(); ++i)
      {
        Strip        strip(env, prm, density, prm.sizes[i]);
        const auto   phase = strip.sample(x);
        const double cost  = strip.energy();
        on_root(env.comm(), [&, &name = name, &density = density] {
          costs->append(CsvRow() << name << prm.sizes[i] << strip.surface.n_elements() << cost
                                 << *std::min_element(phase.begin(), phase.end())
                                 << *std::max_element(phase.begin(), phase.end()));
          std::cout << name << ", h = " << prm.sizes[i] << " l0: " << strip.surface.n_elements()
                    << " elements, a crack costs " << cost << " Gc" << std::endl;
          if (i + 1 == prm.sizes.size())
            for (std::size_t k = 0; k < x.size(); ++k)
              {
                const double distance = x[k] - prm.half_length - prm.place;
                profiles->append(CsvRow() << name << distance << phase[k] << density.profile(std::abs(distance)));
              }
        });
      }
}

// A body that is stretched evenly, E = 1 and eps the strain: Psi+ = eps^2 / 2, and the phase solves
//
//   2 l0/Gc g'(phi) Psi+ + w'(phi)/2 = 0                                                                (theory C.3),
//
// the same for all elements: no mesh is needed. The stress g eps has a peak, the strength of the material, and where
// damage begins is a matter of g'(1): at once for the quadratic function, at a threshold for the cubic one. There the
// intact state phi = 1 stays a solution and loses its stability, and Newton's method stays with it (theory C.2):
// homogeneous_phase() looks for the stable one.
void measure_responses(const Environment &env, const OutputDirectory &directory)
{
  on_root(env.comm(), [&] {
    CsvTable responses(directory.file("responses.csv"), {"density", "degradation", "strain", "phase", "g", "stress"});
    for (const auto &[density_name, density] : densities)
      {
        // Second and fourth order have the same w. AT1 has a threshold of its own, made for a slope g'(1) of order 1.
        if (density_name == "second_order")
          continue;
        for (const auto &[name, g] : degradations)
          {
            if (density_name == "at1" && (name == "cubic" || name == "quartic"))
              continue;
            double peak = 0., at = 0.;
            for (int k = 0; k <= 1000; ++k)
              {
                const double strain = 1.5 * k / 1000., energy = .5 * strain * strain;
                const double phase = homogeneous_phase(g, density, energy, 1., 1.), stress = g.value(phase) * strain;
                if (stress > peak)
                  {
                    peak = stress;
                    at   = strain;
                  }
                if (k % 5 == 0)
                  responses.append(CsvRow() << density_name << name << strain << phase << g.value(phase) << stress);
              }
            std::cout << density_name << " with " << name << ": strength " << peak << " at the strain " << at
                      << std::endl;
          }
      }
  });
}

void draw_the_field(const Environment &env, const Parameters &prm)
{
  refuse_restart(env);
  OutputDirectory directory(env);
  if (env.command_line().check)
    return;
  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  measure_cracks(env, prm, directory);
  measure_responses(env, directory);
}

} // namespace step_5

int main(int argc, char **argv)
{
  return run<step_5::Parameters>(argc, argv, step_5::draw_the_field);
}
