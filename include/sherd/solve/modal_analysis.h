#pragma once

#include <cmath>
#include <vector>

#include <sherd/algebra/eigen_solver.h>
#include <sherd/assembly/assembler.h>
#include <sherd/solve/supported_unknowns.h>

namespace sherd
{

/// A small free vibration u(t) = shape cos(omega t) about a state at rest.
template <int spacedim>
struct VibrationMode
{
  double omega; ///< angular frequency [1/time]; negative: -|omega| of an unstable state, which leaves as exp(|omega| t)
  Vector shape; ///< displacement, block spacedim, int rho |shape|^2 dA = 1
};

/// Lowest modes K v = omega^2 M v of the shell linearised at @p state, without loads and with its phase field held.
/// Collective. The shift of @p settings is in omega^2.
/// @throws as lowest_eigenpairs; InvalidParameter for a space with multipliers, which have no mass
template <class Model>
std::vector<VibrationMode<Model::spacedim>>
vibration_modes(const Model &model, const ShellSpace<Model::degree, Model::spacedim> &space, const Supports &supports,
                const State<Model::degree, Model::spacedim> &state, const EigenSettings &settings)
{
  constexpr int spacedim = Model::spacedim, n_fields = Model::n_fields;
  if (space.n_multipliers() > 0)
    throw InvalidParameter("vibration modes: the space keeps patches together by " +
                           std::to_string(space.n_multipliers()) + " multipliers, which have no mass; use " +
                           "continuity::Penalty");
  const SupportedUnknowns<Model::degree, spacedim> supported(supports, space);
  Assembler<Model> assembler(model, space, state.distribution, supported.ties(), supports.weak_edges());
  assembler.soften_interfaces(state.phase);
  Matrix stiffness = assembler.make_matrix(), mass     = stiffness;
  Vector force(state.distribution, n_fields), external = force, rest = state.acceleration;
  rest.fill(0.);
  LoadValues<Model> none;
  none.time = state.time;
  assembler.linearise({state.position, rest, state.phase}, state.history, 0., PhaseTangent::consistent, none, force,
                      external, stiffness);
  assembler.mass_matrix(mass);
  auto fixed = supported.fixed();
  for (std::size_t k = spacedim; k < fixed.size(); k += n_fields)
    fixed[k] = 1;

  const auto                           pairs = lowest_eigenpairs(stiffness, mass, fixed, settings);
  std::vector<VibrationMode<spacedim>> modes;
  for (std::size_t m = 0; m < pairs.values.size(); ++m)
    {
      Vector values = pairs.vectors[m];
      supported.complete(values);
      Vector shape(state.distribution, spacedim);
      for (int a = 0; a < state.distribution->n_local(); ++a)
        for (int c = 0; c < spacedim; ++c)
          shape.local()[a * spacedim + c] = values.local()[a * n_fields + c];
      modes.push_back({std::copysign(std::sqrt(std::abs(pairs.values[m])), pairs.values[m]), std::move(shape)});
    }
  return modes;
}

} // namespace sherd
