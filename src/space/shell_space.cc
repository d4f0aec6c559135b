#include <sherd/space/shell_space.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <sherd/base/exceptions.h>
#include <sherd/space/ordering.h>

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

/// Graph of the control points: neighbours share an element; every point is its own neighbour.
SparseGraph graph_of_points(const SpaceTopology &topology, const SparseGraph &elements)
{
  const int        n = topology.n_points;
  std::vector<int> mark(n, -1), offsets(1, 0), neighbours;
  neighbours.reserve(3 * topology.points.size());
  for (int i = 0; i < n; ++i)
    {
      for (const int e : elements.row(i))
        for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
          if (const int j = topology.points[k]; mark[j] != i)
            {
              mark[j] = i;
              neighbours.push_back(j);
            }
      offsets.push_back(static_cast<int>(neighbours.size()));
    }

  // The graph is symmetric: its transpose is the same one, with ascending columns.
  SparseGraph graph;
  graph.columns.resize(neighbours.size());
  std::vector<int> next(offsets.begin(), offsets.end() - 1);
  for (int i = 0; i < n; ++i)
    for (int k = offsets[i]; k < offsets[i + 1]; ++k)
      graph.columns[next[neighbours[k]]++] = i;
  graph.offsets = std::move(offsets);
  return graph;
}

/// What each control point costs its rank in a Newton iteration, in tenths of a microsecond: its share of the elements
/// on which it acts, and the blocks of its row, to be factored and solved with. Measured in the plane at degree 2, with
/// point-block ILU(1); other elements and blocks are dearer, both.
std::vector<int> costs_of_points(const SpaceTopology &topology, const SparseGraph &elements, const SparseGraph &graph)
{
  constexpr double element = 80.;
  constexpr int    block   = 3;
  std::vector<int> costs(topology.n_points);
  for (int i = 0; i < topology.n_points; ++i)
    {
      double share = 0.;
      for (const int e : elements.row(i))
        share += 1. / (topology.offsets[e + 1] - topology.offsets[e]);
      costs[i] = static_cast<int>(std::lround(element * share)) + block * static_cast<int>(graph.row(i).size());
    }
  return costs;
}

void check(const std::vector<int> &owner, int n_points, int n_ranks)
{
  if (static_cast<int>(owner.size()) != n_points)
    throw DimensionMismatch("distribution of control points: the partitioner gives " + std::to_string(owner.size()) +
                            " ranks for " + std::to_string(n_points) + " control points");
  for (const int rank : owner)
    if (rank < 0 || rank >= n_ranks)
      throw InvalidParameter("distribution of control points: the partitioner names rank " + std::to_string(rank) +
                             ", expected 0 to " + std::to_string(n_ranks - 1));
}

/// The part of a graph on the @p rows, numbered by @p local (-1: left out), which ascends along them.
SparseGraph restricted(const SparseGraph &graph, const std::vector<std::int64_t> &rows, const std::vector<int> &local)
{
  SparseGraph result;
  for (const auto row : rows)
    {
      for (const int j : graph.row(static_cast<int>(row)))
        if (local[j] >= 0)
          result.columns.push_back(local[j]);
      result.offsets.push_back(static_cast<int>(result.columns.size()));
    }
  return result;
}

/// Rows of the owned control points in the numbering of @p space, with ascending columns.
SparseGraph local_graph(const SparseGraph &graph, const SpaceDistribution &space)
{
  SparseGraph result;
  const int   n_owned = static_cast<int>(space.owned.size());
  result.offsets.reserve(n_owned + 1);
  for (const auto point : space.owned)
    result.offsets.push_back(result.offsets.back() + static_cast<int>(graph.row(static_cast<int>(point)).size()));
  result.columns.resize(result.offsets.back());
  std::vector<int> next(result.offsets.begin(), result.offsets.end() - 1);
  int              column = 0;
  for (const auto *points : {&space.owned, &space.ghosts})
    for (const auto point : *points)
      {
        for (const int j : graph.row(static_cast<int>(point)))
          if (const int row = space.local[j]; row >= 0 && row < n_owned)
            result.columns[next[row]++] = column;
        ++column;
      }
  return result;
}

/// Sorts elements by their first local control point, those with the same one by their number.
void sort_elements(const SpaceTopology &topology, SpaceDistribution &space)
{
  std::vector<int> first, offsets(space.owned.size() + space.ghosts.size() + 1, 0);
  first.reserve(space.elements.size());
  for (const int e : space.elements)
    {
      int smallest = topology.n_points;
      for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
        smallest = std::min(smallest, space.local[topology.points[k]]);
      first.push_back(smallest);
      ++offsets[smallest + 1];
    }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<int> sorted(space.elements.size());
  for (std::size_t k = 0; k < first.size(); ++k)
    sorted[offsets[first[k]]++] = space.elements[k];
  space.elements = std::move(sorted);
}

} // namespace

SpaceDistribution distribute(const SpaceTopology &topology, int n_ranks, int rank, const Partitioner &partitioner)
{
  const int        n_points   = topology.n_points;
  const int        n_elements = static_cast<int>(topology.offsets.size()) - 1;
  const auto       elements   = elements_of_points(topology);
  const auto       graph      = graph_of_points(topology, elements);
  std::vector<int> owner(n_points, 0);
  if (n_ranks > 1)
    {
      owner = partitioner(graph, costs_of_points(topology, elements, graph), n_ranks);
      check(owner, n_points, n_ranks);
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
  const auto                order = reverse_cuthill_mckee(restricted(graph, result.owned, result.local));
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

  sort_elements(topology, result);
  result.element_offsets.assign(1, 0);
  for (const int e : result.elements)
    {
      result.owns.push_back(result.element_owner[e] == rank);
      for (int k = topology.offsets[e]; k < topology.offsets[e + 1]; ++k)
        result.element_points.push_back(result.local[topology.points[k]]);
      result.element_offsets.push_back(static_cast<int>(result.element_points.size()));
    }

  result.graph = local_graph(graph, result);
  return result;
}

} // namespace sherd
