#include <sherd/space/shell_space.h>

#include <algorithm>
#include <numeric>

#include <sherd/space/ordering.h>
#include <sherd/space/partition.h>

namespace sherd
{

namespace
{

/// Elements of each control point, in compressed rows.
SparseGraph elements_of_points(const SpaceTopology &topology)
{
  SparseGraph graph;
  graph.offsets.assign(topology.n_points + 1, 0);
  for (const int point : topology.points)
    ++graph.offsets[point + 1];
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  graph.columns.resize(topology.points.size());
  std::vector<int> next(graph.offsets.begin(), graph.offsets.end() - 1);
  const int        n_elements = static_cast<int>(topology.offsets.size()) - 1;
  for (int e = 0; e < n_elements; ++e)
    for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
      graph.columns[next[topology.points[k]]++] = e;
  return graph;
}

/// Row of the control point graph: every control point that shares an element with @p point, itself included.
/// @p mark is work space, shape=(n_points), entries other than @p point on entry.
void neighbours(const SpaceTopology &topology, const SparseGraph &elements, int point, std::vector<int> &mark,
                std::vector<int> &row)
{
  row.clear();
  for (const int e : elements.row(point))
    for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
      if (const int other = topology.points[k]; mark[other] != point)
        {
          mark[other] = point;
          row.push_back(other);
        }
}

/// Graph of the @p points (surface ids) among themselves, numbered by their position in @p local (-1: left out),
/// without self edges.
SparseGraph graph_among(const SpaceTopology &topology, const SparseGraph &elements,
                        const std::vector<std::int64_t> &points, const std::vector<int> &local)
{
  SparseGraph      graph;
  std::vector<int> mark(topology.n_points, -1), row;
  for (const auto point : points)
    {
      neighbours(topology, elements, static_cast<int>(point), mark, row);
      const auto begin = graph.columns.size();
      for (const int other : row)
        if (other != point && local[other] >= 0)
          graph.columns.push_back(local[other]);
      std::sort(graph.columns.begin() + begin, graph.columns.end());
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
    }
  return graph;
}

} // namespace

SpaceDistribution distribute(const SpaceTopology &topology, int n_ranks, int rank)
{
  const int        n_points   = topology.n_points;
  const int        n_elements = static_cast<int>(topology.offsets.size()) - 1;
  const auto       elements   = elements_of_points(topology);
  std::vector<int> owner(n_points, 0);
  if (n_ranks > 1)
    {
      std::vector<std::int64_t> all(n_points);
      std::iota(all.begin(), all.end(), 0);
      std::vector<int> identity(n_points);
      std::iota(identity.begin(), identity.end(), 0);
      owner = partition(graph_among(topology, elements, all, identity), std::vector<int>(n_points, 1), n_ranks);
    }

  SpaceDistribution result;
  result.element_owner.resize(n_elements);
  for (int e = 0; e < n_elements; ++e)
    result.element_owner[e] = owner[topology.points[(topology.offsets[e] + topology.offsets[e + 1]) / 2]];

  // The owned control points in the order that keeps incomplete factors small.
  result.local.assign(n_points, -1);
  for (int i = 0; i < n_points; ++i)
    if (owner[i] == rank)
      {
        result.local[i] = static_cast<int>(result.owned.size());
        result.owned.push_back(i);
      }
  const auto                order = reverse_cuthill_mckee(graph_among(topology, elements, result.owned, result.local));
  std::vector<std::int64_t> ordered;
  for (const int i : order)
    ordered.push_back(result.owned[i]);
  result.owned = std::move(ordered);
  for (std::size_t i = 0; i < result.owned.size(); ++i)
    result.local[result.owned[i]] = static_cast<int>(i);

  std::vector<char> active(n_elements, 0);
  for (const auto point : result.owned)
    for (const int e : elements.row(static_cast<int>(point)))
      active[e] = 1;
  std::vector<char> ghost(n_points, 0);
  for (int e = 0; e < n_elements; ++e)
    if (active[e])
      {
        result.elements.push_back(e);
        for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
          if (owner[topology.points[k]] != rank)
            ghost[topology.points[k]] = 1;
      }
  for (int i = 0; i < n_points; ++i)
    if (ghost[i])
      {
        result.local[i] = static_cast<int>(result.owned.size() + result.ghosts.size());
        result.ghosts.push_back(i);
      }

  const auto first_local = [&](int e) {
    int first = n_points;
    for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
      first = std::min(first, result.local[topology.points[k]]);
    return first;
  };
  std::vector<int> key(n_elements);
  for (const int e : result.elements)
    key[e] = first_local(e);
  std::sort(result.elements.begin(), result.elements.end(),
            [&](int a, int b) { return std::pair(key[a], a) < std::pair(key[b], b); });

  result.element_offsets.assign(1, 0);
  for (const int e : result.elements)
    {
      result.owns.push_back(result.element_owner[e] == rank);
      for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
        result.element_points.push_back(result.local[topology.points[k]]);
      result.element_offsets.push_back(static_cast<int>(result.element_points.size()));
    }

  std::vector<int> mark(n_points, -1), row;
  for (const auto point : result.owned)
    {
      neighbours(topology, elements, static_cast<int>(point), mark, row);
      const auto begin = result.graph.columns.size();
      for (const int other : row)
        result.graph.columns.push_back(result.local[other]);
      std::sort(result.graph.columns.begin() + begin, result.graph.columns.end());
      result.graph.offsets.push_back(static_cast<int>(result.graph.columns.size()));
    }
  return result;
}

} // namespace sherd
