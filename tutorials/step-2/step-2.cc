// Step 2: linear shells
//
// Four classical shells, each bent in a different way, and the vibrations of a plate, on sequences of meshes and for
// degrees 2, 3 and 4. New here: curvature, symmetry, locking, and how to read an order of convergence.
// Run:     mpirun -np 2 ./step-2 demo.yaml --output output-demo      (half a minute)
//          ./step-2 quick.yaml
// Expect:  convergence.csv, frequencies.csv, frames in the output directory; pictures by doc/figures output-demo
// Units:   those in which each benchmark was published; any consistent ones
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <type_traits>

#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/frames.h>
#include <sherd/solve/instances.h>
#include <sherd/solve/modal_analysis.h>

using namespace sherd;

namespace step_2
{

// One problem on a sequence of meshes.
struct Study
{
  std::string      problem  = "roof";
  std::vector<int> degrees  = {2, 3, 4};
  std::vector<int> elements = {4, 8, 16};

  void declare(ParameterSection &section)
  {
    section.choice("problem", problem, {"roof", "pinched_cylinder", "hemisphere", "closed_hemisphere", "plate"},
                   "roof, cylinder and hemispheres are loaded, the plate vibrates");
    section.value("degrees", degrees, range::closed(2, 4), "degrees of the splines");
    section.value("elements", elements, range::at_least(2), "elements along each side of the meshes");
  }
};

struct Parameters
{
  std::vector<Study> studies = {{}};
  int                modes   = 6;
  double             drawn   = .15;

  void declare(ParameterSection &section)
  {
    section.list("studies", studies, "problems, their degrees and meshes");
    section.value("modes", modes, range::at_least(1), "number of modes of the plate");
    section.value("drawn", drawn, "-", range::positive(),
                  "largest displacement in the frames, which exaggerate, over the length of the shell");
  }
};

// A problem on one mesh. The sheet is Koiter's (theory B.5): an elastic solid so thin that lines normal to its middle
// surface stay straight and normal.
template <int degree>
struct Problem
{
  Surface<degree, 3> surface;
  double             youngs_modulus, poissons_ratio, thickness;
  Supports           supports;
  Loads<3>           loads      = {};
  Point<3>           place      = Point<3>::Zero(); // where the deflection is read
  Point<3>           direction  = Point<3>::Zero(); // and in which direction
  double             deflection = 0., work = 0.;    // converged values of this shell theory, see doc/results.md
};

// Bending across, membrane forces along: a roof under its own weight. Its ends rest on diaphragms, walls that are stiff
// in their plane and give way along x. A quarter is enough.
//
// Symmetry is more than u_normal = 0: the surface must not kink at the plane either. Elements with rotations of their
// own would fix one of them; a spline shell has none, only its tangent can say so. Supports::symmetry ties the first
// row of control points to the second one, so that the edge stays level (theory G.5). This is exact, and costs nothing.
template <int degree>
Problem<degree> roof(int n)
{
  const double R = 25., L = 50., angle = 40. * M_PI / 180.;
  Supports     supports;
  supports.fix("left", Component::y);
  supports.fix("left", Component::z);
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., -90. * t); });
  return {.surface        = shapes::roof<degree>(R, L, angle, {n, n}, shapes::Fit::exact, shapes::Part::quarter),
          .youngs_modulus = 4.32e8,
          .poissons_ratio = 0.,
          .thickness      = .25,
          .supports       = supports,
          .loads          = loads,
          .place          = {.5 * L, R * std::sin(angle), R * std::cos(angle)},
          .direction      = {0., 0., -1.},
          .deflection     = .3005924567,
          .work           = 2413.288517};
}

// Two opposite forces pinch a cylinder with a diaphragm at either end. All that happens is near the force, and there
// the solution is not smooth. Three planes of symmetry leave an octant, and a quarter of the force.
template <int degree>
Problem<degree> pinched_cylinder(int n)
{
  const double R = 300., L = 600.;
  Supports     supports;
  supports.fix("left", Component::y);
  supports.fix("left", Component::z);
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  supports.symmetry("top", Component::z);
  Loads<3> loads;
  loads.point_load({.5 * L, 0., R}, [](double t) { return Point<3>(0., 0., -.25 * t); });
  return {.surface        = shapes::cylinder<degree>(R, .5 * L, {0., .5 * M_PI}, {n, n}),
          .youngs_modulus = 3e6,
          .poissons_ratio = .3,
          .thickness      = 3.,
          .supports       = supports,
          .loads          = loads,
          .place          = {.5 * L, 0., R},
          .direction      = {0., 0., -1.},
          .deflection     = 1.82820e-5,
          .work           = .25 * 1.82820e-5};
}

