// Step 3: large deformations
//
// Thin shells that bend far, roll up, snap through: published problems, followed by load control or along the arc of
// the equilibrium path. New here: shells in space, their supports and loads, static solver and arc length.
// Run:     ./step-3 demo.yaml --output output-demo
//          mpirun -np 3 ./step-3 quick.yaml
// Expect:  path.csv, frames of each problem in the output directory; pictures by doc/figures output-demo
// Units:   those of each published problem
#include <iostream>
#include <optional>

#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/base/print.h>
#include <sherd/base/stop_request.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/frames.h>
#include <sherd/solve/arc_length.h>
#include <sherd/solve/instances.h>
#include <sherd/solve/load_stepping.h>

using namespace sherd;

namespace step_3
{

enum class Path
{
  recommended,
  load_control,
  arc_length
};

const std::vector<std::string> problem_names{"cantilever",       "rollup",     "slit_plate", "hinged_roof",
                                             "thin_hinged_roof", "hemisphere", "pullout"};

struct Parameters
{
  std::string       problem = "all";
  int               degree  = 4;
  int               mesh    = 2;
  Path              path    = Path::recommended;
  double            end     = 1.;
  int               frames  = 1;
  StaticSettings    solver;
  LoadStepSettings  load_steps{.first = .025, .largest = .1, .wanted_iterations = 10};
  ArcLengthSettings arc_length{.first_factor = .02, .largest = 3.};

