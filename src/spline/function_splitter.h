#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <sherd/spline/local_knots.h>
#include <sherd/spline/lr_basis.h>
#include <sherd/spline/lr_mesh.h>

namespace sherd::internal
{

/// Splits functions until none is crossed by a line of the mesh, and remembers where the parts come from.  theory H.2,
/// H.3
///
/// Each old function j is gamma_j B_j = sum_k s_kj B_k. The shares s_kj are all that is needed: gamma_k = sum_j s_kj,
/// and the control data follow by c_k = sum_j (s_kj / gamma_k) c_j. Functions are found by a hash of their knots.
template <int degree>
class FunctionSplitter
{
public:
  /// Part of one old function in a new one.
  struct Share
  {
    int    old;
    double value;
    int    next; ///< next share of the same function; -1 at the end
  };

  struct Entry
  {
    std::array<LocalKnots<degree>, 2> knots;
    int                               origin;      ///< an old function whose support contains this one
    bool                              is_old;      ///< is the function origin itself
    bool                              split;       ///< has been replaced by its parts
    int                               first_share; ///< -1 if none
  };

  explicit FunctionSplitter(const LRMesh &mesh) : mesh_(mesh), slots_(64, -1) {}

  /// Registers the old function @p i, so that equal parts of others are added to it; returns its entry.
  int add_old(int i, const LRFunction<degree> &function);

  /// True if some line crosses the support and asks for a split.
  bool is_crossed(const LRFunction<degree> &function);

  /// Splits the entries @p queue and their parts until none is crossed.
  void run(std::vector<int> queue);

  const std::vector<Entry> &entries() const { return entries_; }
  const std::vector<Share> &shares() const { return shares_; }

private:
  /// Finds or makes the entry with these knots.
  int find(const std::array<LocalKnots<degree>, 2> &knots, int origin);
  /// Adds to a share of the entry.
  void add_share(int entry, int old, double value);
  /// Sets inserted_[d] to the missing knots of direction d, with multiplicity; true if there are any.
  bool collect_missing(const std::array<LocalKnots<degree>, 2> &knots, int d);
  /// Replaces the entry by its parts and appends to queue those not checked yet.
  void split(int entry, std::vector<int> &queue);
  void grow_table();

  static std::uint64_t hash(const std::array<LocalKnots<degree>, 2> &knots);

  const LRMesh                      &mesh_;
  std::vector<Entry>                 entries_;
  std::vector<Share>                 shares_;
  std::vector<int>                   slots_; ///< open addressing; entry or -1, size a power of 2
  std::array<std::vector<double>, 2> missing_;
  std::array<KnotInsertion, 2>       parts_;
};

template <int degree>
std::uint64_t FunctionSplitter<degree>::hash(const std::array<LocalKnots<degree>, 2> &knots)
{
  std::uint64_t h = 0;
  for (const auto &direction : knots)
    for (const double knot : direction)
      {
        h = (h ^ std::bit_cast<std::uint64_t>(knot)) * 0x9e3779b97f4a7c15u;
        h ^= h >> 32;
      }
  return h;
}

template <int degree>
int FunctionSplitter<degree>::find(const std::array<LocalKnots<degree>, 2> &knots, int origin)
{
  if (2 * entries_.size() >= slots_.size())
    grow_table();
  const std::size_t mask = slots_.size() - 1;
  std::size_t       slot = hash(knots) & mask;
  while (slots_[slot] >= 0)
    {
      if (entries_[slots_[slot]].knots == knots)
        return slots_[slot];
      slot = (slot + 1) & mask;
    }
  slots_[slot] = static_cast<int>(entries_.size());
  entries_.push_back({knots, origin, false, false, -1});
  return slots_[slot];
}

template <int degree>
void FunctionSplitter<degree>::grow_table()
{
  slots_.assign(2 * slots_.size(), -1);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = 0; i < entries_.size(); ++i)
    {
      std::size_t slot = hash(entries_[i].knots) & mask;
      while (slots_[slot] >= 0)
        slot = (slot + 1) & mask;
      slots_[slot] = static_cast<int>(i);
    }
}

template <int degree>
void FunctionSplitter<degree>::add_share(int entry, int old, double value)
{
  for (int s = entries_[entry].first_share; s >= 0; s = shares_[s].next)
    if (shares_[s].old == old)
      {
        shares_[s].value += value;
        return;
      }
  shares_.push_back({old, value, entries_[entry].first_share});
  entries_[entry].first_share = static_cast<int>(shares_.size()) - 1;
}

template <int degree>
int FunctionSplitter<degree>::add_old(int i, const LRFunction<degree> &function)
{
  const int entry        = find(function.knots, i);
  entries_[entry].is_old = true;
  add_share(entry, i, function.gamma);
  return entry;
}

template <int degree>
bool FunctionSplitter<degree>::is_crossed(const LRFunction<degree> &function)
{
  return collect_missing(function.knots, 0) || collect_missing(function.knots, 1);
}

template <int degree>
bool FunctionSplitter<degree>::collect_missing(const std::array<LocalKnots<degree>, 2> &knots, int d)
{
  const auto &own = knots[d], &other = knots[1 - d];
  missing_[d].clear();
  std::size_t k = 0;
  for (const auto &line : mesh_.between(static_cast<Direction>(d), own.front(), own.back()))
    {
      int present = 0;
      for (; own[k] <= line.value; ++k)
        present += own[k] == line.value;
      for (int wanted = line.multiplicity(other.front(), other.back()); present < wanted; ++present)
        missing_[d].push_back(line.value);
    }
  return !missing_[d].empty();
}

template <int degree>
void FunctionSplitter<degree>::split(int entry, std::vector<int> &queue)
{
  const auto parent = entries_[entry];
  for (int d = 0; d < 2; ++d)
    insert_knots<degree>(parent.knots[d], missing_[d], parts_[d]);
  entries_[entry].split       = true;
  entries_[entry].first_share = -1;

  std::array<LocalKnots<degree>, 2> knots;
  for (std::size_t j = 0; j < parts_[1].weights.size(); ++j)
    for (std::size_t i = 0; i < parts_[0].weights.size(); ++i)
      {
        const double weight = parts_[0].weights[i] * parts_[1].weights[j];
        if (weight == 0.)
          continue;
        std::copy_n(parts_[0].knots.begin() + i, degree + 2, knots[0].begin());
        std::copy_n(parts_[1].knots.begin() + j, degree + 2, knots[1].begin());
        const std::size_t n_before = entries_.size();
        const int         part     = find(knots, parent.origin);
        if (entries_.size() > n_before || entries_[part].split)
          {
            // Parts met again after their own split are split once more, with the new shares only.
            entries_[part].split = false;
            queue.push_back(part);
          }
        for (int s = parent.first_share; s >= 0; s = shares_[s].next)
          add_share(part, shares_[s].old, weight * shares_[s].value);
      }
}

template <int degree>
void FunctionSplitter<degree>::run(std::vector<int> queue)
{
  std::vector<int> next;
  while (!queue.empty())
    {
      next.clear();
      for (const int entry : queue)
        {
          const auto &knots = entries_[entry].knots;
          const bool  in_u = collect_missing(knots, 0), in_v = collect_missing(knots, 1);
          if (in_u || in_v)
            split(entry, next);
        }
      std::swap(queue, next);
    }
}

} // namespace sherd::internal
