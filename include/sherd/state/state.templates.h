#pragma once

#include <algorithm>

#include <sherd/state/state.h>

namespace sherd
{

namespace internal
{
template <int n>
ControlValues<n> gather_rows(const Vector &v)
{
  const auto values = gather(v);
  return Eigen::Map<const ControlValues<n>>(values.data(), values.size() / n, n);
}

template <int n>
void scatter_rows(const ControlValues<n> &rows, Vector &v)
{
  scatter(std::span<const double>(rows.data(), rows.size()), v);
}
} // namespace internal

template <int degree, int spacedim>
GlobalState<degree, spacedim> gather(const State<degree, spacedim> &state, const ShellSpace<degree, spacedim> &space)
{
  using Global             = GlobalState<degree, spacedim>;
  constexpr int n_q        = Global::n_q;
  const auto   &d          = space.distribution();
  const int     n_elements = space.surface().n_elements();

  Global global;
  global.position       = internal::gather_rows<spacedim>(state.position);
  global.velocity       = internal::gather_rows<spacedim>(state.velocity);
  global.acceleration   = internal::gather_rows<spacedim>(state.acceleration);
  global.phase          = internal::gather_rows<1>(state.phase);
  global.previous_phase = internal::gather_rows<1>(state.previous_phase);
  global.time           = state.time;
  global.step_size      = state.step_size;
  global.step           = state.step;

  // Every element has one owner; the others add zero.
  global.history = Global::History::Zero(n_elements, n_q);
  for (int e = 0; e < space.n_active_elements(); ++e)
    if (d.owns[e])
      std::copy_n(state.history[e], n_q, global.history.row(d.elements[e]).data());
  MPI_Allreduce(MPI_IN_PLACE, global.history.data(), static_cast<int>(global.history.size()), MPI_DOUBLE, MPI_SUM,
                space.environment().comm());
  return global;
}

template <int degree, int spacedim>
State<degree, spacedim> distribute(const GlobalState<degree, spacedim> &global,
                                   const ShellSpace<degree, spacedim>  &space)
{
  State<degree, spacedim> state(space);
  internal::scatter_rows(global.position, state.position);
  internal::scatter_rows(global.velocity, state.velocity);
  internal::scatter_rows(global.acceleration, state.acceleration);
  internal::scatter_rows<1>(global.phase, state.phase);
  internal::scatter_rows<1>(global.previous_phase, state.previous_phase);
  for (int e = 0; e < space.n_active_elements(); ++e)
    std::copy_n(global.history.row(space.distribution().elements[e]).data(), state.n_q, state.history[e]);
  state.time      = global.time;
  state.step_size = global.step_size;
  state.step      = global.step;
  return state;
}

template <int degree, int spacedim>
Snapshot<spacedim> snapshot(const State<degree, spacedim> &state)
{
  return {state.time, internal::gather_rows<spacedim>(state.position), internal::gather_rows<spacedim>(state.velocity),
          internal::gather_rows<1>(state.phase)};
}

} // namespace sherd
