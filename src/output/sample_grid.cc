#include <sherd/output/sample_grid.h>

#include <algorithm>
#include <array>
#include <bit>

namespace sherd
{
namespace
{

/// What may be done with a sample, for each of the 256 patterns of its neighbours (bit k: neighbour k is set).
struct Rules
{
  std::array<std::array<bool, 256>, 2> parallel{}; ///< removed in pass 0, 1 of the parallel thinning
  std::array<bool, 256>                simple{};   ///< removal keeps the topology, and the sample is not an end
};

Rules make_rules()
{
  Rules rules;
  for (unsigned mask = 0; mask < 256; ++mask)
    {
      const auto p = [&](int k) { return int((mask >> (k & 7)) & 1u); };
      // Number of 8-connected components among the neighbours, and the two pairwise counts of the algorithm.
      int components = 0, pairs[2] = {0, 0};
      for (int k = 0; k < 8; k += 2)
        {
          components += !p(k) && (p(k + 1) || p(k + 2));
          pairs[0] += p(k + 7) || p(k);
          pairs[1] += p(k) || p(k + 1);
        }
      const int n           = std::min(pairs[0], pairs[1]);
      const int direction[] = {(p(4) || p(5) || !p(7)) && p(6), (p(0) || p(1) || !p(3)) && p(2)};
      for (int pass = 0; pass < 2; ++pass)
        rules.parallel[pass][mask] = components == 1 && (n == 2 || n == 3) && !direction[pass];
      const bool inner   = p(0) && p(2) && p(4) && p(6);
      rules.simple[mask] = components == 1 && !inner && std::popcount(mask) >= 2;
    }
  return rules;
}

} // namespace

std::vector<Sample> thin(SampleGrid grid)
{
  static const Rules rules = make_rules();

  // Only samples with an unset neighbour can go; those of the interior join once a neighbour has gone.
  std::vector<Sample> border, removed, next;
  SampleGrid          queued(grid.n_i(), grid.n_j());
  const auto          enqueue = [&](Sample s) {
    if (grid.depth(s) != 0 && queued.depth(s) == 0)
      {
        queued.set(s, 1);
        border.push_back(s);
      }
  };
  for (const auto &s : grid.samples())
    if (grid.neighbour_mask(s) != 255u)
      enqueue(s);

  for (int pass = 0, idle = 0; idle < 2; pass = 1 - pass)
    {
      removed.clear();
      for (const auto &s : border)
        if (rules.parallel[pass][grid.neighbour_mask(s)])
          removed.push_back(s);
      for (const auto &s : removed)
        grid.erase(s);
      next.clear();
      for (const auto &s : border)
        if (grid.depth(s) != 0)
          next.push_back(s);
      border.swap(next);
      for (const auto &s : removed)
        for (const auto &d : sample_neighbours)
          enqueue({s.i + d.i, s.j + d.j});
      idle = removed.empty() ? idle + 1 : 0;
    }

  std::sort(border.begin(), border.end());
  for (bool changed = true; changed;)
    {
      changed = false;
      for (const auto &s : border)
        if (grid.depth(s) != 0 && rules.simple[grid.neighbour_mask(s)])
          {
            grid.erase(s);
            changed = true;
          }
    }
  std::erase_if(border, [&](Sample s) { return grid.depth(s) == 0; });
  return border;
}

} // namespace sherd
