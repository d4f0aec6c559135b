// Step 4: a vibrating plate and a snapping cylinder
//
// How a shell moves in time, and what the integrator makes of it: schemes compared by the phase they are behind, by the
// energy they lose, and by whether they survive a snap. New here: inertia, integrators, step control, the energy book.
// Run:     ./step-4 demo.yaml --output output-demo
//          mpirun -np 3 ./step-4 quick.yaml
// Expect:  runs.csv, plate.csv, cylinder.csv and frames of the cylinder; pictures by doc/figures output-demo
// Units:   the plate: its width, rigidity and mass by area are 1; the cylinder: mm, N, s
#include <iostream>
#include <optional>

#include <sherd/assembly/energy_balance.h>
#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/base/print.h>
#include <sherd/base/stop_request.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/frames.h>
#include <sherd/solve/instances.h>
#include <sherd/solve/modal_analysis.h>
#include <sherd/time/backward_euler.h>
#include <sherd/time/bathe.h>
#include <sherd/time/hht.h>
#include <sherd/time/implicit_midpoint.h>
#include <sherd/time/step_controller.h>
#include <sherd/time/wbz.h>

using namespace sherd;

namespace step_4
{

// The paper's shell, intact: the toughness is so large that the phase field stays 1.
using Shell = models::Shell;

// An integrator is an argument of the solver. AnyIntegrator stands for all implicit ones, so that they can be listed;
// the explicit one has a solver of its own.
struct Scheme
{
  std::string                  name;
  std::optional<AnyIntegrator> integrator; // none: central differences
};

const std::vector<Scheme> schemes{{"trapezoid", Newmark()},
                                  {"midpoint", ImplicitMidpoint()},
                                  {"generalized_alpha_0.8", GeneralizedAlpha(.8)},
                                  {"generalized_alpha_0.5", GeneralizedAlpha(.5)},
                                  {"generalized_alpha_0", GeneralizedAlpha(0.)},
                                  {"hht_0.1", HHT(-.1)},
                                  {"wbz_0.5", WBZ(.5)},
                                  {"bathe", Bathe()},
                                  {"backward_euler", BackwardEuler()},
                                  {"central_difference", {}}};

struct PlateSettings
{
  int              elements         = 16;
  double           periods          = 10.;
  std::vector<int> steps_per_period = {20, 40};

  void declare(ParameterSection &section)
  {
    section.value("elements", elements, range::at_least(2), "elements along a side, an even number");
    section.value("periods", periods, "-", range::at_least(1.), "length of each run in periods of the first mode");
    section.value("steps_per_period", steps_per_period, range::at_least(4), "steps in a period, one run for each");
  }
};

struct CylinderSettings
{
  int                 elements = 8;
  double              force    = 900.;
  double              ramp     = .05;
  double              end      = .15;
  StepControlSettings steps{.initial = 5e-4, .smallest = 1e-4, .rule = StepRule::fixed};

  void declare(ParameterSection &section)
  {
    section.value("elements", elements, range::at_least(2), "elements along a side of the quarter that is computed");
    section.value("force", force, "N", range::positive(), "force down at the centre in the end");
    section.value("ramp", ramp, "s", range::positive(), "time in which it grows, evenly");
    section.value("end", end, "s", range::positive(), "end of each run");
    section.subsection("steps", steps, "steps of the runs that compare schemes; times: when frames are written");
  }
};

struct Parameters
{
  std::string      scheme = "all";
  PlateSettings    plate;
  CylinderSettings cylinder;
  NewtonSettings   newton;

  Parameters()
  {
    newton.displacement_tolerance = 1e-8;
    newton.linear.preconditioner  = Preconditioner::mumps; // thin shells and large steps, theory F.2
    newton.linear.tolerance       = 1e-8;
  }

