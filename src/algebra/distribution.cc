#include <sherd/algebra/distribution.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

/// Sends to every rank the numbers meant for it; received[r] came from rank r.
template <class Number>
std::vector<std::vector<Number>> exchange_all(MPI_Comm comm, const std::vector<std::vector<Number>> &to_send)
{
  const int        n_ranks = static_cast<int>(to_send.size());
  std::vector<int> send_counts(n_ranks), receive_counts(n_ranks), send_offsets(n_ranks), receive_offsets(n_ranks);
  for (int r = 0; r < n_ranks; ++r)
    send_counts[r] = static_cast<int>(to_send[r].size() * sizeof(Number));
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, comm);
  std::exclusive_scan(send_counts.begin(), send_counts.end(), send_offsets.begin(), 0);
  std::exclusive_scan(receive_counts.begin(), receive_counts.end(), receive_offsets.begin(), 0);

  std::vector<Number> sent, arrived((receive_offsets.back() + receive_counts.back()) / sizeof(Number));
  for (const auto &numbers : to_send)
    sent.insert(sent.end(), numbers.begin(), numbers.end());
  MPI_Alltoallv(sent.data(), send_counts.data(), send_offsets.data(), MPI_BYTE, arrived.data(), receive_counts.data(),
                receive_offsets.data(), MPI_BYTE, comm);

  std::vector<std::vector<Number>> received(n_ranks);
  for (int r = 0; r < n_ranks; ++r)
    {
      const auto first = arrived.begin() + receive_offsets[r] / sizeof(Number);
      received[r].assign(first, first + receive_counts[r] / sizeof(Number));
    }
  return received;
}

constexpr std::int64_t no_id = std::numeric_limits<std::int64_t>::max();

/// Throws on all ranks if any of them names an id.
void throw_if_any(MPI_Comm comm, std::int64_t offender, const std::string &complaint)
{
  std::int64_t first = no_id;
  MPI_Allreduce(&offender, &first, 1, MPI_INT64_T, MPI_MIN, comm);
  if (first != no_id)
    throw InvalidParameter("control point " + std::to_string(first) + " " + complaint);
}

/// Remembers the owners of a contiguous range of ids, so that any rank can ask for the owner of any id.
class Directory
{
public:
  Directory(MPI_Comm comm, int n_ranks, std::int64_t n_global, std::span<const std::int64_t> owned)
      : comm_(comm), n_ranks_(n_ranks), chunk_(std::max<std::int64_t>(1, (n_global + n_ranks - 1) / n_ranks))
  {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    const auto begin = std::min(n_global, chunk_ * rank);
    owners_.assign(std::min(n_global, begin + chunk_) - begin, -1);

    const auto   registered = exchange_all(comm, sorted_by_keeper(owned));
    std::int64_t twice      = no_id;
    for (int r = 0; r < n_ranks; ++r)
      for (const auto id : registered[r])
        {
          auto &owner = owners_[id - begin];
          if (owner >= 0)
            twice = std::min(twice, id);
          owner = r;
        }
    throw_if_any(comm, twice, "is owned more than once; every control point needs exactly one owner");
    // As many ids as numbers in [0, n_global) and none twice: none is missing.
  }

  /// Owner of each of the ids, which have to be in [0, n_global).
  std::vector<int> owners(std::span<const std::int64_t> ids) const
  {
    const auto                    questions = exchange_all(comm_, sorted_by_keeper(ids));
    std::vector<std::vector<int>> answers(n_ranks_);
    int                           rank = 0;
    MPI_Comm_rank(comm_, &rank);
    for (int r = 0; r < n_ranks_; ++r)
      for (const auto id : questions[r])
        answers[r].push_back(owners_[id - chunk_ * rank]);
    const auto       answered = exchange_all(comm_, answers);
    std::vector<int> result, next(n_ranks_, 0);
    for (const auto id : ids)
      {
        const auto keeper = id / chunk_;
        result.push_back(answered[keeper][next[keeper]++]);
      }
    return result;
  }

private:
  std::vector<std::vector<std::int64_t>> sorted_by_keeper(std::span<const std::int64_t> ids) const
  {
    std::vector<std::vector<std::int64_t>> result(n_ranks_);
    for (const auto id : ids)
      result[id / chunk_].push_back(id);
    return result;
  }

  MPI_Comm         comm_;
  int              n_ranks_;
  std::int64_t     chunk_;
  std::vector<int> owners_;
};

void check_range(MPI_Comm comm, std::span<const std::int64_t> ids, std::int64_t n_global, const std::string &what)
{
  std::int64_t outside = no_id;
  for (const auto id : ids)
    if (id < 0 || id >= n_global)
      outside = std::min(outside, id);
  throw_if_any(comm, outside,
               what + " is outside [0, " + std::to_string(n_global) + "), the range of as many ids as are owned");
}

} // namespace

Distribution::Distribution(MPI_Comm comm, std::vector<std::int64_t> owned, std::vector<std::int64_t> ghosts)
    : comm_(comm), n_owned_(static_cast<int>(owned.size()))
{
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &n_ranks_);
  const std::int64_t n_owned = n_owned_;
  MPI_Allreduce(&n_owned, &n_global_, 1, MPI_INT64_T, MPI_SUM, comm);
  check_range(comm, owned, n_global_, "among the owned ones");
  check_range(comm, ghosts, n_global_, "among the ghosts");

  const Directory directory(comm, n_ranks_, n_global_, owned);
  const auto      owners = directory.owners(ghosts);

  ids_ = std::move(owned);
  ids_.insert(ids_.end(), ghosts.begin(), ghosts.end());
  sorted_.reserve(ids_.size());
  for (int a = 0; a < n_local(); ++a)
    sorted_.emplace_back(ids_[a], a);
  std::sort(sorted_.begin(), sorted_.end());
  const auto same = std::adjacent_find(sorted_.begin(), sorted_.end(),
                                       [](const auto &a, const auto &b) { return a.first == b.first; });
  throw_if_any(comm, same == sorted_.end() ? no_id : same->first,
               "is a ghost twice, or a ghost of the rank that owns it");

  std::vector<std::vector<std::int64_t>> wanted(n_ranks_);
  std::vector<std::vector<int>>          copies(n_ranks_);
  for (int g = 0; g < n_ghosts(); ++g)
    {
      wanted[owners[g]].push_back(ghosts[g]);
      copies[owners[g]].push_back(n_owned_ + g);
    }
  const auto requested = exchange_all(comm, wanted);
  for (int r = 0; r < n_ranks_; ++r)
    {
      if (!requested[r].empty())
        {
          plan_.send_ranks.push_back(r);
          for (const auto id : requested[r])
            plan_.send_blocks.push_back(local(id));
          plan_.send_offsets.push_back(static_cast<int>(plan_.send_blocks.size()));
        }
      if (!copies[r].empty())
        {
          plan_.receive_ranks.push_back(r);
          plan_.receive_blocks.insert(plan_.receive_blocks.end(), copies[r].begin(), copies[r].end());
          plan_.receive_offsets.push_back(static_cast<int>(plan_.receive_blocks.size()));
        }
    }
}

int Distribution::local(std::int64_t global) const
{
  const auto place = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(global, 0));
  return place != sorted_.end() && place->first == global ? place->second : -1;
}

} // namespace sherd
