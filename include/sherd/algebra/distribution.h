#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <mpi.h>

namespace sherd
{

/// Which owned control points go to which rank, and where copies come from, both in the order of the messages.
/// Entry r of the ranks belongs to the blocks [offsets[r], offsets[r + 1]).
struct ExchangePlan
{
  std::vector<int> send_ranks, send_offsets       = {0}, send_blocks;    ///< local indices below n_owned
  std::vector<int> receive_ranks, receive_offsets = {0}, receive_blocks; ///< local indices from n_owned on
};

/// Control points (blocks of unknowns) of a rank: those it owns and the copies of others' it needs.
///
/// Local numbering: the owned ones first, in the order given, then the ghosts, in the order given. Over all ranks the
/// owned ids are 0, 1, ..., n_global - 1, each once; a rank may own nothing. Immutable; share it by
/// std::shared_ptr<const Distribution>.
class Distribution
{
public:
  /// Collective over @p comm, which has to outlive this object. Throws InvalidParameter on all ranks if an id is owned
  /// twice or by nobody, if a ghost is named twice or is owned by the same rank.
  Distribution(MPI_Comm comm, std::vector<std::int64_t> owned, std::vector<std::int64_t> ghosts);

  MPI_Comm     comm() const { return comm_; }
  int          rank() const { return rank_; }
  int          n_ranks() const { return n_ranks_; }
  int          n_owned() const { return n_owned_; }
  int          n_ghosts() const { return n_local() - n_owned_; }
  int          n_local() const { return static_cast<int>(ids_.size()); }
  std::int64_t n_global() const { return n_global_; }

  /// Global id of a local control point.
  std::int64_t global(int local) const { return ids_[local]; }

  /// Local index of a global id, -1 if it is neither owned nor a ghost.
  int local(std::int64_t global) const;

  /// Global ids of all local control points, shape=(n_local).
  std::span<const std::int64_t> ids() const { return ids_; }

  const ExchangePlan &exchange_plan() const { return plan_; }

private:
  MPI_Comm                                  comm_;
  int                                       rank_ = 0, n_ranks_ = 1, n_owned_ = 0;
  std::int64_t                              n_global_ = 0;
  std::vector<std::int64_t>                 ids_;
  std::vector<std::pair<std::int64_t, int>> sorted_;
  ExchangePlan                              plan_;
};

} // namespace sherd
