// Step 13: many ranks, checkpoint and restart
//
// A curved panel with a notch is pulled apart suddenly and tears around its circumference, on as many ranks as you
// like. Half-way a checkpoint is written, and the second half is computed twice: by the ranks that are at it, and by
// fewer of them from the checkpoint. New here: who has what, what a checkpoint holds, and how much the number of ranks
// matters.
//
// Run:     mpirun -np 2 ./step-13 demo.yaml --output output-demo --profile
//          mpirun -np 3 ./step-13 quick.yaml
//          mpirun -np 5 ./step-13 --restart output-demo/checkpoint.h5
// Expect:  on the terminal the shares of the ranks and the comparison; history.csv, tips.csv, frames in the output
//          directory, and the same of the second half once more in its folder again
// Units:   any consistent ones, as in step-10: radius, density by area and moduli of order 1
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>

#include <sherd/adapt/adaptivity.h>
#include <sherd/base/all_gather.h>
#include <sherd/base/output_directory.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/restart.h>
#include <sherd/solve/instances.h>

using namespace sherd;

namespace step_13
{

struct Material
{
  double youngs_modulus = 10.;
  double poissons_ratio = .3;
  double thickness      = .01;
  double density        = 1.;
  double toughness      = 5e-4;
  double length_scale   = .02;
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

struct Panel
{
  double             radius   = .5;
  double             length   = 1.2;
  double             angle    = 120.;
  double             notch    = .4;
  std::array<int, 2> elements = {60, 52};

  void declare(ParameterSection &section)
  {
    section.value("radius", radius, "length", range::positive(), "radius");
    section.value("length", length, "length", range::positive(), "length between the ends that are pulled");
    section.value("angle", angle, "degrees", range::open(0., 360.), "angle that the panel spans");
    section.value("notch", notch, "length", range::positive(), "length of the notch around the circumference");
    section.value("elements", elements, range::at_least(1), "elements along the axis and around");
  }
};

struct TimeSettings
{
  double              end     = .9;
  double              rho_inf = .5;
  StepControlSettings steps{.initial = 4e-3};

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
  Panel              panel;
  double             traction = .09;
  RefinementSettings refinement{.target = .0101, .halo = .1, .history_fraction = 4.};
  TimeSettings       time;
  NewtonSettings     newton;
  CheckpointSettings checkpoint;
  int                ranks_again = 0;
  int                frames      = 20;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "the sheet");
    section.subsection("panel", panel, "the panel");
    section.value("traction", traction, "force/length", range::any(), "pulls both ends along the axis from t = 0 on");
    section.subsection("refinement", refinement, "where the mesh is refined");
    section.subsection("time", time, "time integration");
    section.subsection("newton", newton, "nonlinear and linear solver");
    section.subsection("checkpoint", checkpoint, "when a state to go on from is written, beside the one half-way");
    section.value("ranks_again", ranks_again, range::at_least(0),
                  "ranks that compute the second half once more; 0: half of all");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

} // namespace step_13

using models::Shell;
using step_13::Parameters;

Shell make_sheet(const step_13::Material &prm)
{
  const auto moduli  = material::surface_moduli(prm.youngs_modulus, prm.poissons_ratio);
  const auto bending = material::Canham(prm.youngs_modulus * prm.thickness * prm.thickness / 12.);
  return Shell({material::NeoHooke(moduli), bending, LayerSettings{.thickness = prm.thickness}},
               degradation::Cubic(prm.slope), {}, Toughness<3>(prm.toughness), prm.length_scale, prm.density);
}

Surface<2, 3> make_panel(const step_13::Panel &prm)
{
  const double half = prm.angle / 360. * M_PI;
  return shapes::cylinder<2>(prm.radius, prm.length, {-half, half}, prm.elements, shapes::Fit::smooth);
}

// A polyline around the circumference, in the middle of the length, from one straight edge on.
PreCrack<3> make_notch(const Parameters &prm)
{
  const auto           &panel = prm.panel;
  const int             n     = 32;
  std::vector<Point<3>> corners;
  for (int k = 0; k <= n; ++k)
    {
      const double angle = -panel.angle / 360. * M_PI + panel.notch / panel.radius * k / n;
      corners.emplace_back(.5 * panel.length, panel.radius * std::sin(angle), panel.radius * std::cos(angle));
    }
  return PreCrack<3>({Polyline<3>(corners)}, prm.material.length_scale);
}

Loads<3> make_loads(double traction)
{
  Loads<3> loads;
  loads.traction("left", [traction](const Point<3> &, double) { return Point<3>(-traction, 0., 0.); });
  loads.traction("right", [traction](const Point<3> &, double) { return Point<3>(traction, 0., 0.); });
  return loads;
}

// All that the steps work on. A space belongs to the ranks of one environment, and with it solver and state, so each
// group of ranks makes a computation of its own. The mesh is known to every rank; what has unknowns is distributed.
struct Computation
{
  Computation(const Environment &env, const Parameters &prm)
      : prm(prm),
        sheet(make_sheet(prm.material)),
        blank(make_panel(prm.panel)),
        panel(blank),
        loads(make_loads(prm.traction)),
        space(env, panel),
        solver(sheet, space, supports, loads, GeneralizedAlpha(prm.time.rho_inf), prm.newton),
        adaptivity(blank, prm.refinement),
        controller(prm.time.steps),
        state(space)
  {
  }

