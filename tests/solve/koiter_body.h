#pragma once

#include <cmath>
#include <vector>

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>
#include <sherd/solve/arc_length.h>
#include <sherd/solve/instances.h>
#include <sherd/solve/load_stepping.h>

namespace sherd::test
{

/// A shell with Koiter's law, and everything that its static solver refers to, in one place that does not move.
template <int degree>
struct KoiterBody
{
  using Model = models::KoiterShell<degree>;

  Environment           env{MPI_COMM_WORLD};
  Model                 model;
  Surface<degree, 3>    surface;
  ShellSpace<degree, 3> space;
  Supports              supports;
  Loads<3>              loads;
  State<degree, 3>      state;
  StaticSolver<Model>   solver;
  ControlValues<3>      reference;

  KoiterBody(double E, double nu, double thickness, const Surface<degree, 3> &surface_, const Supports &supports_,
             const Loads<3> &loads_, const StaticSettings &settings = {},
             const Continuity &continuity = continuity::Penalty())
      : KoiterBody(make_model(E, nu, thickness), surface_, supports_, loads_, settings, continuity)
  {
  }
  KoiterBody(const Model &model_, const Surface<degree, 3> &surface_, const Supports &supports_, const Loads<3> &loads_,
             const StaticSettings &settings = {}, const Continuity &continuity = continuity::Penalty())
      : model(model_),
        surface(surface_),
        space(env, surface, continuity),
        supports(supports_),
        loads(loads_),
        state(space),
        solver(model, space, supports, loads, settings),
        reference(surface.control_points())
  {
    solver.rebuild(state);
  }
  KoiterBody(const KoiterBody &) = delete;

  static Model make_model(double E, double nu, double thickness)
  {
    const auto laws = material::koiter_shell(E, nu, thickness);
    return make_model(laws.membrane, laws.bending);
  }

  static Model make_model(const material::StVenantKirchhoff &membrane, const material::Koiter &bending)
  {
    return Model(split::None<material::StVenantKirchhoff, material::Koiter>(membrane, bending),
                 degradation::Cubic(1e-4), {}, Toughness<3>(1.), 1., 1.);
  }

  /// Displacement of the point with parameters u, v of a patch. Collective.
  Point<3> displacement(const State<degree, 3> &present, double u, double v, int patch = 0) const
  {
    const auto place = evaluate(surface, SurfacePlace{patch, u, v});
    const auto x     = snapshot(present).position;
    Point<3>   sum   = Point<3>::Zero();
    for (std::size_t i = 0; i < place.points.size(); ++i)
      sum += place.value[i] * (x.row(place.points[i]) - reference.row(place.points[i])).transpose();
    return sum;
  }
};

/// A bar along the x axis, width 1, axial stiffness E T = 1, held against sideways motion and without a Poisson effect:
/// at the stretch lambda everywhere it carries (lambda^3 - lambda) / 2.
struct Bar : KoiterBody<2>
{
  static constexpr double length = 4., limit_stretch = .57735026918962576;
  static constexpr double limit_load = .19245008972987526; ///< (lambda - lambda^3) / 2 at the limit stretch 1/sqrt(3)

  Bar(const Supports &ends, const Loads<3> &loads, const StaticSettings &settings = {})
      : KoiterBody(10., 0., .1, shapes::plate<2, 3>({length, 1.}, {4, 1}), held(ends), loads, settings)
  {
  }

  static Supports held(Supports supports)
  {
    supports.fix("left", Component::x);
    for (const auto component : {Component::y, Component::z})
      supports.fix(WholeSurface{}, component);
    return supports;
  }

  /// Force factor * t along x on the right end.
  static Loads<3> pull(double factor)
  {
    Loads<3> loads;
    loads.traction("right", [factor](const Point<3> &, double t) { return Point<3>(factor * t, 0., 0.); });
    return loads;
  }

  double        stretch(const State<2, 3> &present) const { return 1. + displacement(present, 4., .5)[0] / length; }
  static double force(double stretch) { return .5 * (stretch * stretch * stretch - stretch); }
};

/// One half of a von Mises truss: a strip of width 1 and E T = 1 from a hinge at the origin up to (base, 0, rise),
/// where it can only move along z and carries the load `factor` times lambda downwards. With the height z of that end
/// and the length L of the strip the load at rest is -z (z^2 - rise^2) / (2 L^3), with extrema at z = +- rise /
/// sqrt(3); between them the truss snaps through. Thick enough not to buckle.
struct Truss : KoiterBody<2>
{
  static constexpr double base = 1., rise = .3, factor = .01;

  explicit Truss(const StaticSettings &settings = {}) : KoiterBody(2., 0., .5, strip(), hinges(), load(), settings) {}

  static Surface<2, 3> strip()
  {
    return interpolate<2, 3>(shapes::uniform_knots<2>(3), shapes::uniform_knots<2>(1),
                             [](double u, double v) { return Eigen::Vector4d(u / 3. * base, v, u / 3. * rise, 1.); });
  }

  static Supports hinges()
  {
    Supports supports;
    supports.fix(WholeSurface{}, Component::y);
    supports.fix("left");
    supports.fix("right", Component::x);
    return supports;
  }

  static Loads<3> load()
  {
    Loads<3> loads;
    loads.traction("right", [](const Point<3> &, double t) { return Point<3>(0., 0., -factor * t); });
    return loads;
  }

  double height(const State<2, 3> &present) const { return rise + displacement(present, 3., .5)[2]; }

  /// Load factor at which @p z is an equilibrium.
  static double load_factor(double z)
  {
    const double L = std::hypot(base, rise);
    return -z * (z * z - rise * rise) / (2. * L * L * L) / factor;
  }
};

} // namespace sherd::test
