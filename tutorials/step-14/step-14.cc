// Step 14: patches and continuity
//
// Shells from several patches: a plate, a roof and a hemisphere cut into pieces and joined again, and a bracket with a
// fold. New here: interfaces, their continuity by penalty or by multipliers, what happens without, and geometry files.
// Run:     mpirun -np 2 ./step-14 demo.yaml --output output-demo      (a minute)
//          ./step-14 quick.yaml
// Expect:  convergence.csv, frames, and the surfaces as G+Smo files in the output directory; pictures by
//          doc/figures output-demo
// Units:   those in which each benchmark was published; any consistent ones
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/geometry/gismo_xml.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/frames.h>
#include <sherd/solve/instances.h>

using namespace sherd;

namespace step_14
{

// One problem on a sequence of meshes, in one patch and in several.
struct Study
{
  std::string         problem  = "plate";
  std::vector<int>    degrees  = {2, 3};
  std::vector<int>    elements = {8, 16};
  std::vector<double> factors  = {1e3};

  void declare(ParameterSection &section)
  {
    section.choice("problem", problem, {"plate", "roof", "hemisphere", "bracket"},
                   "a plate under pressure, a roof under its weight, a pinched hemisphere, a bracket with a fold");
    section.value("degrees", degrees, range::closed(2, 3), "degrees of the splines");
    section.value("elements", elements, range::at_least(2),
                  "elements along each side of the whole; even ones keep all elements equal when it is cut");
    section.value("factors", factors, "-", range::positive(), "penalty factors beta (theory G.3)");
  }
};

struct Parameters
{
  std::vector<Study> studies = {{}};
  double             drawn   = .15;

  void declare(ParameterSection &section)
  {
    section.list("studies", studies, "problems, their degrees, meshes and penalties");
    section.value("drawn", drawn, "-", range::positive(),
                  "largest displacement in the frames, which exaggerate, over the length of the shell");
  }
};

// A linear problem: shape, sheet (Koiter's, as in step 2), supports, loads, and the deflection they should lead to.
template <int degree>
struct Problem
{
  Surface<degree, 3> surface;
  double             youngs_modulus, poissons_ratio, thickness;
  Supports           supports;
  Loads<3>           loads;
  Point<3>           place, direction; // where the deflection is read
  double             deflection;       // converged, see doc/results.md
};

// A simply supported square plate of rigidity 1 under a unit pressure.
template <int degree>
Problem<degree> plate(int n)
{
  const double nu = .3, T = .01;
  Supports     supports;
  for (const auto *edge : {"left", "right", "bottom", "top"})
    supports.fix(edge);
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., t); });
  return {.surface        = shapes::plate<degree, 3>({1., 1.}, {n, n}),
          .youngs_modulus = 12. * (1. - nu * nu) / (T * T * T),
          .poissons_ratio = nu,
          .thickness      = T,
          .supports       = supports,
          .loads          = loads,
          .place          = {.5, .5, 0.},
          .direction      = {0., 0., 1.},
          .deflection     = .00406235};
}

// The Scordelis-Lo roof of step 2, a quarter.
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
          .deflection     = .3005924567};
}

// The pinched hemisphere of step 2, a quarter: bending with hardly any membrane strain. A shell that is hinged gives
// way where it should bend.
template <int degree>
Problem<degree> hemisphere(int n)
{
  const double R = 10.;
  Supports     supports;
  supports.symmetry("left", Component::y);
  supports.symmetry("right", Component::x);
  supports.fix(Corner{"right", "equator"}, Component::z);
  Loads<3> loads;
  loads.point_load({R, 0., 0.}, [](double t) { return Point<3>(t, 0., 0.); });
  loads.point_load({0., R, 0.}, [](double t) { return Point<3>(0., -t, 0.); });
  return {.surface        = shapes::hemisphere_with_hole<degree>(R, 18. * M_PI / 180., {0., .5 * M_PI}, {n, n}),
          .youngs_modulus = 6.825e7,
          .poissons_ratio = .3,
          .thickness      = .04,
          .supports       = supports,
          .loads          = loads,
          .place          = {R, 0., 0.},
          .direction      = {1., 0., 0.},
          .deflection     = .09352156};
}

// A sheet bent at a right angle: a leg that is clamped at its foot, and an arm with a force at its tip. No smooth patch
// has a fold, so this takes two from the start. What the interface keeps is the angle between their normals, whatever
// it is (theory G.1): a fold stays as sharp as it was, and carries the bending moment of the arm into the leg.
template <int degree>
Problem<degree> bracket(int n)
{
  const double a = 1., L = 1., width = .5, T = .01; // height of the leg, length of the arm
  const auto   knots = shapes::uniform_knots<degree>(n);
  const auto   leg =
      interpolate<degree, 3>(knots, knots, [&](double u, double v) { return Point<3>(0., v / n * width, u / n * a); },
                             {{"foot", {{0, Side::u_min}}}});
  const auto arm =
      interpolate<degree, 3>(knots, knots, [&](double u, double v) { return Point<3>(u / n * L, v / n * width, a); },
                             {{"tip", {{0, Side::u_max}}}});
  Supports supports;
  supports.clamp("foot");
  Loads<3> loads;
  loads.traction("tip", [](const Point<3> &, double t) { return Point<3>(0., 0., -t); });
  const double E = 12. / (T * T * T), D = 1.; // without Poisson's effect a strip is a beam
  return {.surface        = join<degree, 3>({leg, arm}),
          .youngs_modulus = E,
          .poissons_ratio = 0.,
          .thickness      = T,
          .supports       = supports,
          .loads          = loads,
          .place          = {L, .5 * width, a},
          .direction      = {0., 0., -1.},
          .deflection     = (L * L * a + L * L * L / 3.) / D + a / (E * T)};
}