  void declare(ParameterSection &section)
  {
    auto names = problem_names;
    names.push_back("all");
    section.choice("problem", problem, names, "which problem, or all of them");
    section.choice("degree", degree, {{"2", 2}, {"3", 3}, {"4", 4}}, "degree of the splines in both directions");
    section.value("mesh", mesh, range::at_least(1), "factor on the coarsest mesh of a problem, see its function");
    section.choice(
        "path", path,
        {{"recommended", Path::recommended}, {"load_control", Path::load_control}, {"arc_length", Path::arc_length}},
        "how the equilibrium path is followed; recommended: arc length for the roofs, load control for all others");
    section.value("end", end, "-", range::positive(), "load factor at which a run ends");
    section.value("frames", frames, range::at_least(1), "a frame every so many steps; the last one always");
    section.subsection("solver", solver, "equilibrium at one load factor");
    section.subsection("load_steps", load_steps, "steps of load control");
    section.subsection("arc_length", arc_length, "steps along the path");
  }
};

// A point to be watched, by its parameters, and the direction in which it is published.
struct Watch
{
  std::string name;
  double      u, v;
  Point<3>    direction;
};

// What makes a problem: geometry, sheet, supports, loads at load factor t, and what is published about it.
template <int degree>
struct Problem
{
  Surface<degree, 3> surface;
  double             E, nu, thickness;
  Supports           supports         = {};
  Loads<3>           loads            = {};
  std::vector<Watch> watched          = {};
  bool               has_limit_points = false;
};

const Point<3> x_axis(1., 0., 0.), y_axis(0., 1., 0.), z_axis(0., 0., 1.);

// The two outer rows of control points are the position and the tangent plane of an edge: a clamp fixes both.
template <int degree>
Problem<degree> cantilever(int mesh)
{
  const int       n = 8 * mesh;
  Problem<degree> problem{shapes::plate<degree, 3>({10., 1.}, {n, 1}), 1.2e6, 0., .1};
  problem.supports.clamp("left");
  problem.loads.traction("right", [](const Point<3> &, double t) { return Point<3>(0., 0., 4. * t); });
  problem.watched = {{"u", 1. * n, .5, -x_axis}, {"w", 1. * n, .5, z_axis}};
  return problem;
}

// A moment has no direction in space to keep: it turns with the edge and has a tangent of its own (theory E.3).
template <int degree>
Problem<degree> rollup(int mesh)
{
  const int       n = 12 * mesh;
  Problem<degree> problem{shapes::plate<degree, 3>({12., 1.}, {n, 1}), 1.2e6, 0., .1};
  problem.supports.clamp("left");
  problem.loads.edge_moment("right", [](const Point<3> &, double t) { return 50. * M_PI / 3. * t; });
  problem.watched = {{"u", 1. * n, .5, -x_axis}, {"w", 1. * n, .5, -z_axis}};
  return problem;
}

// One edge of the slit is clamped, the other is lifted.
template <int degree>
Problem<degree> slit_plate(int mesh)
{
  const int       n = 2 * mesh, m = 20 * mesh;
  Problem<degree> problem{shapes::annular_plate<degree>(6., 10., {0., 2. * M_PI}, {n, m}, shapes::Fit::smooth), 21e6,
                          0., .03};
  problem.supports.clamp("begin");
  problem.loads.traction("end", [](const Point<3> &, double t) { return Point<3>(0., 0., .8 * t); });
  problem.watched = {{"w_A", 0., 1. * m, z_axis}, {"w_B", 1. * n, 1. * m, z_axis}};
  return problem;
}

// A quarter by symmetry, so a quarter of the load. The straight edge is a hinge: its points stay, its tangent plane is
// free. The curved edge is free altogether.
template <int degree>
Problem<degree> hinged_roof(int mesh, double thickness)
{
  const int       n = 4 * mesh;
  Problem<degree> problem{shapes::roof<degree>(2540., 508., .1, {n, n}, shapes::Fit::exact, shapes::Part::quarter),
                          3102.75, .3, thickness};
  problem.supports.fix("top");
  problem.supports.symmetry("right", Component::x);
  problem.supports.symmetry("bottom", Component::y);
  problem.loads.point_load({254., 0., 2540.}, [](double t) { return Point<3>(0., 0., -3000. / 4. * t); });
  problem.watched          = {{"centre", 1. * n, 0., -z_axis}, {"free_edge", 0., 0., -z_axis}};
  problem.has_limit_points = true;
  return problem;
}

// A quarter, two radial forces in the planes of symmetry, so half of each. One point holds it along the axis.
template <int degree>
Problem<degree> hemisphere(int mesh)
{
  const int       n = 8 * mesh;
  Problem<degree> problem{shapes::hemisphere_with_hole<degree>(10., .1 * M_PI, {0., .5 * M_PI}, {n, n}), 6.825e7, .3,
                          .04};
  problem.supports.symmetry("left", Component::y);
  problem.supports.symmetry("right", Component::x);
  problem.supports.fix(Corner{"left", "equator"}, Component::z);
  problem.loads.point_load({10., 0., 0.}, [](double t) { return Point<3>(400. / 2. * t, 0., 0.); });
  problem.loads.point_load({0., 10., 0.}, [](double t) { return Point<3>(0., -400. / 2. * t, 0.); });
  problem.watched = {{"V_A", 0., 0., x_axis}, {"U_B", 1. * n, 0., -y_axis}};
  return problem;
}

// An octant, the force pulls at the top: a quarter of it. The ends of the cylinder are open.
template <int degree>
Problem<degree> pullout(int mesh)
{
  const int       n = 8 * mesh;
  Problem<degree> problem{shapes::cylinder<degree>(4.953, 10.35 / 2., {0., .5 * M_PI}, {n, n}), 10.5e6, .3125, .094};
  problem.supports.symmetry("right", Component::x);
  problem.supports.symmetry("bottom", Component::y);
  problem.supports.symmetry("top", Component::z);
  problem.loads.point_load({10.35 / 2., 0., 4.953}, [](double t) { return Point<3>(0., 0., 40000. / 4. * t); });
  problem.watched = {{"W_A", 1. * n, 0., z_axis}, {"U_B", 1. * n, 1. * n, -y_axis}, {"U_C", 0., 1. * n, -y_axis}};
  return problem;
}

template <int degree>
Problem<degree> make_problem(const std::string &name, int mesh)
{
  if (name == "cantilever")
    return cantilever<degree>(mesh);
  if (name == "rollup")
    return rollup<degree>(mesh);
  if (name == "slit_plate")
    return slit_plate<degree>(mesh);
  if (name == "hinged_roof")
    return hinged_roof<degree>(mesh, 12.7);
  if (name == "thin_hinged_roof")
    return hinged_roof<degree>(mesh, 6.35);
  if (name == "hemisphere")
    return hemisphere<degree>(mesh);
  return pullout<degree>(mesh);
}

// What the root rank writes of one problem.
template <int degree>
class Record
{
public:
  Record(const Environment &env, const OutputDirectory &directory, const std::string &name,
         const Problem<degree> &problem, CsvTable *table, int every)
      : env_(&env), name_(name), problem_(&problem), table_(table), every_(every), frames_(directory.file(name))
  {
  }

