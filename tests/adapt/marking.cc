#include <catch2/catch.hpp>

#include <set>

#include <sherd/adapt/marking.h>
#include <sherd/forms/brittle_shell.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/surface_stretch.h>

using namespace sherd;

namespace
{

using Split = split::SurfaceStretch<material::NeoHooke>;
template <class Degradation>
using Glass = BrittleShell<2, 2, Split, Degradation, crack_density::FourthOrder>;

template <class Degradation>
Glass<Degradation> glass()
{
  return {Split(material::NeoHooke(material::surface_moduli(1., .2))), Degradation(), {}, 1., 1., 1.};
}

/// A plate of 8 x 4 elements of 2 x 1 whose functions are all coarse for the target 1/2.
struct Plate
{
  Environment        env{MPI_COMM_WORLD};
  Surface<2, 2>      surface = shapes::plate<2, 2>({16., 4.}, {8, 4});
  ShellSpace<2, 2>   space{env, surface};
  State<2, 2>        state{space};
  RefinementSettings settings{.target = .5};
  SpanTarget         target = span_target(surface, .5);

  template <class Degradation = degradation::Cubic>
  Triggers<2> triggers() const
  {
    const auto                                     model = glass<Degradation>();
    const Assembler<std::decay_t<decltype(model)>> assembler(model, space, state.distribution);
    return find_triggers(assembler, state, target, settings);
  }
};

} // namespace

TEST_CASE("A length on the surface becomes a span of the parameters")
{
  // Unit spans are 2 and 1 long.
  const Plate plate;
  CHECK(plate.target.length[0] == Approx(.25).epsilon(1e-8));
  CHECK(plate.target.length[1] == Approx(.5).epsilon(1e-8));
  // The target is met by spans of exactly that length.
  CHECK(plate.target.length[0] >= .25);
  CHECK(plate.target.length[1] >= .5);
}

TEST_CASE("A function is coarse while one of its spans is longer than the target")
{
  auto       surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  const auto count   = [&](double length) { return coarse_points(surface, span_target(surface, length)).size(); };
  CHECK(count(1.) == 0);
  CHECK(count(.999) == 36);
  CHECK(count(2.) == 0);

  // Refinement of one corner element leaves only those functions coarse that reach beyond it.
  const auto target = span_target(surface, .5);
  surface.refine({0}, target);
  const auto coarse = coarse_points(surface, target);
  CHECK(coarse.size() < static_cast<std::size_t>(surface.n_control_points()));
  CHECK_FALSE(coarse.empty());
  for (const int point : coarse)
    {
      const auto &knots = surface.patch(0).basis.function(point).knots;
      CHECK(std::max(knots[0].back(), knots[1].back()) > 1.);
    }
}

TEST_CASE("Points of a surface are within reach of a control point")
{
  const Plate plate;
  const auto  X = plate.surface.control_points();
  for (double x = 0.; x <= 16.; x += .37)
    for (double y = 0.; y <= 4.; y += .23)
      {
        bool reached = false;
        for (int point = 0; point < plate.surface.n_control_points(); ++point)
          reached = reached || (X.row(point).transpose() - Point<2>(x, y)).norm() <=
                                   .5 * reach(plate.surface.patch(0).basis.function(point), plate.target);
        CHECK(reached);
      }
  // Half the diagonal of a 2 x 1 element.
  CHECK(.5 * reach(plate.surface.patch(0).basis.function(30), plate.target) == Approx(.5 * std::sqrt(5.)));
}

TEST_CASE("Nothing triggers in an intact plate at rest")
{
  CHECK(Plate().triggers().empty());
}

TEST_CASE("A control value below the threshold triggers, at its control point")
{
  Plate     plate;
  const int a   = 17;
  auto      phi = plate.state.phase.local();
  phi[a]        = .976;
  CHECK(plate.triggers().empty());
  phi[a]              = .974;
  phi[3]              = .98;
  const auto triggers = plate.triggers();
  REQUIRE(triggers.positions.size() == 1);
  const auto point = plate.state.distribution->global(a);
  CHECK(triggers.positions[0] == plate.surface.control_points().row(point).transpose());
  CHECK(triggers.smallest_phase == .974);
}

TEST_CASE("Functions that are fine enough do not trigger")
{
  Plate plate;
  plate.state.phase.fill(.1);
  CHECK(plate.triggers().positions.size() == 60);
  plate.target = span_target(plate.surface, 2.);
  CHECK(plate.triggers().empty());
}

TEST_CASE("A driving energy close to the onset triggers all functions of its element")
{
  Plate        plate;
  const double onset              = 1. / 12.; // theory C.2; s = 1e-4 shifts it by 1e-4
  plate.settings.history_fraction = .5;
  plate.state.history[5][4]       = .499 * onset;
  CHECK(plate.triggers().empty());
  plate.state.history[5][4] = .501 * onset;
  CHECK(plate.triggers().positions.size() == 9);
  CHECK(plate.triggers().smallest_phase == 1.);
  // The quadratic function has no onset: phi itself tells.
  CHECK(plate.triggers<degradation::Quadratic>().empty());
}

TEST_CASE("The halo takes coarse functions whose control point is near")
{
  const Plate                 plate;
  const auto                  X       = plate.surface.control_points();
  const std::vector<Point<2>> centres = {Point<2>(7., 2.5), Point<2>(1., .5)};
  for (const double radius : {0., .5, 1., 2.3})
    {
      const auto          near = coarse_points_near(plate.surface, plate.target, centres, radius);
      const std::set<int> marked(near.begin(), near.end());
      for (int point = 0; point < plate.surface.n_control_points(); ++point)
        {
          const Point<2> x      = X.row(point).transpose();
          const bool     inside = (x - centres[0]).norm() <= radius || (x - centres[1]).norm() <= radius;
          CHECK((marked.count(point) == 1) == inside);
        }
    }
  CHECK(coarse_points_near(plate.surface, span_target(plate.surface, 2.), centres, 10.).empty());
}
