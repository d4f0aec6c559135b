#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <sherd/base/types.h>

namespace sherd
{

/// What the phase does to a pressure.
enum class PressureRelease
{
  none,    ///< p = p0
  by_phase ///< p = p0 max(phi, 0): a crack lets it out
};

/// A function of exactly this result. An Eigen expression in its place would refer to temporaries that are gone when it
/// is evaluated: give the function an explicit return type, [](auto &X, double t) -> Point<3> { ... }.
template <class F, class Result, class... Arguments>
concept FunctionOf = std::same_as<std::invoke_result_t<F, Arguments...>, Result>;

/// Loads of a surface, declared once by the name of an edge, by position or for the whole surface, so that they follow
/// refinement. X is the position on the reference surface.
///
/// Dead loads keep their direction and refer to the reference surface: surface load, gravity, traction, point load.
/// Follower loads turn with a shell (spacedim 3): pressure, edge moment.
///
/// Source: theory E.3.
template <int spacedim>
class Loads
{
public:
  using Function       = std::function<Point<spacedim>(const Point<spacedim> &X, double time)>;
  using ScalarFunction = std::function<double(const Point<spacedim> &X, double time)>;
  using PointFunction  = std::function<Point<spacedim>(double time)>;

  struct Traction
  {
    std::string edge;
    Function    traction; ///< [force/length]
  };

  struct PointLoad
  {
    Point<spacedim> position; ///< X
    PointFunction   force;    ///< [force]
  };

  struct Pressure
  {
    ScalarFunction  pressure; ///< p0 [force/area]
    PressureRelease release;
  };

  struct EdgeMoment
  {
    std::string    edge;
    ScalarFunction moment; ///< m [force]: moment by reference length of the edge
  };

  /// f_A = int N_A t(X, time) dS on a named edge. @p traction [force/length]
  template <FunctionOf<Point<spacedim>, const Point<spacedim> &, double> F>
  void traction(const std::string &edge, F traction)
  {
    declare(Kind::traction, tractions_.size(), "traction " + edge);
    tractions_.push_back({edge, std::move(traction)});
  }

  /// f_A = int N_A f(X, time) dA on the whole surface. @p force [force/area]
  template <FunctionOf<Point<spacedim>, const Point<spacedim> &, double> F>
  void surface_load(F force)
  {
    declare(Kind::surface_load, surface_loads_.size(), "surface load");
    surface_loads_.push_back(std::move(force));
  }

  /// Surface load rho g. @param mass  rho, by reference area   @param g  acceleration of gravity, with its direction
  void gravity(double mass, const Point<spacedim> &g)
  {
    declare(Kind::surface_load, surface_loads_.size(), "gravity");
    surface_loads_.push_back([f = Point<spacedim>(mass * g)](const Point<spacedim> &, double) { return f; });
  }

  /// f_A = N_A(X) P(time) at the point of the surface that lies at @p X. @p force [force]
  template <FunctionOf<Point<spacedim>, double> F>
  void point_load(const Point<spacedim> &X, F force)
  {
    declare(Kind::point_load, point_loads_.size(), "point load");
    point_loads_.push_back({X, std::move(force)});
  }

  /// f_A = int p N_A a_1 x a_2 d^2xi on the whole surface: along the present normal and by present area.
  /// @p pressure p0(X, time) [force/area], positive along +n
  void pressure(ScalarFunction pressure, PressureRelease release) requires(spacedim == 3)
  {
    declare(Kind::pressure, pressures_.size(), "pressure");
    pressures_.push_back({std::move(pressure), release});
  }

  /// f_A = -int m N_A,a nu^a n dS on a named edge: turns the normal n towards the outward conormal nu, so that the
  /// edge moves towards -n. @p moment m(X, time) [force]
  void edge_moment(const std::string &edge, ScalarFunction moment) requires(spacedim == 3)
  {
    declare(Kind::edge_moment, edge_moments_.size(), "edge moment " + edge);
    edge_moments_.push_back({edge, std::move(moment)});
  }

  /// Names of all loads in the order of their declaration: "traction EDGE", "surface load", "gravity", "point load",
  /// "pressure", "edge moment EDGE". A name that is taken gets a number, "pressure 2".
  std::vector<std::string> names() const
  {
    std::vector<std::string> result;
    for (const auto &load : declared_)
      result.push_back(load.name);
    return result;
  }

  /// Load @p i of names(), alone.
  Loads only(int i) const
  {
    Loads       result;
    const auto &load = declared_.at(i);
    switch (load.kind)
      {
      case Kind::traction:
        result.tractions_.push_back(tractions_[load.index]);
        break;
      case Kind::surface_load:
        result.surface_loads_.push_back(surface_loads_[load.index]);
        break;
      case Kind::point_load:
        result.point_loads_.push_back(point_loads_[load.index]);
        break;
      case Kind::pressure:
        result.pressures_.push_back(pressures_[load.index]);
        break;
      case Kind::edge_moment:
        result.edge_moments_.push_back(edge_moments_[load.index]);
        break;
      }
    result.declared_.push_back({load.kind, 0, load.name});
    return result;
  }

  const std::vector<Traction>   &tractions() const { return tractions_; }
  const std::vector<Function>   &surface_loads() const { return surface_loads_; }
  const std::vector<PointLoad>  &point_loads() const { return point_loads_; }
  const std::vector<Pressure>   &pressures() const { return pressures_; }       ///< empty in the plane
  const std::vector<EdgeMoment> &edge_moments() const { return edge_moments_; } ///< empty in the plane

private:
  enum class Kind
  {
    traction,
    surface_load,
    point_load,
    pressure,
    edge_moment
  };

  /// A load as it was declared, number @p index of its kind.
  struct Declared
  {
    Kind        kind;
    std::size_t index;
    std::string name;
  };

  void declare(Kind kind, std::size_t index, const std::string &name)
  {
    const auto is_taken = [this](const std::string &text) {
      return std::any_of(declared_.begin(), declared_.end(), [&](const auto &load) { return load.name == text; });
    };
    std::string free = name;
    for (int number = 2; is_taken(free); ++number)
      free = name + " " + std::to_string(number);
    declared_.push_back({kind, index, free});
  }

  std::vector<Declared>   declared_;
  std::vector<Traction>   tractions_;
  std::vector<Function>   surface_loads_;
  std::vector<PointLoad>  point_loads_;
  std::vector<Pressure>   pressures_;
  std::vector<EdgeMoment> edge_moments_;
};

} // namespace sherd
