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

  Global     global;
  const auto n          = state.n_control_points;
  global.position       = internal::gather_rows<spacedim>(state.position);
  global.velocity       = internal::gather_rows<spacedim>(state.velocity).topRows(n);
  global.acceleration   = internal::gather_rows<spacedim>(state.acceleration).topRows(n);
  global.phase          = internal::gather_rows<1>(state.phase);
  global.previous_phase = internal::gather_rows<1>(state.previous_phase);
  if (const auto n_multipliers = global.phase.size() - n; n_multipliers > 0)
    {
      global.multipliers.pieces = space.interface_pieces();
      global.multipliers.values.resize(n_multipliers, 3);
      global.multipliers.values << global.position.bottomRows(n_multipliers).col(0), global.phase.tail(n_multipliers),
          global.previous_phase.tail(n_multipliers);
      global.position.conservativeResize(n, spacedim);
      global.phase.conservativeResize(n);
      global.previous_phase.conservativeResize(n);
    }
  global.time      = state.time;
  global.step_size = state.step_size;
  global.step      = state.step;

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
  const auto &q             = global.multipliers.values;
  const int   n_multipliers = space.n_multipliers();
  if (q.rows() != n_multipliers)
    throw DimensionMismatch("state: it has multipliers on " + std::to_string(q.rows()) +
                            " pieces of interfaces, the space on " + std::to_string(n_multipliers) +
                            "; go on with the continuity it was computed with");
  State<degree, spacedim> state(space);
  // Control points, then multipliers.
  const auto scatter = [&]<int n>(const ControlValues<n> &rows, int multiplier, Vector &vector) {
    if (n_multipliers == 0)
      return internal::scatter_rows<n>(rows, vector);
    ControlValues<n> all     = ControlValues<n>::Zero(rows.rows() + n_multipliers, n);
    all.topRows(rows.rows()) = rows;
    if (multiplier >= 0)
      all.col(0).tail(n_multipliers) = q.col(multiplier);
    internal::scatter_rows<n>(all, vector);
  };
  scatter.template operator()<spacedim>(global.position, 0, state.position);
  scatter.template operator()<spacedim>(global.velocity, -1, state.velocity);
  scatter.template operator()<spacedim>(global.acceleration, -1, state.acceleration);
  scatter.template operator()<1>(global.phase, 1, state.phase);
  scatter.template operator()<1>(global.previous_phase, 2, state.previous_phase);
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
  const auto n = state.n_control_points;
  return {state.time, internal::gather_rows<spacedim>(state.position).topRows(n),
          internal::gather_rows<spacedim>(state.velocity).topRows(n), internal::gather_rows<1>(state.phase).head(n)};
}

} // namespace sherd
