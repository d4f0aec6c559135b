// label: verification
// ranks: 1 2
#include <catch2/catch.hpp>

#include <cmath>
#include <string>

#include <sherd/time/bathe.h>
#include <sherd/time/wbz.h>

#include "body.h"

using namespace sherd;
using namespace sherd::test;

static_assert(StepSolver<MonolithicSolver<Glass, GeneralizedAlpha>>);
static_assert(StepSolver<StaggeredSolver<Glass, AnyIntegrator>>);
static_assert(StepSolver<ExplicitSolver<Glass>>);

namespace
{

/// A plate with a crack from its left edge to its centre, pulled apart.
template <class Solver>
struct Torn : Body<Glass, AnyIntegrator, Solver>
{
  static Supports pull()
  {
    // The speed is reached after 0.02: a jump would be a shock of unlimited acceleration.
    const auto travel = [](double t) { return .5 * (t < .02 ? t * t / .04 : t - .01); };
    Supports   supports;
    supports.prescribe("top", Component::y, travel);
    supports.prescribe("bottom", Component::y, [=](double t) { return -travel(t); });
    return supports;
  }

  Torn(const NewtonSettings &settings, const AnyIntegrator &integrator)
      : Body<Glass, AnyIntegrator, Solver>(Units().model(), {8., 6.}, {12, 9}, settings, pull(), {}, integrator)
  {
    this->crack(PreCrack<2>({Segment<2>{{-3., 3.}, {4., 3.}}}, 1.));
    this->solver.equilibrate_phase(this->state);
  }

