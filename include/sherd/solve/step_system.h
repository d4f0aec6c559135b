#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <sherd/assembly/assembler.h>
#include <sherd/time/update.h>

namespace sherd
{

/// Norms of a residual relative to their tolerances.
struct ResidualNorms
{
  double displacement, phase;
  double larger() const { return std::max(displacement, phase); }
};

/// The nonlinear system of one stage of a step and its present iterate.
template <class Model>
struct StepSystem
{
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;

  const InterfaceTerms<Model> &interfaces;
  Stage                        stage;
  Motion                       start;   ///< of the step
  Motion                       next;    ///< at the end of the stage
  Vector                       phase;   ///< at the end of the stage
  const QuadratureField       &history; ///< at the end of the stage before
  const std::vector<char>     *fixed;   ///< 1 for an unknown that does not move, shape=(n_owned * n_fields)
  LoadValues<Model>            loads;   ///< at its level
  double                       load_time;

  Vector external;            ///< f_ext, block n_fields
  Vector position;            ///< at the level alpha_f
  Vector acceleration;        ///< at the level alpha_m
  Vector residual;            ///< block n_fields
  Vector increment;           ///< block n_fields
  bool   has_tangent = false; ///< whether the matrix is the tangent of this iterate

  /// Psi+ of the position, where it is known; advance() forgets it when it moves the position.
  std::optional<QuadratureField> active_energy;

  /// @p interfaces, @p history and @p fixed have to outlive the system.
  StepSystem(const InterfaceTerms<Model> &interfaces_, const Stage &stage_, Motion start_, Motion next_, Vector phase_,
             const QuadratureField &history_, const std::vector<char> &fixed_, LoadValues<Model> loads_,
             double load_time_)
      : interfaces(interfaces_),
        stage(stage_),
        start(std::move(start_)),
        next(std::move(next_)),
        phase(std::move(phase_)),
        history(history_),
        fixed(&fixed_),
        loads(std::move(loads_)),
        load_time(load_time_),
        external(phase.shared_distribution(), n_fields),
        position(next.position),
        acceleration(next.acceleration),
        residual(external),
        increment(external)
  {
    update_levels();
  }

  BalanceLevel level() const { return {position, acceleration, phase, active_energy ? &*active_energy : nullptr}; }

  /// Adds @p length times the increment; its phase part is scaled down to @p largest_phase_step.
  void advance(double length, double largest_phase_step)
  {
    const auto   d     = increment.local();
    const int    n     = phase.distribution().n_local();
    const double scale = length * phase_scale(largest_phase_step);
    bool         moves = false;
    for (int a = 0; a < n; ++a)
      {
        if (interfaces.is_multiplier(a)) // it has no rates
          next.position.local()[a * spacedim] += length * d[a * n_fields];
        else
          for (int c = 0; c < spacedim; ++c)
            {
              moves |= d[a * n_fields + c] != 0.;
              move(stage, next, a * spacedim + c, length * d[a * n_fields + c] / stage.alpha_f);
            }
        phase.local()[a] += scale * d[a * n_fields + spacedim];
      }
    update_levels();
    has_tangent = false;
    if (moves)
      active_energy.reset();
  }

  void update_levels()
  {
    position     = interpolate(stage.alpha_f, start.position, next.position);
    acceleration = interpolate(stage.alpha_m, start.acceleration, next.acceleration);
    // A multiplier has no history: that of the step acts at the level of the balance (theory G.4).
    for (const int a : interfaces.multipliers())
      position.local()[a * spacedim] = next.position.local()[a * spacedim];
  }

private:
  double phase_scale(double largest_phase_step) const
  {
    if (std::isinf(largest_phase_step))
      return 1.;
    double peak = 0.;
    for (int a = 0; a < phase.distribution().n_local(); ++a)
      if (!interfaces.is_multiplier(a))
        peak = std::max(peak, std::abs(increment.local()[a * n_fields + spacedim]));
    MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPI_DOUBLE, MPI_MAX, phase.distribution().comm());
    return peak > largest_phase_step ? largest_phase_step / peak : 1.;
  }
};

} // namespace sherd
