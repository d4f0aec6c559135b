#pragma once

#include "koiter_body.h"

/// The linear shells of theory J.2 on n x n elements of degree p, and what is read from them.
namespace sherd::test
{

/// Scordelis-Lo roof with diaphragms: a quarter, or the whole of it.
template <int degree>
KoiterBody<degree> roof(int n, double thickness = .25, shapes::Fit fit = shapes::Fit::exact,
                        shapes::Part part = shapes::Part::quarter)
{
  Supports supports;
  for (const auto component : {Component::y, Component::z})
    supports.fix("left", component);
  if (part == shapes::Part::quarter)
    {
      supports.symmetry("right", Component::x);
      supports.symmetry("bottom", Component::y);
    }
  else
    {
      for (const auto component : {Component::y, Component::z})
        supports.fix("right", component);
      supports.fix(Corner{"left", "bottom"}, Component::x);
    }
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., -90. * t); });
  return {4.32e8, 0., thickness, shapes::roof<degree>(25., 50., M_PI * 40. / 180., {n, n}, fit, part), supports, loads};
}

/// Octant of the cylinder with diaphragms that two opposite unit forces pinch; the force is at (u, v) = (n, 0).
template <int degree>
KoiterBody<degree> pinched_cylinder(int n, shapes::Fit fit = shapes::Fit::exact)
{
  Supports supports;
  for (const auto component : {Component::y, Component::z})
    supports.fix("left", component);
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  supports.symmetry("top", Component::z);
  Loads<3> loads;
  loads.point_load({300., 0., 300.}, [](double t) { return Point<3>(0., 0., -.25 * t); });
  return {3e6, .3, 3., shapes::cylinder<degree>(300., 300., {0., .5 * M_PI}, {n, n}, fit), supports, loads};
}

/// Quarter of the hemisphere with two pairs of forces 2 at the equator; the outward one is at (u, v) = (0, 0).
/// @param hole   from the pole to its rim [degrees]
template <int degree>
KoiterBody<degree> hemisphere(int n, double hole, shapes::Fit fit = shapes::Fit::exact)
{
  Supports supports;
  supports.symmetry("left", Component::y);
  supports.symmetry("right", Component::x);
  supports.fix(Corner{"right", "equator"}, Component::z);
  Loads<3> loads;
  loads.point_load({10., 0., 0.}, [](double t) { return Point<3>(t, 0., 0.); });
  loads.point_load({0., 10., 0.}, [](double t) { return Point<3>(0., -t, 0.); });
  const auto surface = shapes::hemisphere_with_hole<degree>(10., M_PI * hole / 180., {0., .5 * M_PI}, {n, n}, fit);
  return {6.825e7, .3, .04, surface, supports, loads};
}

/// Linear response to the whole load: displacement at the parameters u, v. Collective.
template <int degree>
Point<3> deflection(KoiterBody<degree> &&body, double u, double v)
{
  return body.displacement(body.solver.solve_linear(body.state, 1.), u, v);
}

/// Work f . u of the whole load, twice the elastic energy. Collective.
template <int degree>
double work(KoiterBody<degree> &&body)
{
  auto loaded = body.state;
  loaded.time = 1.;

  const Vector force  = body.solver.residual(loaded).free;
  const auto   result = body.solver.solve_linear(body.state, 1.);
  Vector       u      = force;
  u.fill(0.);
  for (int a = 0; a < result.distribution->n_owned(); ++a)
    for (int c = 0; c < 3; ++c)
      u.local()[4 * a + c] = result.position.local()[3 * a + c] - body.state.position.local()[3 * a + c];
  return dot(force, u);
}

} // namespace sherd::test