// Bending with hardly any membrane strain: under two pairs of forces a hemisphere with a free rim gives way as a sheet
// of paper does, and a mesh that cannot bend without stretching is far too stiff. Nothing but symmetry holds the
// quarter in x and y; one corner holds it in z, where no force acts. The hole of half a degree is a stand-in for none
// at all.
template <int degree>
Problem<degree> hemisphere(int n, double hole, double deflection)
{
  const double R = 10.;
  Supports     supports;
  supports.symmetry("left", Component::y);
  supports.symmetry("right", Component::x);
  supports.fix(Corner{"right", "equator"}, Component::z);
  Loads<3> loads;
  loads.point_load({R, 0., 0.}, [](double t) { return Point<3>(t, 0., 0.); });
  loads.point_load({0., R, 0.}, [](double t) { return Point<3>(0., -t, 0.); });
  return {.surface        = shapes::hemisphere_with_hole<degree>(R, hole * M_PI / 180., {0., .5 * M_PI}, {n, n}),
          .youngs_modulus = 6.825e7,
          .poissons_ratio = .3,
          .thickness      = .04,
          .supports       = supports,
          .loads          = loads,
          .place          = {R, 0., 0.},
          .direction      = {1., 0., 0.},
          .deflection     = deflection,
          .work           = 2. * deflection};
}

// A square plate of flexural rigidity and mass one. Its edges can turn but not move. It is so thin that modes that
// stretch it are far above those that bend it.
template <int degree>
Problem<degree> plate(int n)
{
  const double nu = .3, T = .01;
  Supports     supports;
  for (const auto *edge : {"left", "right", "bottom", "top"})
    supports.fix(edge);
  return {.surface        = shapes::plate<degree, 3>({1., 1.}, {n, n}),
          .youngs_modulus = 12. * (1. - nu * nu) / (T * T * T),
          .poissons_ratio = nu,
          .thickness      = T,
          .supports       = supports};
}

template <int degree>
Problem<degree> make_problem(const std::string &name, int n)
{
  if (name == "roof")
    return roof<degree>(n);
  if (name == "pinched_cylinder")
    return pinched_cylinder<degree>(n);
  if (name == "hemisphere")
    return hemisphere<degree>(n, 18., .09352156);
  if (name == "closed_hemisphere")
    return hemisphere<degree>(n, .5, .092414);
  return plate<degree>(n);
}

// The library knows one kind of shell, a brittle one. Statics and small vibrations hold its phase field at 1, intact,
// so degradation, crack density, toughness and length scale have no influence here.
template <int degree>
models::KoiterShell<degree> make_shell(const Problem<degree> &problem)
{
  const auto laws = material::koiter_shell(problem.youngs_modulus, problem.poissons_ratio, problem.thickness);
  return models::KoiterShell<degree>(split::None(laws.membrane, laws.bending), degradation::Cubic(), {}, 1., 1., 1.);
}

// What one rank writes. The library makes a snapshot complete on each rank.
struct Files
{
  CsvTable    convergence, frequencies, list;
  FrameWriter frames;
};

// One frame: the surface displaced by u, which is enlarged so that it can be seen.
template <int degree>
void draw(const Parameters &prm, Files &files, const std::string &name, int mode, const Surface<degree, 3> &surface,
          const ControlValues<3> &u)
{
  const ControlValues<3> X            = surface.control_points();
  const double           length       = (X.colwise().maxCoeff() - X.colwise().minCoeff()).maxCoeff();
  const double           exaggeration = prm.drawn * length / u.rowwise().norm().maxCoeff();
  const int              n            = files.frames.n_frames();
  files.list.append(CsvRow() << n << name << mode << exaggeration);
  files.frames.write(
      surface, {1. * n, X + exaggeration * u, ControlValues<3>::Zero(X.rows(), 3), Eigen::VectorXd::Ones(X.rows())});
}

// If error = C h^order, two meshes tell the order. Positive: the finer mesh is better.
struct OrderOfConvergence
{
  int    n     = 0;
  double error = NAN;

  double next(int finer_n, double finer_error)
  {
    const double order = std::log(std::abs(error / finer_error)) / std::log(1. * finer_n / n);
    n                  = finer_n;
    error              = finer_error;
    return order;
  }
};