  void step(const State<degree, 3> &state, int iterations)
  {
    const auto at = snapshot(state); // collective: the whole surface on every rank
    on_root(env_->comm(), [&] { write(at, state.step, iterations); });
    if (const auto reason = stop_requested(*env_))
      throw StoppedEarly("stopped at load factor " + print(state.time) + " of " + name_ + ": " + *reason);
  }

  void finish(const State<degree, 3> &state)
  {
    const auto at = snapshot(state);
    on_root(env_->comm(), [&] {
      if (state.step % every_ != 0)
        frames_.write(problem_->surface, frame_of(at, state.step));
      std::cout << name_ << ": " << state.step << " steps, " << n_iterations_ << " iterations, load factor "
                << state.time << std::endl;
    });
  }

private:
  void write(const Snapshot<3> &at, int step, int iterations)
  {
    n_iterations_ += iterations;
    const auto X = problem_->surface.control_points();
    for (const auto &point : problem_->watched)
      {
        const auto place        = evaluate(problem_->surface, SurfacePlace{0, point.u, point.v});
        double     displacement = 0.;
        for (std::size_t i = 0; i < place.points.size(); ++i)
          displacement +=
              place.value[i] * (at.position.row(place.points[i]) - X.row(place.points[i])).dot(point.direction);
        table_->append(CsvRow() << name_ << step << at.time << iterations << point.name << displacement);
      }
    if (step % every_ == 0)
      frames_.write(problem_->surface, frame_of(at, step));
  }

  // A path may pass one load factor twice, so frames are numbered by steps instead.
  static Snapshot<3> frame_of(Snapshot<3> at, int step)
  {
    at.time = step;
    return at;
  }

  const Environment     *env_;
  std::string            name_;
  const Problem<degree> *problem_;
  CsvTable              *table_; // null but on the root
  int                    every_;
  FrameWriter            frames_;
  int                    n_iterations_ = 0;
};

template <int degree>
void follow(const Environment &env, const Parameters &prm, const OutputDirectory &directory, const std::string &name,
            CsvTable *table)
{
  const auto problem = make_problem<degree>(name, prm.mesh);

  // The model holds a phase field too. Here it stays one: nothing cracks in these problems, and its parameters do not
  // matter.
  using Model      = models::KoiterShell<degree>;
  const auto  laws = material::koiter_shell(problem.E, problem.nu, problem.thickness);
  const Model model(split::None<material::StVenantKirchhoff, material::Koiter>(laws.membrane, laws.bending),
                    degradation::Cubic(1e-4), {}, Toughness<3>(1.), 1., 1.);

  ShellSpace<degree, 3> space(env, problem.surface);
  StaticSolver<Model>   solver(model, space, problem.supports, problem.loads, prm.solver);
  State<degree, 3>      state(space);
  solver.rebuild(state);

  Record<degree> record(env, directory, name, problem, table, prm.frames);
  record.step(state, 0);
  const bool arc = prm.path == Path::arc_length || (prm.path == Path::recommended && problem.has_limit_points);
  if (arc)
    {
      // The load factor is an unknown here and may fall and rise; the path ends where it first passes the end.
      ArcLength<Model> path(solver, state, prm.arc_length);
      while (path.state().time < prm.end)
        {
          const int iterations = path.advance();
          record.step(path.state(), iterations);
        }
      record.finish(path.state());
    }
  else
    record.finish(follow_loads(solver, state, prm.end, prm.load_steps,
                               [&](const auto &at, int iterations) { record.step(at, iterations); }));
}

void deform_shells(const Environment &env, const Parameters &prm)
{
  refuse_restart(env);
  OutputDirectory directory(env);
  if (env.command_line().check)
    return;
  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  std::optional<CsvTable> table;
  on_root(env.comm(), [&] {
    table.emplace(directory.file("path.csv"),
                  std::vector<std::string>{"problem", "step", "load_factor", "iterations", "point", "displacement"});
  });
  const auto names = prm.problem == "all" ? problem_names : std::vector{prm.problem};
  for (const auto &name : names)
    {
      CsvTable *const rows = table ? &*table : nullptr;
      if (prm.degree == 2)
        follow<2>(env, prm, directory, name, rows);
      else if (prm.degree == 3)
        follow<3>(env, prm, directory, name, rows);
      else
        follow<4>(env, prm, directory, name, rows);
    }
}

} // namespace step_3

int main(int argc, char **argv)
{
  return run<step_3::Parameters>(argc, argv, step_3::deform_shells);
}
