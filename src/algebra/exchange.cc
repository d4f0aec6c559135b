#include "exchange.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sherd
{

namespace
{

/// Sends counts[k] numbers for the k-th block of the plan and returns what arrives for the blocks to receive, of which
/// receive_counts[k] is known beforehand.
template <class Number>
std::vector<Number> exchange(const Distribution &distribution, MPI_Datatype type, const std::vector<Number> &sent,
                             std::span<const int> counts, std::span<const int> receive_counts)
{
  constexpr int            tag  = 4711;
  const auto              &plan = distribution.exchange_plan();
  std::vector<MPI_Request> requests;

  const auto total = [](std::span<const int> some, int begin, int end) {
    return std::accumulate(some.begin() + begin, some.begin() + end, 0);
  };
  std::vector<Number> received(total(receive_counts, 0, static_cast<int>(receive_counts.size())));
  for (std::size_t r = 0, place = 0; r < plan.receive_ranks.size(); ++r)
    {
      const int count = total(receive_counts, plan.receive_offsets[r], plan.receive_offsets[r + 1]);
      MPI_Irecv(received.data() + place, count, type, plan.receive_ranks[r], tag, distribution.comm(),
                &requests.emplace_back());
      place += count;
    }
  for (std::size_t r = 0, place = 0; r < plan.send_ranks.size(); ++r)
    {
      const int count = total(counts, plan.send_offsets[r], plan.send_offsets[r + 1]);
      MPI_Isend(sent.data() + place, count, type, plan.send_ranks[r], tag, distribution.comm(),
                &requests.emplace_back());
      place += count;
    }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return received;
}

} // namespace

void update_ghost_values(const Distribution &distribution, std::span<double> values, int block_size)
{
  if (distribution.n_ranks() == 1)
    return;
  const auto         &plan = distribution.exchange_plan();
  std::vector<double> sent;
  sent.reserve(plan.send_blocks.size() * block_size);
  for (const int a : plan.send_blocks)
    for (int c = 0; c < block_size; ++c)
      sent.push_back(values[static_cast<std::size_t>(a) * block_size + c]);
  const std::vector<int> counts(plan.send_blocks.size(), block_size);
  const std::vector<int> receive_counts(plan.receive_blocks.size(), block_size);
  const auto             received = exchange(distribution, MPI_DOUBLE, sent, counts, receive_counts);
  for (std::size_t k = 0; k < plan.receive_blocks.size(); ++k)
    std::copy_n(received.data() + k * block_size, block_size,
                values.data() + static_cast<std::size_t>(plan.receive_blocks[k]) * block_size);
}

GhostRows::GhostRows(const Distribution &distribution, const SparseGraph &graph) : extended_(graph)
{
  const auto               &plan = distribution.exchange_plan();
  std::vector<int>          lengths;
  std::vector<std::int64_t> ids;
  for (const int a : plan.send_blocks)
    {
      lengths.push_back(static_cast<int>(graph.row(a).size()));
      for (const int j : graph.row(a))
        ids.push_back(distribution.global(j));
    }
  const std::vector<int> ones(plan.send_blocks.size(), 1), receive_ones(plan.receive_blocks.size(), 1);
  received_lengths_       = exchange(distribution, MPI_INT, lengths, ones, receive_ones);
  const auto received_ids = exchange(distribution, MPI_INT64_T, ids, lengths, received_lengths_);

  std::vector<std::vector<std::pair<int, int>>> rows(distribution.n_ghosts()); // local column, position on arrival
  for (std::size_t k = 0, place = 0; k < plan.receive_blocks.size(); ++k)
    {
      auto &row = rows[plan.receive_blocks[k] - distribution.n_owned()];
      for (int m = 0; m < received_lengths_[k]; ++m, ++place)
        if (const int column = distribution.local(received_ids[place]); column >= 0)
          row.emplace_back(column, m);
      std::sort(row.begin(), row.end());
    }
  for (const auto &row : rows)
    {
      for (const auto &[column, source] : row)
        {
          extended_.columns.push_back(column);
          sources_.push_back(source);
        }
      extended_.offsets.push_back(static_cast<int>(extended_.columns.size()));
    }
}

std::vector<double> GhostRows::fetch(const Matrix &matrix) const
{
  const auto &distribution = matrix.distribution();
  const auto &plan         = distribution.exchange_plan();
  const int   block_size = matrix.block_size(), size = block_size * block_size, n_owned = distribution.n_owned();
  std::vector<double> sent;
  std::vector<int>    counts, receive_counts;
  for (const int a : plan.send_blocks)
    {
      const auto row = matrix.values().subspan(matrix.row_start(a), matrix.row_length(a) * block_size);
      sent.insert(sent.end(), row.begin(), row.end());
      counts.push_back(static_cast<int>(row.size()));
    }
  for (const int length : received_lengths_)
    receive_counts.push_back(length * size);
  const auto received = exchange(distribution, MPI_DOUBLE, sent, counts, receive_counts);

  std::vector<double> result(sources_.size() * size);
  const auto          first_block = static_cast<std::size_t>(extended_.offsets[n_owned]);
  for (std::size_t k = 0, place = 0; k < plan.receive_blocks.size(); ++k)
    {
      const int         ghost    = plan.receive_blocks[k];
      const auto        begin    = extended_.offsets[ghost] - first_block;
      const int         n_blocks = static_cast<int>(extended_.row(ghost).size());
      const std::size_t length = n_blocks * block_size, received_length = received_lengths_[k] * block_size;
      for (int m = 0; m < n_blocks; ++m)
        for (int c = 0; c < block_size; ++c)
          std::copy_n(received.data() + place + c * received_length + sources_[begin + m] * block_size, block_size,
                      result.data() + begin * size + c * length + m * block_size);
      place += receive_counts[k];
    }
  return result;
}

} // namespace sherd
