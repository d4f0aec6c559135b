#pragma once

#include <optional>
#include <vector>

#include <sherd/solve/solver_base.h>
#include <sherd/time/central_difference.h>

namespace sherd
{

/// Central differences with a lumped mass; the phase equation is solved at the end of each step, with its branch check
/// and switch (theory C.2):
///
///   x_{n+1} from (x, v, a)_n and the supports;  phi_{n+1} at x_{n+1};
///   M_L a_{n+1} = f_ext - f_int(x_{n+1}, phi_{n+1});  v_{n+1}.
///
/// A step larger than largest_step() is refused: that is 2 / omega (less with damping) with an upper bound of the
/// frequencies of the lumped system by its assembled stiffness K, taken anew after every 20 steps. In bending it is
/// proportional to h^2. The damping force b K v takes the same omega and K.
///
/// Unknowns that a support moves get the rates of three points of its path in the step. Ties act on increments; masses
/// of tied unknowns go to their masters. Interfaces have to be kept together by penalties, since multipliers have no
/// mass. No matrix is made in a step but that of the phase. Kinetic energy and work are those of the lumped mass; the
/// work is that of the mean of the forces at both ends of the step. n_NR counts the iterations for the phase.
///
/// The arguments of the constructor have to outlive the solver.
///
/// Source: theory F.5.
template <class Model>
class ExplicitSolver : public SolverBase<Model, Unknowns::phase>
{
public:
  using Base                    = SolverBase<Model, Unknowns::phase>;
  using StateType               = typename Base::StateType;
  using Result                  = typename Base::Result;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;

  ExplicitSolver(const Model &model, const ShellSpace<Model::degree, spacedim> &space, const Supports &supports,
                 const Loads<spacedim> &loads, const CentralDifference &integrator, const NewtonSettings &settings)
      : Base(model, space, supports, loads, settings), integrator_(integrator)
  {
  }

  /// As SolverBase::rebuild. Collective. @throws InvalidParameter   a space with multipliers
  void rebuild(const StateType &state);

  /// Solves M_L a = f_ext - f_int at the time of @p state. Collective.
  /// @throws InvalidParameter   a velocity that the supports do not allow, complete_velocity()
  void set_initial_acceleration(StateType &state);

  /// Attempts the step from @p state to state.time + dt. Collective. Throws only what no smaller step could mend.
  Result attempt(const StateType &state, double dt);

  /// Energies of @p state, the kinetic one with the lumped mass. Collective.
  Energies energies(const StateType &state);

  /// Largest stable step at the state of the last estimate [time].
  double largest_step() const { return largest_step_; }

private:
  static constexpr int    renewal  = 20;   ///< steps after which the largest step is estimated anew
  static constexpr double rounding = 1e-9; ///< of a step that ends exactly at a given time, StepController::step_within

  /// What acts at the end of a step.
  struct Forces
  {
    Vector position; ///< where
    Vector total;    ///< internal, inertial and damping, and the residual of the phase, block n_fields
    Vector external; ///< block n_fields
    double time;
  };

  Forces forces_at_rest(const Vector &position, const Vector &phase, const QuadratureField &history, double time) const;
  void   balance(Forces &forces, const StateType &state, Motion &next, double dt) const;
  void   add_inertia(Forces &forces, const Vector &acceleration) const;
  void   add_damping(Forces &forces, const Vector &velocity) const;
  bool   belongs_to(const std::optional<Forces> &forces, const StateType &state) const;
  void   estimate_largest_step(const StateType &state);
  double inertial_work(const Vector &acceleration, const Vector &displacement) const;

  CentralDifference     integrator_;
  std::optional<Matrix> stiffness_; ///< of the displacement, at the last estimate of the largest step
  std::optional<Vector> mass_;      ///< lumped, 0 where tied, block spacedim
  double                largest_step_ = 0., damping_ = 0.; ///< the latter the factor of the stiffness [time]
  int                   n_steps_ = 0;                      ///< since the last estimate
  std::optional<Forces> start_, end_;                      ///< of the last attempt, for its work
};

} // namespace sherd

#include <sherd/solve/explicit_solver.templates.h>
