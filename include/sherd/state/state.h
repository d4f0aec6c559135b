#pragma once

#include <memory>
#include <vector>

#include <sherd/algebra/vector.h>
#include <sherd/geometry/shape_values.h>
#include <sherd/space/shell_space.h>
#include <sherd/state/snapshot.h>

namespace sherd
{

/// Values at the quadrature points of the active elements of a rank, index order [active element][q].
class QuadratureField
{
public:
  QuadratureField(int n_elements, int n_points) : n_points_(n_points), values_(n_elements * std::size_t(n_points), 0.)
  {
  }

  double       *operator[](int element) { return values_.data() + element * std::size_t(n_points_); }
  const double *operator[](int element) const { return values_.data() + element * std::size_t(n_points_); }
  int           n_points() const { return n_points_; }

private:
  int                 n_points_;
  std::vector<double> values_;
};

/// Control values x, v, a (n_owned + n_ghosts, spacedim) and phi, and the history H at quadrature points, at one time.
///
/// Points of interface multipliers have blocks as well (ShellSpace): the multiplier of the angle is the first entry of
/// its position, that of the phase its phase; their rates are zero.
///
/// A value: copy it to remember a step, assign it back to reject one. Ghosts are up to date between calls.
template <int degree, int spacedim>
struct State
{
  static constexpr int n_q = ShapeValues<degree>::n_points;

  /// At rest in the reference configuration, intact: x = X, v = a = 0, phi = 1, H = 0; multipliers are 0.
  explicit State(const ShellSpace<degree, spacedim> &space)
      : State(space, std::make_shared<const Distribution>(space.environment().comm(), space.distribution().owned,
                                                          space.distribution().ghosts))
  {
    const auto X = space.surface().control_points();
    for (int a = 0; a < distribution->n_local(); ++a)
      if (const auto point = distribution->global(a); point < n_control_points)
        {
          for (int d = 0; d < spacedim; ++d)
            position.local()[a * spacedim + d] = X(point, d);
          phase.local()[a] = previous_phase.local()[a] = 1.;
        }
  }

  std::shared_ptr<const Distribution> distribution;
  int                                 n_control_points; ///< global ids from this on are multipliers
  Vector                              position;         ///< x [length]
  Vector                              velocity;         ///< v [length/time]
  Vector                              acceleration;     ///< a [length/time^2]
  Vector                              phase;            ///< phi
  Vector                              previous_phase;   ///< phi one step earlier, for extrapolation
  QuadratureField                     history;          ///< H of the last accepted step [energy/area]
  double                              time      = 0.;
  double                              step_size = 0.; ///< of the step that led here, 0 before the first
  int                                 step      = 0;  ///< number of accepted steps

private:
  State(const ShellSpace<degree, spacedim> &space, std::shared_ptr<const Distribution> d)
      : distribution(d),
        n_control_points(space.n_control_points()),
        position(d, spacedim),
        velocity(d, spacedim),
        acceleration(d, spacedim),
        phase(d, 1),
        previous_phase(d, 1),
        history(space.n_active_elements(), n_q)
  {
  }
};

/// Interface multipliers of all pieces of the interfaces of a surface.
struct Multipliers
{
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  std::vector<InterfacePiece> pieces; ///< where they are, sherd::interface_pieces(surface)
  Values values; ///< q of the angle, q of the phase, the latter one step earlier, shape=(n_pieces, 3)
};

/// The whole state on every rank, in the numbering of the surface.
template <int degree, int spacedim>
struct GlobalState
{
  static constexpr int n_q = ShapeValues<degree>::n_points;
  using History            = Eigen::Matrix<double, Eigen::Dynamic, n_q, Eigen::RowMajor>;

  ControlValues<spacedim> position, velocity, acceleration; ///< shape=(n_control_points, spacedim)
  Eigen::VectorXd         phase, previous_phase;            ///< shape=(n_control_points)
  History                 history;                          ///< shape=(n_elements, n_q)
  Multipliers             multipliers;                      ///< none without continuity::LagrangeMultiplier
  double                  time = 0., step_size = 0.;
  int                     step = 0;
};

/// Brings a state together on every rank. Collective.
template <int degree, int spacedim>
GlobalState<degree, spacedim> gather(const State<degree, spacedim> &state, const ShellSpace<degree, spacedim> &space);

/// Gives every rank its part, the inverse of gather. Collective, because the state makes its own distribution.
/// @throws DimensionMismatch   if the state has multipliers and the space has not, or the other way round
template <int degree, int spacedim>
State<degree, spacedim> distribute(const GlobalState<degree, spacedim> &global,
                                   const ShellSpace<degree, spacedim>  &space);

/// What output needs of a state, on every rank. Collective.
template <int degree, int spacedim>
Snapshot<spacedim> snapshot(const State<degree, spacedim> &state);

} // namespace sherd

#include <sherd/state/state.templates.h>