  void declare(ParameterSection &section)
  {
    std::vector<std::string> names{"all"};
    for (const auto &scheme : schemes)
      names.push_back(scheme.name);
    section.choice("scheme", scheme, names, "which integrator, or all of them");
    section.subsection("plate", plate, "the vibrating plate");
    section.subsection("cylinder", cylinder, "the snapping cylinder");
    section.subsection("newton", newton, "nonlinear and linear solver");
  }
};

// What it took.
struct Counts
{
  int         steps = 0, newton = 0, rejected = 0;
  std::string failure = "-";
};

// The loop in time, without a mesh that changes: a step that fails or is not accurate enough is repeated with a smaller
// one. Every accepted step goes into the energy book and to the observer.
template <class Solver, class Observe>
EnergyBalance follow(const Environment &env, Solver &solver, State<2, 3> &state, StepController &controller, double end,
                     Counts &counts, const Observe &observe)
{
  EnergyBalance book(solver.energies(state));
  observe(state, book);
  while (state.time < end)
    {
      controller.limit(solver.largest_step());
      const double stop      = controller.next_stop(state.time, end); // frames are hit exactly
      const double remaining = stop - state.time;
      const double dt        = controller.step_within(remaining);
      auto         result    = solver.attempt(state, dt);
      counts.newton += result.newton;
      if (!result.state || controller.is_inaccurate(result.error))
        {
          ++counts.rejected;
          if (result.state)
            controller.reject_inaccurate(result.error, dt);
          else
            controller.reject(result.failure, dt);
          continue;
        }
      StepSummary step;
      step.dt            = dt;
      step.newton        = result.newton;
      step.work          = result.work;
      step.withheld_work = result.withheld_work;
      step.energies      = solver.energies(*result.state);
      book.add(step);
      state = std::move(*result.state);
      if (dt == remaining)
        state.time = stop;
      controller.accept(result.newton, result.error, dt);
      ++counts.steps;
      observe(state, book);
      if (const auto reason = stop_requested(env))
        throw StoppedEarly("stopped at t = " + print(state.time) + ": " + *reason);
    }
  return book;
}

// The same with the solver that a scheme needs.
template <class Use>
void with_solver(const Scheme &scheme, const Shell &model, const ShellSpace<2, 3> &space, const Supports &supports,
                 const Loads<3> &loads, const NewtonSettings &settings, const Use &use)
{
  if (scheme.integrator)
    {
      MonolithicSolver<Shell, AnyIntegrator> solver(model, space, supports, loads, *scheme.integrator, settings);
      use(solver);
    }
  else
    {
      ExplicitSolver<Shell> solver(model, space, supports, loads, CentralDifference(), settings);
      use(solver);
    }
}

// Value of a field of control points at a place, one component. Collective.
double value_at(const PlaceValues &place, const Vector &field, int component)
{
  const auto all = gather(field);
  double     sum = 0.;
  for (std::size_t i = 0; i < place.points.size(); ++i)
    sum += place.value[i] * all[place.points[i] * field.block_size() + component];
  return sum;
}

// Tables of the root rank; on the others nothing is written.
struct Tables
{
  Tables(const Environment &env, const OutputDirectory &directory) : comm(env.comm())
  {
    on_root(comm, [&] {
      runs.emplace(directory.file("runs.csv"),
                   std::vector<std::string>{"problem", "scheme", "rule", "steps_per_period", "steps", "newton",
                                            "rejected", "end", "period_error", "dissipation", "closure", "failure"});
      plate.emplace(directory.file("plate.csv"), std::vector<std::string>{"scheme", "steps_per_period", "time",
                                                                          "displacement", "velocity", "dissipation"});
      cylinder.emplace(directory.file("cylinder.csv"),
                       std::vector<std::string>{"scheme", "rule", "time", "dt", "deflection", "membrane", "bending",
                                                "kinetic", "work", "dissipation"});
    });
  }

  MPI_Comm                comm;
  std::optional<CsvTable> runs, plate, cylinder;
};

// Zero crossings of a motion that is known with its velocity at a row of times, by Hermite's cubic between them.
struct Crossings
{
  std::vector<double> times;

  void add(double t, double w, double v)
  {
    if (last_ && (last_->w > 0.) != (w > 0.))
      {
        const double dt   = t - last_->t;
        const auto   here = [&](double s) {
          const double r = 1. - s;
          return r * r * (1. + 2. * s) * last_->w + s * s * (3. - 2. * s) * w + dt * s * r * (r * last_->v - s * v);
        };
        double low = 0., high = 1.;
        for (int k = 0; k < 60; ++k)
          ((here(.5 * (low + high)) > 0.) == (last_->w > 0.) ? low : high) = .5 * (low + high);
        times.push_back(last_->t + low * dt);
      }
    last_ = Sample{t, w, v};
  }

