#pragma once

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
    tractions_.push_back({edge, std::move(traction)});
  }

  /// f_A = int N_A f(X, time) dA on the whole surface. @p force [force/area]
  template <FunctionOf<Point<spacedim>, const Point<spacedim> &, double> F>
  void surface_load(F force)
  {
    surface_loads_.push_back(std::move(force));
  }

  /// Surface load rho g. @param mass  rho, by reference area   @param g  acceleration of gravity, with its direction
  void gravity(double mass, const Point<spacedim> &g)
  {
    surface_load([f = Point<spacedim>(mass * g)](const Point<spacedim> &, double) { return f; });
  }

  /// f_A = N_A(X) P(time) at the point of the surface that lies at @p X. @p force [force]
  template <FunctionOf<Point<spacedim>, double> F>
  void point_load(const Point<spacedim> &X, F force)
  {
    point_loads_.push_back({X, std::move(force)});
  }

  /// f_A = int p N_A a_1 x a_2 d^2xi on the whole surface: along the present normal and by present area.
  /// @p pressure p0(X, time) [force/area], positive along +n
  void pressure(ScalarFunction pressure, PressureRelease release) requires(spacedim == 3)
  {
    pressures_.push_back({std::move(pressure), release});
  }

  /// f_A = -int m N_A,a nu^a n dS on a named edge: turns the normal n towards the outward conormal nu, so that the
  /// edge moves towards -n. @p moment m(X, time) [force]
  void edge_moment(const std::string &edge, ScalarFunction moment) requires(spacedim == 3)
  {
    edge_moments_.push_back({edge, std::move(moment)});
  }

  const std::vector<Traction>   &tractions() const { return tractions_; }
  const std::vector<Function>   &surface_loads() const { return surface_loads_; }
  const std::vector<PointLoad>  &point_loads() const { return point_loads_; }
  const std::vector<Pressure>   &pressures() const { return pressures_; }       ///< empty in the plane
  const std::vector<EdgeMoment> &edge_moments() const { return edge_moments_; } ///< empty in the plane

private:
  std::vector<Traction>   tractions_;
  std::vector<Function>   surface_loads_;
  std::vector<PointLoad>  point_loads_;
  std::vector<Pressure>   pressures_;
  std::vector<EdgeMoment> edge_moments_;
};

} // namespace sherd
