#include <sherd/assembly/scatter.h>

namespace sherd
{

std::vector<RowRange> row_ranges(const SpaceDistribution &space, int n_ranges)
{
  const int n_rows   = static_cast<int>(space.owned.size());
  const int n_active = static_cast<int>(space.elements.size());

  std::vector<RowRange> ranges;
  const auto           &offsets = space.graph.offsets;
  for (int r = 0; r < n_ranges; ++r)
    {
      const auto bound = [&](int k) {
        const auto target = static_cast<long>(offsets.back()) * k / n_ranges;
        return static_cast<int>(std::lower_bound(offsets.begin(), offsets.end(), target) - offsets.begin());
      };
      ranges.push_back({std::min(bound(r), n_rows), r + 1 == n_ranges ? n_rows : std::min(bound(r + 1), n_rows), {}});
    }
  for (int e = 0; e < n_active; ++e)
    for (auto &range : ranges)
      {
        const auto *begin = space.element_points.data() + space.element_offsets[e];
        const auto *end   = space.element_points.data() + space.element_offsets[e + 1];
        if (std::any_of(begin, end, [&](int a) { return a >= range.begin && a < range.end; }))
          range.elements.push_back(e);
      }
  return ranges;
}

ScatterMap::ScatterMap(const SpaceDistribution &space)
{
  const int n_active = static_cast<int>(space.elements.size());
  const int n_owned  = static_cast<int>(space.owned.size());
  offsets_.assign(1, 0);
  for (int e = 0; e < n_active; ++e)
    {
      const std::size_t n = space.element_offsets[e + 1] - space.element_offsets[e];
      offsets_.push_back(offsets_.back() + n * n);
    }
  positions_.resize(offsets_.back(), -1);
  for (int e = 0; e < n_active; ++e)
    {
      const std::span<const int> points(space.element_points.data() + space.element_offsets[e],
                                        space.element_points.data() + space.element_offsets[e + 1]);
      int                       *out = positions_.data() + offsets_[e];
      for (const int a : points)
        {
          if (a < n_owned)
            {
              const auto row = space.graph.row(a);
              for (std::size_t b = 0; b < points.size(); ++b)
                out[b] = static_cast<int>(std::lower_bound(row.begin(), row.end(), points[b]) - row.begin());
            }
          out += points.size();
        }
    }
}

} // namespace sherd
