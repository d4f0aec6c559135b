// label: verification
// ranks: 1 2
#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/time/newmark.h>

#include "body.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// The left edge is a plane of symmetry: u_x = 0, and u_y is level across it.
Supports symmetric()
{
  Supports supports;
  supports.symmetry("left", Component::x);
  return supports;
}

template <class SomeBody, class Velocity>
void set_velocity(SomeBody &body, const Velocity &velocity)
{
  for (int a = 0; a < body.state.distribution->n_local(); ++a)
    {
      const Point<2> v = velocity(body.reference(a));
      for (int d = 0; d < 2; ++d)
        body.state.velocity.local()[a * 2 + d] = v[d];
    }
}

Point<2> allowed(const Point<2> &X)
{
  return {X[0] * std::cos(X[1]), 1. + X[1]};
}

} // namespace

TEMPLATE_TEST_CASE("An initial velocity that supports do not allow is refused, and completed on request", "",
                   (Body<Glass, GeneralizedAlpha>), (Body<Glass, AnyIntegrator, StaggeredSolver<Glass, AnyIntegrator>>),
                   (Body<Glass, CentralDifference, ExplicitSolver<Glass>>))
{
  const auto make = [](const Supports &supports) {
    if constexpr (std::is_same_v<TestType, Body<Glass, CentralDifference, ExplicitSolver<Glass>>>)
      return std::make_unique<TestType>(unbreakable.model(), std::array{2., 1.}, std::array{4, 2}, tight(), supports,
                                        Loads<2>(), CentralDifference());
    else
      return std::make_unique<TestType>(unbreakable.model(), std::array{2., 1.}, std::array{4, 2}, tight(), supports,
                                        Loads<2>(), GeneralizedAlpha(.5));
  };
  const auto body  = make(symmetric());
  const auto start = [&] { body->solver.set_initial_acceleration(body->state); };

  set_velocity(*body, allowed);
  const auto given = gather(body->state.velocity);
  CHECK_NOTHROW(start());
  body->solver.complete_velocity(body->state);
  CHECK(gather(body->state.velocity) == given);

  set_velocity(*body, [](const Point<2> &) { return Point<2>(1., 0.); });
  CHECK_THROWS_AS(start(), InvalidParameter);
  CHECK_THROWS_WITH(start(), Catch::Contains("component x is 1") && Catch::Contains("(0,") &&
                                 Catch::Contains("expected 0 by the support of") && Catch::Contains("left") &&
                                 Catch::Contains("complete_velocity"));

  set_velocity(*body, [](const Point<2> &X) { return Point<2>(X[0], 1. + X[0]); });
  CHECK_THROWS_WITH(start(), Catch::Contains("component y is 1 ") && Catch::Contains("a tie of a symmetric edge"));
  const auto uneven = gather(body->state.velocity);
  body->solver.complete_velocity(body->state);
  CHECK_NOTHROW(start());
  const auto completed = gather(body->state.velocity);
  const auto X         = body->surface.control_points();
  double     inside    = 1.; // X of the second row
  for (int a = 0; a < X.rows(); ++a)
    if (X(a, 0) > 0.)
      inside = std::min(inside, X(a, 0));
  for (int a = 0; a < X.rows(); ++a)
    {
      CHECK(completed[2 * a] == uneven[2 * a]);
      CHECK(completed[2 * a + 1] == Approx(X(a, 0) > 0. ? uneven[2 * a + 1] : 1. + inside).epsilon(1e-14));
    }

  // The rates of an edge that is moved come from its path.
  Supports pulled;
  pulled.prescribe("left", Component::x, [](double t) { return -t; });
  const auto moved = make(pulled);
  set_velocity(*moved, [](const Point<2> &) { return Point<2>(.5, 0.); });
  CHECK_NOTHROW(moved->solver.set_initial_acceleration(moved->state));
  const auto before = gather(moved->state.velocity);
  moved->solver.complete_velocity(moved->state);
  CHECK(gather(moved->state.velocity) == before);
}

TEST_CASE("A plate with a completed velocity keeps its energy")
{
  // So small that the plate is linear; its energy is then a constant of the trapezoidal rule.
  Body<Glass, Newmark> body(unbreakable.model(), {2., 1.}, {4, 2}, tight(), symmetric(), {}, Newmark(.25, .5));
  set_velocity(body, [](const Point<2> &X) { return Point<2>(1e-4 * std::cos(X[0]), 1e-4 * std::exp(X[0]) * X[1]); });
  body.solver.complete_velocity(body.state);
  body.solver.set_initial_acceleration(body.state);
  const double start = body.energies().kinetic;
  for (int i = 0; i < 40; ++i)
    take(body, 1e-3);
  const auto end = body.energies();
  CHECK(end.elastic() > .01 * start);
  CHECK(end.elastic() + end.kinetic == Approx(start).epsilon(1e-5));
}