  // From the notch, or from where a checkpoint was. It does not say which rank had what: every rank takes its part of
  // the surface as it would after a refinement.
  void start(const std::optional<Checkpoint<2, 3>> &checkpoint)
  {
    if (checkpoint)
      resume(*checkpoint, solver, panel, space, state, controller);
    else
      {
        adaptivity.prepare(solver, panel, space, state, make_notch(prm));
        solver.set_initial_acceleration(state);
      }
    controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());
  }

  RecorderSettings<3> recording() const
  {
    return {.crack    = {.length_scale   = prm.material.length_scale,
                         .rayleigh_speed = solver.rayleigh_speed(),
                         .target_size    = prm.refinement.target},
            .end_time = prm.time.end,
            .frames   = prm.frames,
            .points   = {},
            .edges    = {"left", "right"}};
  }

  const Parameters                         &prm;
  Shell                                     sheet;
  Surface<2, 3>                             blank, panel;
  Supports                                  supports; // none: the tractions balance each other
  Loads<3>                                  loads;
  ShellSpace<2, 3>                          space;
  MonolithicSolver<Shell, GeneralizedAlpha> solver;
  Adaptivity<Shell>                         adaptivity;
  StepController                            controller;
  State<2, 3>                               state;

  StepSummary advance();
};

// The shares of the ranks. An element is integrated by every rank that owns one of its control points, so those along
// the borders more than once: that is what it costs that no rank has to add up contributions of another. Ghosts are
// control points of others that a rank needs the values of.
void print_partition(const ShellSpace<2, 3> &space)
{
  struct Share
  {
    int elements, integrated, points, ghosts;
  };
  const auto &env   = space.environment();
  const auto &d     = space.distribution();
  const auto  owned = std::count(d.owns.begin(), d.owns.end(), 1);
  const auto  shares =
      all_gather<Share>(env.comm(), {{static_cast<int>(owned), static_cast<int>(d.elements.size()),
                                      static_cast<int>(d.owned.size()), static_cast<int>(d.ghosts.size())}});
  if (env.rank() != 0)
    return;
  int total = 0, largest = 0;
  std::cout << "  rank  elements  integrated  control points  ghosts\n";
  for (std::size_t rank = 0; rank < shares.size(); ++rank)
    {
      const auto &share = shares[rank];
      total += share.integrated;
      largest = std::max(largest, share.integrated);
      std::cout << std::setw(6) << rank << std::setw(10) << share.elements << std::setw(12) << share.integrated
                << std::setw(16) << share.points << std::setw(8) << share.ghosts << '\n';
    }
  std::cout << std::fixed << std::setprecision(3)
            << "  integrated more than once: " << 100. * total / space.surface().n_elements() - 100. << " % of "
            << space.surface().n_elements()
            << " elements; busiest rank over mean: " << largest * shares.size() / static_cast<double>(total)
            << std::defaultfloat << std::endl;
}

StepSummary Computation::advance()
{
  auto step = adaptivity.advance(solver, panel, space, state, controller, prm.time.end);
  if (step.refined > 0)
    print_partition(space);
  return step;
}

// A second half: where it ended, and where its time went.
struct SecondHalf
{
  int                           n_ranks;
  RecorderMemory                memory; // totals, last row of history.csv, crack tips
  GlobalState<2, 3>             state;
  std::map<std::string, double> seconds; // by phase
};

SecondHalf finish(Computation &all, RecordedRun<MonolithicSolver<Shell, GeneralizedAlpha>, 2, 3> &run)
{
  const auto &env    = all.space.environment();
  const auto  before = all.solver.timers().maximum(env.comm());
  while (all.state.time < all.prm.time.end)
    run.step([&] { return all.advance(); });
  run.finish();
  auto seconds = all.solver.timers().maximum(env.comm());
  for (const auto &[phase, value] : before)
    seconds[phase] -= value;
  return {env.n_ranks(), run.memory(), gather(all.state, all.space), seconds};
}

// The first ranks of an environment, as a communicator of their own.
class FirstRanks
{
public:
  FirstRanks(const Environment &env, int n)
  {
    MPI_Comm_split(env.comm(), env.rank() < n ? 0 : MPI_UNDEFINED, env.rank(), &comm_);
  }
  ~FirstRanks()
  {
    if (has_me())
      MPI_Comm_free(&comm_);
  }
  FirstRanks(const FirstRanks &)            = delete;
  FirstRanks &operator=(const FirstRanks &) = delete;