template <int degree>
void deflect(const Environment &env, const Parameters &prm, const Study &study, std::optional<Files> &files)
{
  OrderOfConvergence of_deflection, of_work;
  for (const int n : study.elements)
    {
      const auto                                problem = make_problem<degree>(study.problem, n);
      const auto                                shell   = make_shell(problem);
      ShellSpace<degree, 3>                     space(env, problem.surface);
      StaticSolver<models::KoiterShell<degree>> solver(shell, space, problem.supports, problem.loads, {});

      // Linear statics is one step of Newton's method from the shell at rest: K u = f. The load factor takes the place
      // of time in loads, and the forces out of balance at rest are the loads themselves, f.
      const State<degree, 3> rest(space);
      solver.rebuild(rest);
      auto loaded         = rest;
      loaded.time         = 1.;
      const Vector force  = solver.residual(loaded).free;
      const auto   result = solver.solve_linear(rest, 1.);

      const ControlValues<3> u          = snapshot(result).position - problem.surface.control_points();
      const auto             at         = evaluate(problem.surface, closest_place(problem.surface, problem.place));
      double                 deflection = 0.;
      for (std::size_t k = 0; k < at.points.size(); ++k)
        deflection += at.value[k] * u.row(at.points[k]).dot(problem.direction);

      // The method makes the error in energy as small as it can be, and with it that of the work f . u, which is its
      // square: f . u grows with every refinement and never exceeds the exact value (doc/intro.md). No other number
      // tells so clearly what a mesh is worth. On several ranks each holds the forces of its own control points.
      double work = 0.;
      for (int a = 0; a < rest.distribution->n_owned(); ++a)
        for (int c = 0; c < 3; ++c)
          work += force.local()[4 * a + c] * (result.position.local()[3 * a + c] - rest.position.local()[3 * a + c]);
      MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, env.comm());

      const double error = deflection / problem.deflection - 1., work_error = work / problem.work - 1.;
      on_root(env.comm(), [&] {
        files->convergence.append(CsvRow() << study.problem << degree << n << static_cast<int>(3 * u.rows())
                                           << deflection << error << of_deflection.next(n, error) << work << work_error
                                           << of_work.next(n, work_error));
        std::cout << study.problem << ", degree " << degree << ", " << n << " x " << n << ": deflection " << deflection
                  << ", error " << error << std::endl;
        if (degree == study.degrees.back() && n == study.elements.back())
          draw(prm, *files, study.problem, 0, problem.surface, u);
      });
    }
}

// omega_mn = pi^2 (m^2 + n^2) sqrt(D / rho), with D = rho = 1 (theory J.3): the second and third are equal.
std::vector<double> plate_frequencies(int n_modes)
{
  std::vector<double> omega;
  for (int m = 1; m <= n_modes; ++m)
    for (int n = 1; n <= n_modes; ++n)
      omega.push_back(M_PI * M_PI * (m * m + n * n));
  std::sort(omega.begin(), omega.end());
  omega.resize(n_modes);
  return omega;
}

template <int degree>
void vibrate(const Environment &env, const Parameters &prm, const Study &study, std::optional<Files> &files)
{
  const auto                      exact = plate_frequencies(prm.modes);
  std::vector<OrderOfConvergence> orders(prm.modes);
  for (const int n : study.elements)
    {
      const auto             problem = make_problem<degree>(study.problem, n);
      const auto             shell   = make_shell(problem);
      ShellSpace<degree, 3>  space(env, problem.surface);
      const State<degree, 3> rest(space);
      const auto             modes = vibration_modes(shell, space, problem.supports, rest, {.n_modes = prm.modes});
      for (int m = 0; m < prm.modes; ++m)
        {
          const double omega = modes[m].omega, error = omega / exact[m] - 1.;
          const auto   values = gather(modes[m].shape);
          on_root(env.comm(), [&] {
            files->frequencies.append(CsvRow() << degree << n << m + 1 << omega << exact[m] << error
                                               << orders[m].next(n, error));
            std::cout << "plate, degree " << degree << ", " << n << " x " << n << ": mode " << m + 1 << ", omega "
                      << omega << ", error " << error << std::endl;
            if (degree == study.degrees.back() && n == study.elements.back())
              draw<degree>(prm, *files, study.problem, m + 1, problem.surface,
                           Eigen::Map<const ControlValues<3>>(values.data(), values.size() / 3, 3));
          });
        }
    }
}

void solve(const Environment &env, const Parameters &prm)
{
  refuse_restart(env);
  OutputDirectory directory(env);
  if (env.command_line().check)
    return;
  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  std::optional<Files> files;
  on_root(env.comm(), [&] {
    files.emplace(Files{
        CsvTable(directory.file("convergence.csv"), {"problem", "degree", "elements", "unknowns", "deflection", "error",
                                                     "order", "work", "work_error", "work_order"}),
        CsvTable(directory.file("frequencies.csv"), {"degree", "elements", "mode", "omega", "exact", "error", "order"}),
        CsvTable(directory.file("frames.csv"), {"frame", "problem", "mode", "exaggeration"}),
        FrameWriter(directory.path())});
  });
  const auto run_study = [&]<int degree>(const Study &study, std::integral_constant<int, degree>) {
    if (study.problem == "plate")
      vibrate<degree>(env, prm, study, files);
    else
      deflect<degree>(env, prm, study, files);
  };
  for (const auto &study : prm.studies)
    for (const int degree : study.degrees)
      if (degree == 2)
        run_study(study, std::integral_constant<int, 2>());
      else if (degree == 3)
        run_study(study, std::integral_constant<int, 3>());
      else
        run_study(study, std::integral_constant<int, 4>());
}

} // namespace step_2

int main(int argc, char **argv)
{
  return run<step_2::Parameters>(argc, argv, step_2::solve);
}
