// label: unit
#include <catch2/catch.hpp>

#include <sherd/forms/loads.h>

using namespace sherd;

namespace
{

template <class L>
concept TakesPressure = requires(L loads)
{
  loads.pressure([](const Point<3> &, double) { return 1.; }, PressureRelease::none);
};
template <class L>
concept TakesEdgeMoment = requires(L loads)
{
  loads.edge_moment("left", [](const Point<3> &, double) { return 1.; });
};

} // namespace

TEST_CASE("Loads are kept in the order of their declaration")
{
  Loads<3>       loads;
  const Point<3> X(1., 2., 3.);
  loads.traction("left", [](const Point<3> &at, double t) -> Point<3> { return t * at; });
  loads.surface_load([](const Point<3> &at, double t) -> Point<3> { return 2. * t * at; });
  loads.gravity(3., {0., 0., -9.81});
  loads.point_load(X, [](double t) { return Point<3>(t, 0., 0.); });
  loads.pressure([](const Point<3> &at, double t) { return at[0] + t; }, PressureRelease::by_phase);
  loads.pressure([](const Point<3> &, double) { return 5.; }, PressureRelease::none);
  loads.edge_moment("right", [](const Point<3> &at, double t) { return at[1] * t; });

  REQUIRE(loads.tractions().size() == 1);
  CHECK(loads.tractions()[0].edge == "left");
  CHECK(loads.tractions()[0].traction(X, 2.) == 2. * X);
  REQUIRE(loads.surface_loads().size() == 2);
  CHECK(loads.surface_loads()[0](X, 2.) == 4. * X);
  CHECK(loads.surface_loads()[1](X, 2.) == Point<3>(0., 0., -9.81 * 3.));
  REQUIRE(loads.point_loads().size() == 1);
  CHECK(loads.point_loads()[0].position == X);
  CHECK(loads.point_loads()[0].force(4.) == Point<3>(4., 0., 0.));
  REQUIRE(loads.pressures().size() == 2);
  CHECK(loads.pressures()[0].release == PressureRelease::by_phase);
  CHECK(loads.pressures()[0].pressure(X, 2.) == 3.);
  CHECK(loads.pressures()[1].release == PressureRelease::none);
  REQUIRE(loads.edge_moments().size() == 1);
  CHECK(loads.edge_moments()[0].edge == "right");
  CHECK(loads.edge_moments()[0].moment(X, 2.) == 4.);
}

TEST_CASE("Loads have names in the order of their declaration, and each can stand alone")
{
  Loads<3>       loads;
  const Point<3> X(1., 2., 3.);
  CHECK(loads.names().empty());
  loads.pressure([](const Point<3> &, double) { return 5.; }, PressureRelease::none);
  loads.traction("top", [](const Point<3> &at, double t) -> Point<3> { return t * at; });
  loads.gravity(3., {0., 0., -1.});
  loads.pressure([](const Point<3> &, double) { return 7.; }, PressureRelease::by_phase);
  loads.surface_load([](const Point<3> &at, double) -> Point<3> { return 2. * at; });
  loads.point_load(X, [](double t) { return Point<3>(t, 0., 0.); });
  loads.edge_moment("top", [](const Point<3> &, double) { return 4.; });
  loads.pressure([](const Point<3> &, double) { return 9.; }, PressureRelease::none);

  CHECK(loads.names() == std::vector<std::string>{"pressure", "traction top", "gravity", "pressure 2", "surface load",
                                                  "point load", "edge moment top", "pressure 3"});
  const auto n_of = [](const Loads<3> &some) {
    return some.tractions().size() + some.surface_loads().size() + some.point_loads().size() + some.pressures().size() +
           some.edge_moments().size();
  };
  for (int i = 0; i < 8; ++i)
    {
      CHECK(n_of(loads.only(i)) == 1);
      CHECK(loads.only(i).names() == std::vector{loads.names()[i]});
    }
  CHECK(loads.only(3).pressures().at(0).pressure(X, 0.) == 7.);
  CHECK(loads.only(3).pressures().at(0).release == PressureRelease::by_phase);
  CHECK(loads.only(2).surface_loads().at(0)(X, 0.) == Point<3>(0., 0., -3.));
  CHECK(loads.only(4).surface_loads().at(0)(X, 0.) == 2. * X);
  CHECK(loads.only(5).point_loads().at(0).position == X);
  CHECK(loads.only(6).edge_moments().at(0).edge == "top");
}

TEST_CASE("A sheet in the plane takes dead loads only")
{
  STATIC_REQUIRE(TakesPressure<Loads<3>>);
  STATIC_REQUIRE(TakesEdgeMoment<Loads<3>>);
  STATIC_REQUIRE(!TakesPressure<Loads<2>>);
  STATIC_REQUIRE(!TakesEdgeMoment<Loads<2>>);
  Loads<2> loads;
  loads.gravity(2., {0., -1.});
  CHECK(loads.surface_loads()[0]({}, 0.) == Point<2>(0., -2.));
  CHECK(loads.pressures().empty());
  CHECK(loads.edge_moments().empty());
}
