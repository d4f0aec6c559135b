// label: verification
#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// The plate of CrackingPlate cut in two by x = 4, where its crack will run across; the second part is turned around.
Surface<2, 2> cut_plate()
{
  const auto part = [](double from, double to, int n) {
    return bilinear<2, 2>({Point<2>(from, 0.), Point<2>(to, 0.), Point<2>(from, 24.), Point<2>(to, 24.)},
                          equal_knots<2>(n, 0., n), equal_knots<2>(12, 0., 12.));
  };
  const std::vector<Patch<2, 2>> patches{part(0., 4., 2), reoriented(part(4., 10., 3), 5)};
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
  CrackingPlate            whole(MPI_COMM_WORLD, refinement);
  const auto               expected = run(whole);
  REQUIRE(expected.tip > 5.);

  for (const auto &continuity : {Continuity(continuity::Penalty()), Continuity(continuity::LagrangeMultiplier())})
    {
      CrackingPlate cut(MPI_COMM_WORLD, cut_plate(), continuity, refinement);
      REQUIRE(cut.plate.interfaces().size() == 1);
      const auto found = run(cut);
      INFO("fracture energy " << found.fracture << " of " << expected.fracture << ", tip at " << found.tip << " of "
                              << expected.tip);
      CHECK(found.fracture == Approx(expected.fracture).epsilon(.01));
      CHECK(found.tip == Approx(expected.tip).margin(.5));
      CHECK(cut.largest_edge([&](const Point<2> &X) { return std::abs(X[1] - 12.) < 1. && X[0] < found.tip; }) ==
            Approx(.5));
    }
}