  bool     has_me() const { return comm_ != MPI_COMM_NULL; }
  MPI_Comm comm() const { return comm_; }

private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

// What --restart does, inside a program.
SecondHalf once_more(const Environment &env, const OutputDirectory &directory, const Parameters &prm,
                     const Checkpoint<2, 3> &checkpoint)
{
  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  Computation some(env, prm);
  const auto  given = std::optional(checkpoint);
  some.start(given);
  print_partition(some.space);
  RecordedRun run(env, directory, some.blank, given, some.recording(), prm.checkpoint, some.solver, some.space,
                  some.state, some.controller);
  return finish(some, run);
}

double difference(double a, double b)
{
  return std::abs(a - b) / std::max({std::abs(a), std::abs(b), std::numeric_limits<double>::min()});
}

void print_comparison(const SecondHalf &all, const SecondHalf &some)
{
  const auto compare = [&](const std::string &name, double a, double b) {
    std::cout << std::left << std::setw(20) << name << std::right << std::setprecision(8) << std::defaultfloat
              << std::setw(16) << a << std::setw(16) << b << std::setprecision(1) << std::scientific << std::setw(12)
              << difference(a, b) << '\n';
  };
  std::cout << "\nRanks               " << std::setw(16) << all.n_ranks << std::setw(16) << some.n_ranks
            << "  difference\n";
  const auto &a = all.memory, &b = some.memory;
  compare("steps", a.totals.steps, b.totals.steps);
  compare("linear iterations", a.totals.linear, b.totals.linear);
  compare("unknowns", a.last.dofs, b.last.dofs);
  compare("elastic energy", a.last.elastic, b.last.elastic);
  compare("kinetic energy", a.last.kinetic, b.last.kinetic);
  compare("fracture energy", a.last.fracture, b.last.fracture);
  compare("crack length", a.last.crack_length, b.last.crack_length);
  for (std::size_t k = 0; k < std::min(a.cracks.tips.size(), b.cracks.tips.size()); ++k)
    for (int d = 0; d < 3; ++d)
      compare("tip " + std::to_string(a.cracks.tips[k].id) + ", " + "xyz"[d], a.cracks.tips[k].X[d],
              b.cracks.tips[k].X[d]);

  const auto &s = all.state, &t = some.state;
  if (s.position.rows() != t.position.rows())
    std::cout << "The meshes differ.\n";
  else if (s.position == t.position && s.velocity == t.velocity && s.phase == t.phase && s.time == t.time)
    std::cout << "Positions, velocities and phase are equal bit by bit.\n";
  else
    std::cout << "Largest difference at a control point: position " << (s.position - t.position).cwiseAbs().maxCoeff()
              << ", phase " << (s.phase - t.phase).cwiseAbs().maxCoeff() << '\n';

  std::cout << "\nSeconds of the second half\n" << std::fixed << std::setprecision(2);
  for (const auto &[phase, seconds] : all.seconds)
    if (const auto other = some.seconds.find(phase); other != some.seconds.end())
      std::cout << std::left << std::setw(20) << phase << std::right << std::setw(16) << seconds << std::setw(16)
                << other->second << '\n';
  std::cout << std::flush;
}

void tear_panel(const Environment &env, const Parameters &prm)
{
  OutputDirectory directory(env);
  const int       n_again = prm.ranks_again == 0 ? (env.n_ranks() + 1) / 2 : prm.ranks_again;
  if (n_again > env.n_ranks())
    throw InvalidParameter("ranks_again = " + std::to_string(n_again) + ", but there are only " +
                           std::to_string(env.n_ranks()) + " ranks; give fewer, or start more with mpirun");
  Computation all(env, prm);
  auto        checkpoint = restart_checkpoint(env, all.blank); // with --restart
  if (env.command_line().check)
    return;

  all.start(checkpoint);
  print_partition(all.space);
  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  RecordedRun run(env, directory, all.blank, checkpoint, all.recording(), prm.checkpoint, all.solver, all.space,
                  all.state, all.controller);

  // The first half, unless a restart is beyond it already: then what follows the restart is computed twice.
  while (all.state.time < .5 * prm.time.end)
    run.step([&] { return all.advance(); });
  if (!checkpoint || checkpoint->state.time < .5 * prm.time.end)
    {
      run.write_checkpoint();
      checkpoint = read_checkpoint<2, 3>(env, directory.file("checkpoint.h5"));
    }
  const auto ending = finish(all, run);

  // The second half once more. Ranks that have no part in it wait, and all learn of a failure. Of the same number of
  // ranks the first ones are the same ranks, so then everything has to be equal to the last bit.
  auto line             = env.command_line();
  line.output_directory = directory.file("again").string();
  line.restart          = std::nullopt;
  line.overwrite        = true;
  if (line.max_wall_minutes)
    *line.max_wall_minutes -= env.elapsed_seconds() / 60.;
  const FirstRanks group(env, n_again);
  collectively(env.comm(), [&] {
    if (!group.has_me())
      return;
    const Environment few(group.comm(), line);
    const auto        again = once_more(few, OutputDirectory(few), prm, *checkpoint);
    if (few.rank() == 0)
      print_comparison(ending, again);
  });
}

int main(int argc, char **argv)
{
  // What a restart may not change: the body, its mesh and its model.
  return run_restartable<Parameters>(argc, argv, {"material", "panel", "traction", "refinement"}, tear_panel);
}