  /// Positions and phase after steps in which the crack opens and damage grows, and what they took.
  struct Outcome
  {
    std::vector<double> position, phase;
    double              growth; ///< of the fracture energy
    int                 newton = 0, alternations = 0;
    std::int64_t        tangents;
  };
  Outcome run()
  {
    Outcome      outcome;
    const double before = this->energies().fracture;
    const auto   count  = [&] { return this->solver.timers().statistics(MPI_COMM_WORLD)["assembly"].calls; };
    const auto   start  = count();
    for (int step = 0; step < 6; ++step)
      {
        const auto result = this->solver.attempt(this->state, .005);
        INFO(result.failure);
        REQUIRE(result.state);
        this->state = *result.state;
        outcome.newton += result.newton;
        outcome.alternations += result.alternations;
      }
    outcome.position = gather(this->state.position);
    outcome.phase    = gather(this->state.phase);
    outcome.growth   = this->energies().fracture - before;
    outcome.tangents = count() - start;
    return outcome;
  }
};

using Monolithic = Torn<MonolithicSolver<Glass, AnyIntegrator>>;
using Staggered  = Torn<StaggeredSolver<Glass, AnyIntegrator>>;

double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
{
  double largest = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

NewtonSettings settings(TangentRule tangent = TangentRule::full, Globalisation globalisation = Globalisation::none)
{
  NewtonSettings s         = tight();
  s.displacement_tolerance = 1e-8;
  s.phase_tolerance        = 1e-8;
  s.max_iterations         = 60; // lagged tangents converge linearly
  s.alternation            = {.max_alternations = 2000};
  s.tangent                = tangent;
  s.globalisation          = globalisation;
  return s;
}

} // namespace

TEST_CASE("All nonlinear solvers find the same steps of a cracking plate")
{
  const AnyIntegrator integrator = GeneralizedAlpha(.5);
  const auto          newton     = Monolithic(settings(), integrator).run();
  REQUIRE(newton.growth > .3); // of the energy of a crack of one length scale

  const auto check = [&](const std::string &name, const auto &other) {
    CAPTURE(name, newton.newton, other.newton, newton.tangents, other.tangents, other.alternations);
    // The plate is opened by 0.02, the phase falls by about one.
    CHECK(largest_difference(newton.position, other.position) < 1e-8);
    CHECK(largest_difference(newton.phase, other.phase) < 1e-5);
  };
  const auto line_search = Monolithic(settings(TangentRule::full, Globalisation::line_search), integrator).run();
  check("line search", line_search);
  const auto lagged = Monolithic(settings(TangentRule::lagged_history), integrator).run();
  check("lagged history", lagged);
  const auto modified = Monolithic(settings(TangentRule::modified), integrator).run();
  check("modified", modified);
  CHECK(modified.tangents < newton.tangents);

  const auto aitken = Staggered(settings(), integrator).run();
  check("staggered", aitken);
  auto plain                   = settings();
  plain.alternation.relaxation = Relaxation::none;
  const auto unrelaxed         = Staggered(plain, integrator).run();
  check("staggered without relaxation", unrelaxed);
  CHECK(aitken.alternations < unrelaxed.alternations);
}

TEST_CASE("Solvers agree under an integrator of two stages, too")
{
  const auto monolithic = Monolithic(settings(), Bathe()).run();
  const auto staggered  = Staggered(settings(), Bathe()).run();
  CHECK(monolithic.growth > .3);
  CHECK(largest_difference(monolithic.position, staggered.position) < 1e-8);
  CHECK(largest_difference(monolithic.phase, staggered.phase) < 1e-5);
}

TEST_CASE("A tangent of the phase, which has no mass, serves steps of every size")
{
  const auto                              modified = settings(TangentRule::modified);
  Monolithic                              body(modified, GeneralizedAlpha(.5)); // at rest, its phase in equilibrium
  StepEquations<Glass>                    equations(body.model, body.space, body.supports, body.loads, modified);
  NewtonIteration<Glass, Unknowns::phase> newton(modified);
  equations.rebuild(body.state);
  newton.rebuild(equations);
  Vector disturbed = body.state.phase;
  scale(.999, disturbed);
  const auto n_tangents = [&](double dt) {
    const auto count  = [&] { return equations.timers().statistics(MPI_COMM_WORLD)["assembly"].calls; };
    const auto before = count();
    auto       system = equations.phase_system(body.state.position, disturbed, body.state.history);
    system.stage.dt   = dt;
    StepResult<2, 2> result;
    REQUIRE(newton.find_stable_state(equations, system, result));
    CHECK(largest_difference(gather(system.phase), gather(body.state.phase)) < 1e-6);
    return count() - before;
  };
  CHECK(n_tangents(.1) > 0);
  CHECK(n_tangents(.1) == 0);
  CHECK(n_tangents(.05) == 0);
}

TEST_CASE("A failed step leaves nothing behind, also after its first stage")
{
  const auto outcome = [](bool with_failures) {
    Monolithic body(settings(), Bathe());
    for (const double dt : {.005, .005})
      {
        if (with_failures)
          {
            // Supports that go nowhere from the middle of the step on: the first stage succeeds.
            auto bad      = body.supports;
            body.supports = Supports();
            body.supports.prescribe("top", Component::y, [t = body.state.time, dt](double time) {
              return time > t + .9 * dt ? std::nan("") : 0.;
            });
            body.supports.prescribe("bottom", Component::y, [](double) { return 0.; });
            body.solver.rebuild(body.state);
            const auto result = body.solver.attempt(body.state, dt);
            CHECK_FALSE(result.state);
            CHECK_FALSE(result.failure.empty());
            body.supports = bad;
          }
        body.solver.rebuild(body.state);
        const auto result = body.solver.attempt(body.state, dt);
        REQUIRE(result.state);
        body.state = *result.state;
      }
    return gather(body.state.phase);
  };
  const auto clean = outcome(false), disturbed = outcome(true);
  CHECK(largest_difference(clean, disturbed) == 0.);
}

TEST_CASE("A staggered step that does not settle is refused, with the reason")
{
  auto few                         = settings();
  few.alternation.max_alternations = 1;
  Staggered  body(few, WBZ(.5));
  const auto result = body.solver.attempt(body.state, .02);
  CHECK_FALSE(result.state);
  CHECK(result.alternations == 1);
  CHECK_THAT(result.failure, Catch::Contains("do not agree after 1 alternations"));
}
