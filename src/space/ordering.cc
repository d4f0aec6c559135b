#include <sherd/space/ordering.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

/// Vertices of one component by distance from a start.
struct Levels
{
  std::vector<int> vertices;  ///< in the order of their distance
  std::size_t      last  = 0; ///< position of the first vertex at the largest distance
  int              depth = 0; ///< the largest distance
};

class CuthillMcKee
{
public:
  explicit CuthillMcKee(const SparseGraph &graph) : graph_(graph), seen_(graph.n_rows(), 0), degrees_(graph.n_rows())
  {
    for (int i = 0; i < graph.n_rows(); ++i)
      degrees_[i] = static_cast<int>(graph.row(i).size());
  }

  std::vector<int> order()
  {
    const int         n = graph_.n_rows();
    std::vector<int>  result;
    std::vector<bool> done(n, false);
    result.reserve(n);
    for (int i = 0; i < n; ++i)
      if (!done[i])
        {
          const auto component = breadth_first(pseudo_peripheral(i)).vertices;
          for (const int vertex : component)
            done[vertex] = true;
          result.insert(result.end(), component.begin(), component.end());
        }
    std::reverse(result.begin(), result.end());
    return result;
  }

private:
  /// Breadth-first search that takes the neighbours of a vertex by increasing degree.
  Levels breadth_first(int start)
  {
    ++stamp_;
    Levels result;
    result.vertices  = {start};
    seen_[start]     = stamp_;
    std::size_t next = 0;
    while (true)
      {
        const std::size_t end = result.vertices.size();
        result.last           = next;
        for (; next < end; ++next)
          {
            const auto first = result.vertices.size();
            for (const int j : graph_.row(result.vertices[next]))
              if (seen_[j] != stamp_)
                {
                  seen_[j] = stamp_;
                  result.vertices.push_back(j);
                }
            std::stable_sort(result.vertices.begin() + first, result.vertices.end(),
                             [&](int a, int b) { return degrees_[a] < degrees_[b]; });
          }
        if (result.vertices.size() == end)
          return result;
        ++result.depth;
      }
  }

  /// Start of a long search: from the vertex of least degree at the far end, as long as that makes it longer.
  int pseudo_peripheral(int start)
  {
    auto levels = breadth_first(start);
    while (true)
      {
        const auto far  = *std::min_element(levels.vertices.begin() + levels.last, levels.vertices.end(),
                                            [&](int a, int b) { return degrees_[a] < degrees_[b]; });
        auto       next = breadth_first(far);
        if (next.depth <= levels.depth)
          return start;
        start  = far;
        levels = std::move(next);
      }
  }

  const SparseGraph &graph_;
  std::vector<int>   seen_; ///< number of the last search that met each vertex
  std::vector<int>   degrees_;
  int                stamp_ = 0;
};

} // namespace

std::vector<int> reverse_cuthill_mckee(const SparseGraph &graph)
{
  for (const int column : graph.columns)
    if (column < 0 || column >= graph.n_rows())
      throw DimensionMismatch("reverse Cuthill-McKee: column " + std::to_string(column) + " in a graph of " +
                              std::to_string(graph.n_rows()) + " vertices");
  return CuthillMcKee(graph).order();
}

int bandwidth(const SparseGraph &graph, std::span<const int> order)
{
  std::vector<int> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    position[order[k]] = static_cast<int>(k);
  int result = 0;
  for (int i = 0; i < graph.n_rows(); ++i)
    for (const int j : graph.row(i))
      result = std::max(result, std::abs(position[i] - position[j]));
  return result;
}

} // namespace sherd
