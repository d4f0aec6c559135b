#pragma once

#include <span>
#include <vector>

#include <sherd/space/ties.h>

namespace sherd
{

/// Ties among the local control points of one rank, ghosts included. A tied control point is local together with its
/// masters, since they act on all of its elements; no exchange is needed to apply a tie.
class LocalTies
{
public:
  LocalTies() = default;

  /// @param local   local number of each control point of the surface, or -1 (SpaceDistribution::local)
  /// @throws Error   a local control point whose master is not local
  LocalTies(const std::vector<Tie> &ties, const std::vector<int> &local);

  /// The ties in local numbering, in the order of construction.
  const std::vector<Tie> &list() const { return ties_; }

  /// Sets tied values from those of their masters. Ghosts that were up to date stay so.
  /// @param values       block_size values a local control point: displacements, phase, their increments or rates, but
  ///                     not positions; shape=(n_local * block_size)
  /// @param first_field  the field of the first value of a block; others follow. Ties of other fields are passed over
  void apply(std::span<double> values, int block_size, int first_field = 0) const;

private:
  std::vector<Tie> ties_;
};

/// Ties of @p supports among the local control points of @p space. @throws as ties
template <int degree, int spacedim>
LocalTies local_ties(const Supports &supports, const ShellSpace<degree, spacedim> &space)
{
  return {ties(supports, space.surface()), space.distribution().local};
}

} // namespace sherd
