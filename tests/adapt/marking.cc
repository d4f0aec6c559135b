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
  Environment             env{MPI_COMM_WORLD};
  Surface<2, 2>           surface = shapes::plate<2, 2>({16., 4.}, {8, 4});
  ShellSpace<2, 2>        space{env, surface};
  State<2, 2>             state{space};
  RefinementSettings      settings{.target = .5};
  std::vector<SpanTarget> targets = span_targets(surface, .5);

  template <class Degradation = degradation::Cubic>
  Triggers<2> triggers() const
  {
    const auto                                     model = glass<Degradation>();
    const Assembler<std::decay_t<decltype(model)>> assembler(model, space, state.distribution);
    return find_triggers(assembler, state, targets, settings);
  }
};

} // namespace

TEST_CASE("A length on the surface becomes a span of the parameters")
{
  // Unit spans are 2 and 1 long.
  const Plate plate;
  CHECK(plate.targets[0].length[0] == Approx(.25).epsilon(1e-8));
  CHECK(plate.targets[0].length[1] == Approx(.5).epsilon(1e-8));
  // The target is met by spans of exactly that length.
  CHECK(plate.targets[0].length[0] >= .25);
  CHECK(plate.targets[0].length[1] >= .5);
}

TEST_CASE("A function is coarse while one of its spans is longer than the target")
{
  auto       surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  const auto count   = [&](double length) { return coarse_points(surface, span_targets(surface, length)).size(); };
  CHECK(count(1.) == 0);
  CHECK(count(.999) == 36);
  CHECK(count(2.) == 0);

  // Refinement of one corner element leaves only those functions coarse that reach beyond it.
  const auto targets = span_targets(surface, .5);
  surface.refine_to({0}, targets);
  const auto coarse = coarse_points(surface, targets);
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
                                   .5 * reach(plate.surface.patch(0).basis.function(point), plate.targets[0]);
        CHECK(reached);
      }
  // Half the diagonal of a 2 x 1 element.
  CHECK(.5 * reach(plate.surface.patch(0).basis.function(30), plate.targets[0]) == Approx(.5 * std::sqrt(5.)));
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
  phi[3]              = .986;
  const auto triggers = plate.triggers();
  REQUIRE(triggers.positions.size() == 1);
  const auto point = plate.state.distribution->global(a);
  CHECK(triggers.positions[0] == plate.surface.control_points().row(point).transpose());
  CHECK(triggers.smallest_phase == .974);
}

TEST_CASE("What would follow soon is refined along, and nothing where nothing triggers")
{
  Plate plate;
  auto  phi = plate.state.phase.local();
  phi[3]    = .98;
  CHECK(plate.triggers().empty());
  phi[17] = .97;
  CHECK(plate.triggers().positions.size() == 2);
  plate.settings.phase_with = plate.settings.phase; // the paper's literal rule
  CHECK(plate.triggers().positions.size() == 1);
}

TEST_CASE("Functions that are fine enough do not trigger")
{
  Plate plate;
  plate.state.phase.fill(.1);
  CHECK(plate.triggers().positions.size() == 60);
  plate.targets = span_targets(plate.surface, 2.);
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
  const Plate plate;
  const auto  X = plate.surface.control_points();
  Triggers<2> triggers;
  triggers.positions = {Point<2>(7., 2.5), Point<2>(1., .5)};
  for (const double radius : {0., .5, 1., 2.3})
    {
      triggers.radii           = {radius, .5 * radius};
      const auto          near = coarse_points_near(plate.surface, plate.targets, triggers, .4);
      const std::set<int> marked(near.begin(), near.end());
      for (int point = 0; point < plate.surface.n_control_points(); ++point)
        {
          const Point<2> x      = X.row(point).transpose();
          const bool     inside = (x - triggers.positions[0]).norm() <= std::max(radius, .4) ||
                              (x - triggers.positions[1]).norm() <= std::max(.5 * radius, .4);
          CHECK((marked.count(point) == 1) == inside);
        }
    }
  triggers.radii = {10., 10.};
  CHECK(coarse_points_near(plate.surface, span_targets(plate.surface, 2.), triggers, .4).empty());
}

TEST_CASE("A front is as fast as its level set moves")
{
  // phi = 1 - (1 + s) exp(-s), s = (x - v t) / l0, at a fixed place ahead of the front: exactly v s / (1 + s).
  const double l0 = .3, v = 2., dt = 1e-6;
  const auto   phase = [&](double x) { return 1. - (1. + x / l0) * std::exp(-x / l0); };
  for (const double s : {5., 6., 8.})
    CHECK(front_speed(phase(s * l0), phase(s * l0 - v * dt), dt, l0) == Approx(v * s / (1. + s)).epsilon(1e-4));
  CHECK(front_speed(.97, .97, dt, l0) == 0.);
  CHECK(front_speed(.96, .97, dt, l0) == 0.); // it heals nowhere near
  CHECK(front_speed(1.01, 1., dt, l0) == 0.);
}

TEST_CASE("A trigger looks ahead in proportion to the speed of its front, at most as far as the halo")
{
  Plate plate;
  plate.settings.halo    = 1.5;
  plate.state.step_size  = 1.;
  const auto   model     = glass<degradation::Cubic>();
  const double fast      = .6 * wave_speeds(model.split.bulk(), model.split.shear(), model.mass).rayleigh;
  auto         phi       = plate.state.phase.local();
  auto         before    = plate.state.previous_phase.local();
  const double part[3]   = {0., .4, 7.};
  const int    points[3] = {8, 17, 30};
  for (int k = 0; k < 3; ++k)
    {
      phi[points[k]]    = .9;
      before[points[k]] = .9 + .1 * part[k] * fast; // l0 = 1
    }
  const auto triggers = plate.triggers();
  REQUIRE(triggers.radii.size() == 3);
  for (std::size_t t = 0; t < 3; ++t)
    for (int k = 0; k < 3; ++k)
      if (triggers.positions[t] ==
          plate.surface.control_points().row(plate.state.distribution->global(points[k])).transpose())
        CHECK(triggers.radii[t] == Approx(1.5 * std::min(1., part[k])).margin(1e-12));
}