template <int degree>
Problem<degree> make_problem(const std::string &name, int n)
{
  if (name == "plate")
    return plate<degree>(n);
  if (name == "roof")
    return roof<degree>(n);
  if (name == "hemisphere")
    return hemisphere<degree>(n);
  return bracket<degree>(n);
}

// As in step 2: statics holds the phase field at 1, intact.
template <int degree>
models::KoiterShell<degree> make_shell(const Problem<degree> &problem)
{
  const auto laws = material::koiter_shell(problem.youngs_modulus, problem.poissons_ratio, problem.thickness);
  return models::KoiterShell<degree>(split::None(laws.membrane, laws.bending), degradation::Cubic(), {}, 1., 1., 1.);
}

// What one rank writes.
struct Files
{
  CsvTable    convergence, list;
  FrameWriter frames;
};

// One frame: the surface displaced by u, which is enlarged so that it can be seen.
template <int degree>
void draw(const Parameters &prm, Files &files, const std::string &problem, const std::string &method,
          const Surface<degree, 3> &surface, const ControlValues<3> &u)
{
  const ControlValues<3> X            = surface.control_points();
  const double           length       = (X.colwise().maxCoeff() - X.colwise().minCoeff()).maxCoeff();
  const double           exaggeration = prm.drawn * length / u.rowwise().norm().maxCoeff();
  const int              n            = files.frames.n_frames();
  files.list.append(CsvRow() << n << problem << method << exaggeration);
  files.frames.write(
      surface, {1. * n, X + exaggeration * u, ControlValues<3>::Zero(X.rows(), 3), Eigen::VectorXd::Ones(X.rows())});
}

// The linear deflection of one surface with one kind of continuity. All that a program says about interfaces is the
// third argument of the space: the surface knows where they are, assembly and solver do the rest. Patches share the
// control points of their interfaces, so nothing can gape; what the continuity adds is that nothing kinks.
template <int degree>
struct Answer
{
  int              unknowns;
  double           deflection;
  ControlValues<3> u;
};

template <int degree>
Answer<degree> deflect(const Environment &env, const Problem<degree> &problem, const Continuity &continuity)
{
  const auto                                shell = make_shell(problem);
  ShellSpace<degree, 3>                     space(env, problem.surface, continuity);
  StaticSolver<models::KoiterShell<degree>> solver(shell, space, problem.supports, problem.loads, {});
  const State<degree, 3>                    rest(space);
  solver.rebuild(rest);
  const auto             result = solver.solve_linear(rest, 1.);
  const ControlValues<3> u      = snapshot(result).position - problem.surface.control_points();
  const auto             at     = evaluate(problem.surface, closest_place(problem.surface, problem.place));
  double                 value  = 0.;
  for (std::size_t k = 0; k < at.points.size(); ++k)
    value += at.value[k] * u.row(at.points[k]).dot(problem.direction);
  return {space.n_unknowns(), value, u};
}

template <int degree>
void compare(const Environment &env, const Parameters &prm, const Study &study, const OutputDirectory &directory,
             std::optional<Files> &files)
{
  for (const int n : study.elements)
    {
      auto       problem   = make_problem<degree>(study.problem, n);
      const bool finest    = degree == study.degrees.back() && n == study.elements.back();
      double     reference = problem.deflection; // that of one patch, if there is one
      const auto solve     = [&](const std::string &method, double factor, const Continuity &continuity) {
        const auto   answer = deflect(env, problem, continuity);
        const double error  = answer.deflection / problem.deflection - 1.;
        if (method == "one_patch")
          reference = answer.deflection;
        on_root(env.comm(), [&] {
          files->convergence.append(CsvRow() << study.problem << degree << n << problem.surface.n_patches() << method
                                                 << factor << answer.unknowns << answer.deflection << error
                                                 << answer.deflection / reference - 1.);
          std::cout << study.problem << ", degree " << degree << ", " << n << " x " << n << ", " << method;
          if (method == "penalty")
            std::cout << " " << factor;
          std::cout << ": deflection " << answer.deflection << ", error " << error << std::endl;
          if (finest && (method == "none" || method == "multiplier"))
            draw(prm, *files, study.problem, method, problem.surface, answer.u);
        });
      };

      // Patches by a pair of scissors: the same surface, the same names of edges, but splines that may kink where the
      // cuts are. Supports and loads do not notice.
      if (study.problem != "bracket")
        {
          solve("one_patch", 0., continuity::None());
          problem.surface = split_patches(problem.surface, {2, 2});
        }
      if (finest)
        write_gismo_xml(env, directory.file(study.problem + ".xml"), problem.surface);
      // The bracket would be a mechanism: its arm swings about the fold, and the solver says so.
      if (study.problem != "bracket")
        solve("none", 0., continuity::None());
      for (const double factor : study.factors)
        solve("penalty", factor, continuity::Penalty{factor, factor});
      solve("multiplier", 0., continuity::LagrangeMultiplier());
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
    files.emplace(
        Files{CsvTable(directory.file("convergence.csv"), {"problem", "degree", "elements", "patches", "continuity",
                                                           "factor", "unknowns", "deflection", "error", "change"}),
              CsvTable(directory.file("frames.csv"), {"frame", "problem", "continuity", "exaggeration"}),
              FrameWriter(directory.path())});
  });
  for (const auto &study : prm.studies)
    for (const int degree : study.degrees)
      if (degree == 2)
        compare<2>(env, prm, study, directory, files);
      else
        compare<3>(env, prm, study, directory, files);
}

} // namespace step_14

int main(int argc, char **argv)
{
  return run<step_14::Parameters>(argc, argv, step_14::solve);
}