  // Angular frequency from the first crossing to the last.
  double frequency() const
  {
    return times.size() > 1 ? M_PI * (times.size() - 1.) / (times.back() - times.front()) : 0.;
  }

private:
  struct Sample
  {
    double t, w, v;
  };
  std::optional<Sample> last_;
};

// A simply supported square plate swings in its first mode, from rest. Its frequency is known, pi^2 * 2 for width,
// rigidity and mass one (theory J.3); that of the mesh is that of vibration_modes.
void plate(const Environment &env, const Parameters &prm, Tables &tables)
{
  const double amplitude = 5e-4; // so small that the plate is linear
  const auto   surface   = shapes::plate<2, 3>({1., 1.}, {prm.plate.elements, prm.plate.elements});
  const Shell  model(
       split::SurfaceStretch<material::NeoHooke, material::Canham>(
          material::NeoHooke(material::surface_moduli(100., .3)), material::Canham(1.), {.thickness = .01}),
       degradation::Cubic(), {}, Toughness<3>(1e6), 1., 1.);
  ShellSpace<2, 3>  space(env, surface);
  Supports          supports;
  const Loads<3>    loads;
  const State<2, 3> rest(space);
  for (const auto *edge : {"left", "right", "bottom", "top"})
    supports.fix(edge);
  const auto   mode   = vibration_modes(model, space, supports, rest, {.n_modes = 1}).front();
  const double period = 2. * M_PI / mode.omega;
  const auto   centre = evaluate(surface, SurfacePlace{0, .5 * prm.plate.elements, .5 * prm.plate.elements});
  const double height = value_at(centre, mode.shape, 2);
  if (env.rank() == 0)
    std::cout << "plate: omega = " << mode.omega << " on this mesh, " << mode.omega / (2. * M_PI * M_PI) - 1.
              << " above the exact one" << std::endl;

  for (const auto &scheme : schemes)
    for (const int n : prm.plate.steps_per_period)
      {
        if (prm.scheme != "all" && prm.scheme != scheme.name)
          continue;
        if (!scheme.integrator && n != prm.plate.steps_per_period.front())
          continue; // the stable step is its own
        with_solver(scheme, model, space, supports, loads, prm.newton, [&](auto &solver) {
          auto state = rest;
          axpy(amplitude / height, mode.shape, state.position);
          solver.rebuild(state);
          solver.set_initial_acceleration(state);
          StepController controller({.initial = period / n, .rule = StepRule::fixed});
          Counts         counts;
          Crossings      crossings;
          const double   start = solver.energies(state).elastic();
          const auto     book =
              follow(env, solver, state, controller, prm.plate.periods * period, counts,
                     [&](const State<2, 3> &at, const EnergyBalance &so_far) {
                       const double w = value_at(centre, at.position, 2), v = value_at(centre, at.velocity, 2);
                       crossings.add(at.time, w, v);
                       on_root(tables.comm, [&] {
                         tables.plate->append(CsvRow() << scheme.name << n << at.time / period << w / amplitude
                                                       << v / (amplitude * mode.omega) << so_far.dissipation() / start);
                       });
                     });
          const double error = mode.omega / crossings.frequency() - 1.;
          on_root(tables.comm, [&] {
            tables.runs->append(CsvRow() << "plate" << scheme.name << "fixed" << n << counts.steps << counts.newton
                                         << counts.rejected << state.time / period << error
                                         << book.dissipation() / start << book.closure() << counts.failure);
            std::cout << "plate, " << scheme.name << ", " << n << " steps a period: period " << error << " too long, "
                      << book.dissipation() / start << " of the energy lost" << std::endl;
          });
        });
      }
}

// A shallow cylindrical roof, hinged along its straight edges, pushed down at its centre beyond the load that it can
// carry: it snaps through to the other side and swings there. A quarter by symmetry.
void cylinder(const Environment &env, const Parameters &prm, const OutputDirectory &directory, Tables &tables)
{
  const double     thickness = 6.35, E = 3102.75, nu = .3, density = 1.2e-9; // of the solid, t/mm^3
  const auto      &settings = prm.cylinder;
  const int        n        = settings.elements;
  const auto       surface  = shapes::roof<2>(2540., 508., .1, {n, n}, shapes::Fit::exact, shapes::Part::quarter);
  const auto       laws     = material::neo_hooke_canham_shell(E, nu, thickness);
  const Shell      model(split::SurfaceStretch<material::NeoHooke, material::Canham>(laws.membrane, laws.bending,
                                                                                {.thickness = thickness}),
                         degradation::Cubic(), {}, Toughness<3>(1e9), 100., density * thickness);
  ShellSpace<2, 3> space(env, surface);
  Supports         supports;
  supports.fix("top");
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  Loads<3> loads;
  loads.point_load({254., 0., 2540.},
                   [&](double t) { return Point<3>(0., 0., -settings.force / 4. * std::min(1., t / settings.ramp)); });
  const auto centre = evaluate(surface, SurfacePlace{0, 1. * n, 0.});

  const auto run = [&](const Scheme &scheme, const std::string &rule, const StepControlSettings &steps, bool frames) {
    with_solver(scheme, model, space, supports, loads, prm.newton, [&](auto &solver) {
      State<2, 3> state(space);
      solver.rebuild(state);
      StepController             controller(steps);
      Counts                     counts;
      std::optional<FrameWriter> writer;
      if (frames)
        on_root(tables.comm, [&] { writer.emplace(directory.path()); });
      EnergyBalance book(solver.energies(state));
      const auto    observe = [&](const State<2, 3> &at, const EnergyBalance &so_far) {
        book                    = so_far;
        const auto   energies   = so_far.state().now;
        const double deflection = 2540. - value_at(centre, at.position, 2);
        const auto   all        = snapshot(at);
        const auto  &times      = steps.times;
        on_root(tables.comm, [&] {
          tables.cylinder->append(CsvRow() << scheme.name << rule << at.time << at.step_size << deflection
                                              << energies.membrane() << energies.bending << energies.kinetic
                                              << so_far.external_work() << so_far.dissipation());
          if (writer && (at.step == 0 || std::find(times.begin(), times.end(), at.time) != times.end()))
            writer->write(surface, all);
        });
      };
      try
        {
          follow(env, solver, state, controller, settings.end, counts, observe);
        }
      catch (const NoConvergence &)
        {
          counts.failure = "no step converges"; // a scheme that gains energy ends here
        }
      on_root(tables.comm, [&] {
        tables.runs->append(CsvRow() << "cylinder" << scheme.name << rule << 0 << counts.steps << counts.newton
                                     << counts.rejected << state.time << 0. << book.dissipation() << book.closure()
                                     << counts.failure);
        std::cout << "cylinder, " << scheme.name << ", steps " << rule << ": " << counts.steps << " steps, "
                  << book.dissipation() << " N mm lost, until t = " << state.time << " ("
                  << (counts.failure == "-" ? "done" : counts.failure) << ")" << std::endl;
      });
    });
  };
  const std::string usual = "generalized_alpha_0.8";
  for (const auto &scheme : schemes)
    if (scheme.integrator && (prm.scheme == "all" || prm.scheme == scheme.name))
      {
        run(scheme, "fixed", settings.steps, scheme.name == usual || prm.scheme == scheme.name);
        if (scheme.name != usual)
          continue;
        // The same scheme with steps that follow the number of iterations (paper Eq. (13)) or the estimated error.
        auto steps = settings.steps;
        steps.rule = StepRule::newton;
        run(scheme, "newton", steps, false);
        steps.rule = StepRule::error;
        run(scheme, "error", steps, false);
      }
}

void move_shells(const Environment &env, const Parameters &prm)
{
  refuse_restart(env);
  if (prm.plate.elements % 2 != 0)
    throw InvalidParameter("plate.elements = " + std::to_string(prm.plate.elements) +
                           ", expected an even number, so that a corner of elements lies in the centre");
  OutputDirectory directory(env);
  if (env.command_line().check)
    return;
  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  Tables tables(env, directory);
  plate(env, prm, tables);
  cylinder(env, prm, directory, tables);
}

} // namespace step_4

int main(int argc, char **argv)
{
  return run<step_4::Parameters>(argc, argv, step_4::move_shells);
}
