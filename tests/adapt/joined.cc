// label: verification
#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// The plate of CrackingPlate cut in two by the line from (bottom, 0) to (top, 24), where its crack will run across;
/// the parameters of the second part run in another way. n[0] + n[1] elements along it.
Surface<2, 2> cut_plate(double bottom, double top, std::array<int, 2> n, int way)
{
  const auto part = [](double a, double b, double c, double d, int n_along) {
    return bilinear<2, 2>({Point<2>(a, 0.), Point<2>(b, 0.), Point<2>(c, 24.), Point<2>(d, 24.)},
                          equal_knots<2>(n_along, 0., n_along), equal_knots<2>(12, 0., 12.));
  };
  const std::vector<Patch<2, 2>> patches{part(0., bottom, 0., top, n[0]),
                                         reoriented(part(bottom, 10., top, 10., n[1]), way)};
  const auto                     at_height = [&](double y) {
    return sides_where(patches, [=](const Point<2> &X) { return std::abs(X[1] - y) < 1e-9; });
  };
  return {patches, {{"bottom", at_height(0.)}, {"top", at_height(24.)}}, find_interfaces(patches)};
}

/// What the crack has cost by the end, and how far it has come.
struct Outcome
{
  double fracture, tip;
};

Outcome run(CrackingPlate &body)
{
  body.prepare();
  while (body.state.time < .26)
    body.advance(.26);
  Outcome    outcome{body.energies().fracture, 0.};
  const auto all = snapshot(body.state);
  for (int point = 0; point < body.plate.n_control_points(); ++point)
    if (const Point<2> X = body.plate.control_points().row(point).transpose();
        all.phase[point] < .1 && std::abs(X[1] - 12.) < .6)
      outcome.tip = std::max(outcome.tip, X[0]);
  return outcome;
}

} // namespace

TEST_CASE("A crack crosses an interface as if it were not there")
{
  const RefinementSettings refinement{.target = .5, .halo = 1.};
  static const auto        expected = [&] {
    CrackingPlate whole(MPI_COMM_WORLD, refinement);
    return run(whole);
  }();
  REQUIRE(expected.tip > 5.);

  const auto compare = [&](const Surface<2, 2> &surface, const Continuity &continuity, double tolerance) {
    CrackingPlate cut(MPI_COMM_WORLD, surface, continuity, refinement);
    REQUIRE(cut.plate.interfaces().size() == 1);
    const auto found = run(cut);
    INFO("fracture energy " << found.fracture << " of " << expected.fracture << ", tip at " << found.tip << " of "
                            << expected.tip);
    CHECK(found.fracture == Approx(expected.fracture).epsilon(tolerance));
    CHECK(found.tip == Approx(expected.tip).margin(.5));
    CHECK(cut.largest_edge([&](const Point<2> &X) { return std::abs(X[1] - 12.) < 1. && X[0] < found.tip - .5; }) < .7);
  };
  const auto at_4 = cut_plate(4., 4., {2, 3}, 5);
  SECTION("by either method")
  {
    compare(at_4, continuity::Penalty(), .01);
    compare(at_4, continuity::LagrangeMultiplier(), .01);
  }
  SECTION("whatever the factor of the penalty")
  {
    compare(at_4, continuity::Penalty{0., .1 * continuity::phase_penalty_factor}, .01);
    compare(at_4, continuity::Penalty{0., 10. * continuity::phase_penalty_factor}, .01);
  }
  SECTION("wherever it lies")
  {
    compare(cut_plate(6., 6., {3, 2}, 2), continuity::LagrangeMultiplier(), .01);
  }
  SECTION("at an angle")
  {
    compare(cut_plate(2.9, 4.9, {2, 4}, 6), continuity::Penalty(), .03);
  }
}
