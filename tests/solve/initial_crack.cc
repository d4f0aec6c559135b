// label: verification
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include "body.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Places of a plate by their coordinates, which are multiples of 1e-9.
std::pair<long, long> place(const Point<2> &X)
{
  return {std::lround(X[0] * 1e9), std::lround(X[1] * 1e9)};
}

} // namespace

TEST_CASE("A pre-crack through a strip costs its toughness wherever it lies on the mesh")
{
  // theory D: 1.006 to 1.027 at h = l0/2, 1.002 to 1.014 at h = l0/4. The ends of the crack at the free edges cost less
  // than its middle (lap phi = 0 there); the difference of two lengths leaves the middle alone.
  struct Mesh
  {
    double h, tolerance;
  };
  const auto mesh = GENERATE(Mesh{.5, .03}, Mesh{.25, .015});
  const auto cost = [&](double x, int length) {
    Body<Glass> body(Units().model(), {16., 1. * length}, {static_cast<int>(16. / mesh.h), length});
    body.crack(PreCrack<2>({Segment<2>{{x, -5.}, {x, length + 5.}}}, 1.));
    body.solver.equilibrate_phase(body.state);
    CHECK(std::abs(body.smallest_phase()) < .06);
    return body.energies().fracture;
  };
  double least = 2., most = 0.;
  for (const double position : {0., .1, .25, .4, .5, .7})
    {
      const double x         = 8. + position * mesh.h;
      const double by_length = (cost(x, 12) - cost(x, 8)) / 4.;
      CAPTURE(mesh.h, position);
      CHECK(by_length == Approx(1.).margin(mesh.tolerance));
      least = std::min(least, by_length);
      most  = std::max(most, by_length);
    }
  CHECK(most > least + 1e-3);
}

TEST_CASE("A symmetric pre-crack has a symmetric phase, before and after it opens")
{
  Supports supports;
  supports.prescribe("top", Component::y, [](double t) { return .25 * t; });
  supports.prescribe("bottom", Component::y, [](double t) { return -.25 * t; });
  NewtonSettings settings = tight();
  Body<Glass>    body(Units().model(), {8., 8.}, {16, 16}, settings, supports);
  body.crack(PreCrack<2>({Segment<2>{{-3., 4.}, {4., 4.}}}, 1.));

  // Bits of the history agree in mirrored points, although the strip ends between Gauss points.
  std::map<std::pair<long, long>, double> history;
  for (int e = 0; e < body.space.n_active_elements(); ++e)
    for (int q = 0; q < body.state.n_q; ++q)
      history[place(body.solver.assembler().quadrature_position(e, q))] = body.state.history[e][q];
  REQUIRE(history.size() == 16u * 16u * 9u);
  for (const auto &[X, H] : history)
    CHECK(history.at({X.first, std::lround(8e9) - X.second}) == H);

  const auto asymmetry = [&] {
    std::map<std::pair<long, long>, double> phase;
    for (int a = 0; a < body.state.distribution->n_owned(); ++a)
      phase[place(body.reference(a))] = body.state.phase.local()[a];
    double largest = 0.;
    for (const auto &[X, phi] : phase)
      largest = std::max(largest, std::abs(phase.at({X.first, std::lround(8e9) - X.second}) - phi));
    return largest;
  };
  body.solver.equilibrate_phase(body.state);
  CHECK(asymmetry() < 1e-9);
  for (int i = 0; i < 3; ++i)
    {
      auto result = body.solver.attempt(body.state, .01);
      INFO(result.failure);
      REQUIRE(result.state);
      body.state = *result.state;
    }
  CHECK(asymmetry() < 1e-8);
}
