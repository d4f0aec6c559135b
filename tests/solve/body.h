#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/pre_crack.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/solve/instances.h>
#include <sherd/time/generalized_alpha.h>

namespace sherd::test
{

using Split = split::SurfaceStretch<material::NeoHooke>;
using Glass = BrittleShell<2, 2, Split, degradation::Cubic, crack_density::FourthOrder>;

template <class Model>
using DegradationOf = decltype(Model::degradation);

/// A brittle plate in units of its length scale, toughness and mass: l0 = Gc = rho = 1. With E = 10^4 damage starts at
/// a strain of about 0.4 %.
struct Units
{
  double E = 1e4, nu = .2, toughness = 1.;

  material::Moduli moduli() const { return material::surface_moduli(E, nu); }

  template <class Model = Glass>
  Model model() const
  {
    return Model(Split(material::NeoHooke(moduli())), DegradationOf<Model>(), {}, toughness, 1., 1.);
  }
};

/// Everything that a solver refers to, in one place that does not move.
template <class Model, class Integrator = GeneralizedAlpha, class Solver = MonolithicSolver<Model, Integrator>>
struct Body
{
  Environment      env{MPI_COMM_WORLD};
  Model            model;
  Surface<2, 2>    surface;
  ShellSpace<2, 2> space;
  Supports         supports;
  Loads<2>         loads;
  State<2, 2>      state;
  Solver           solver;

  Body(const Model &model_, const std::array<double, 2> &size, const std::array<int, 2> &elements,
       const NewtonSettings &settings = {}, const Supports &supports_ = {}, const Loads<2> &loads_ = {},
       const Integrator &integrator = Integrator(.5))
      : model(model_),
        surface(shapes::plate<2, 2>(size, elements)),
        space(env, surface),
        supports(supports_),
        loads(loads_),
        state(space),
        solver(model, space, supports, loads, integrator, settings)
  {
    solver.rebuild(state);
  }
  Body(const Body &) = delete;

  /// Reference position of a local control point.
  Point<2> reference(int a) const { return surface.control_points().row(state.distribution->global(a)).transpose(); }

  /// x_A = map(X_A) of every control point. An affine map makes a homogeneous deformation.
  template <class Map>
  void deform(const Map &map)
  {
    for (int a = 0; a < state.distribution->n_local(); ++a)
      {
        const Point<2> x = map(reference(a));
        for (int d = 0; d < 2; ++d)
          state.position.local()[a * 2 + d] = x[d];
      }
  }

  /// Start value and history of cracks that exist at the beginning, not yet in equilibrium.
  void crack(const PreCrack<2> &pre_crack)
  {
    for (int a = 0; a < state.distribution->n_local(); ++a)
      state.phase.local()[a] = pre_crack.phase(reference(a), model.crack_density);
    for (int e = 0; e < space.n_active_elements(); ++e)
      for (int q = 0; q < state.n_q; ++q)
        {
          const auto X        = solver.assembler().quadrature_position(e, q);
          state.history[e][q] = model.irreversibility.initial(
              pre_crack.history(X, model.degradation, model.crack_density, model.toughness(X)),
              pre_crack.phase(X, model.crack_density));
        }
    state.previous_phase = state.phase;
  }

  /// H of the present state at all quadrature points.
  QuadratureField driving() const
  {
    Vector rest = state.acceleration;
    rest.fill(0.);
    return solver.assembler().committed({state.position, rest, state.phase}, state.history);
  }

  /// Largest l0 H / Gc, the load of theory C.3.
  double peak_load() const
  {
    const auto H    = driving();
    double     peak = 0.;
    for (int e = 0; e < space.n_active_elements(); ++e)
      peak = std::max(peak, *std::max_element(H[e], H[e] + state.n_q));
    return peak * model.length_scale / model.toughness(Point<2>(0., 0.));
  }

  /// Whether the phase stiffness of the whole body is positive definite.
  bool is_stable() const
  {
    Matrix matrix = solver.assembler().make_matrix();
    Vector force(state.distribution, 3), rest = state.acceleration;
    rest.fill(0.);
    solver.assembler().linearise({state.position, rest, state.phase}, state.history, 0., PhaseTangent::consistent,
                                 force, matrix);
    std::vector<int> all(state.distribution->n_local());
    for (std::size_t a = 0; a < all.size(); ++a)
      all[a] = static_cast<int>(a);
    return positive_definite(matrix, 2, all);
  }

  double largest_phase() const { return *std::max_element(state.phase.local().begin(), state.phase.local().end()); }
  double smallest_phase() const { return *std::min_element(state.phase.local().begin(), state.phase.local().end()); }

  Energies energies() { return solver.energies(state); }
};

/// Stretch in both directions at which Psi+ = K/4 (lambda^4 - 1 - 4 ln lambda) reaches @p energy (theory C.3).
inline double biaxial_stretch(double energy, double bulk)
{
  double low = 1., high = 2.;
  for (double middle = 1.5; low < middle && middle < high; middle = .5 * (low + high))
    (bulk / 4. * (std::pow(middle, 4) - 1. - 4. * std::log(middle)) < energy ? low : high) = middle;
  return high;
}

/// A toughness that no load of these tests can reach: the phase stays 1 and the plate elastic.
inline const Units unbreakable{1e4, .2, 1e10};

/// Both displacements of the left edge are zero.
inline Supports held()
{
  Supports supports;
  supports.fix("left", Component::x);
  supports.fix("left", Component::y);
  return supports;
}

/// Takes a step that has to succeed.
template <class SomeBody>
auto take(SomeBody &body, double dt)
{
  auto result = body.solver.attempt(body.state, dt);
  INFO(result.failure);
  REQUIRE(result.state);
  body.state = *result.state;
  return result;
}

inline double distance(const std::vector<double> &a, const std::vector<double> &b)
{
  double sum = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// Tolerances at which a converged step is exact to about ten digits.
inline NewtonSettings tight(Preconditioner preconditioner = Preconditioner::point_block_ilu)
{
  NewtonSettings settings;
  settings.displacement_tolerance = 1e-10;
  settings.phase_tolerance        = 1e-10;
  settings.max_iterations         = 20;
  settings.linear.tolerance       = 1e-10;
  settings.linear.preconditioner  = preconditioner;
  return settings;
}

} // namespace sherd::test
