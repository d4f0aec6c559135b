#pragma once

#include <concepts>
#include <cstddef>

#include <sherd/assembly/assembler.h>
#include <sherd/assembly/external_work.h>

namespace sherd
{

/// Forces between which a time integrator finds balance, and where it does.
struct BalancedForces
{
  BalanceLevel  level;
  double        time;     ///< of the loads
  const Vector &total;    ///< internal and inertial, block n_fields
  const Vector &external; ///< block n_fields
};

/// b - a
inline Vector difference(const Vector &b, const Vector &a)
{
  Vector     result = b;
  const auto from   = a.local();
  auto       out    = result.local();
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] -= from[i];
  return result;
}

/// Work over a step that moves the surface by @p displacement (block spacedim) and changes the phase by
/// @p phase_change, both with ghosts, while @p forces act. A scheme that balances forces at several levels adds up
/// their shares. What multipliers say is no work of theirs; the forces they exert are part of the total. Collective.
///
/// @param is_held   whether a support holds owned unknown k = n_fields * point + component: there the support exerts
///                  what the loads leave over, total - external
template <class Model, std::predicate<std::size_t> IsHeld>
StepWork step_work(const Assembler<Model> &assembler, const Loads<Model::spacedim> &loads, const BalancedForces &forces,
                   const IsHeld &is_held, const Vector &displacement, const Vector &phase_change)
{
  constexpr int spacedim = Model::spacedim, n_fields = Model::n_fields;
  const auto   &interfaces = assembler.interfaces();
  const int     n_owned    = assembler.distribution()->n_owned();
  const int     n_loads    = static_cast<int>(loads.names().size());

  const auto work_of = [&](const Vector &force) {
    double sum = 0.;
    for (int i = 0; i < n_owned; ++i)
      if (!interfaces.is_multiplier(i))
        for (int c = 0; c < spacedim; ++c)
          sum += force.local()[i * n_fields + c] * displacement.local()[i * spacedim + c];
    return sum;
  };

  std::vector<double> sums(2 + n_loads, 0.); // supports, internal, loads
  for (int i = 0; i < n_owned; ++i)
    if (!interfaces.is_multiplier(i))
      {
        for (int c = 0; c < spacedim; ++c)
          if (const int k = i * n_fields + c; is_held(k))
            sums[0] += (forces.total.local()[k] - forces.external.local()[k]) * displacement.local()[i * spacedim + c];
        sums[1] += forces.total.local()[i * n_fields + spacedim] * phase_change.local()[i];
      }
  sums[1] += work_of(forces.total);
  if (n_loads == 1)
    sums[2] = work_of(forces.external);
  else
    for (int l = 0; l < n_loads; ++l)
      {
        Vector force = forces.external;
        assembler.external_force(forces.level, assembler.evaluate(loads.only(l), forces.time), force);
        sums[2 + l] = work_of(force);
      }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                assembler.distribution()->comm());
  return {{sums[0], {sums.begin() + 2, sums.end()}},
          sums[1],
          assembler.inertial_work(forces.level.acceleration, displacement)};
}

} // namespace sherd
