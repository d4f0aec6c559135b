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

/// Cells of each point, in compressed rows.
SparseGraph cells_of_points(const SpaceTopology &topology)
{
  SparseGraph graph;
  graph.offsets.assign(topology.n_points + 1, 0);
  for (const int point : topology.points)
    ++graph.offsets[point + 1];
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  graph.columns.resize(topology.points.size());
  std::vector<int> next(graph.offsets.begin(), graph.offsets.end() - 1);
  for (int cell = 0; cell < topology.n_cells(); ++cell)
    for (int k = topology.offsets[cell]; k < topology.offsets[cell + 1]; ++k)
      graph.columns[next[topology.points[k]]++] = cell;
  return graph;
}

/// Graph of the points: neighbours share a cell; every point is its own neighbour.
SparseGraph graph_of_points(const SpaceTopology &topology, const SparseGraph &cells)
{
  const int        n = topology.n_points;
  std::vector<int> mark(n, -1), offsets(1, 0), neighbours;
  neighbours.reserve(3 * topology.points.size());
  for (int i = 0; i < n; ++i)
    {
      for (const int cell : cells.row(i))
        for (int k = topology.offsets[cell]; k < topology.offsets[cell + 1]; ++k)
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

/// The part of a graph between its first @p n vertices.
SparseGraph leading(const SparseGraph &graph, int n)
{
  if (n == graph.n_rows())
    return graph;
  SparseGraph result;
  for (int i = 0; i < n; ++i)
    {
      for (const int j : graph.row(i))
        if (j < n)
          result.columns.push_back(j);
      result.offsets.push_back(static_cast<int>(result.columns.size()));
    }
  return result;
}

/// What each control point costs its rank in a Newton iteration, in tenths of a microsecond: its share of the elements
/// on which it acts, and the blocks of its row, to be factored and solved with. Measured in the plane at degree 2, with
/// point-block ILU(1); other elements and blocks are dearer, both. A piece of an interface counts like an element.
std::vector<int> costs_of_points(const SpaceTopology &topology, const SparseGraph &cells, const SparseGraph &graph)
{
  constexpr double element = 80.;
  constexpr int    block   = 3;
  std::vector<int> costs(topology.n_control_points());
  for (int i = 0; i < topology.n_control_points(); ++i)
    {
      double share = 0.;
      for (const int cell : cells.row(i))
        share += 1. / (topology.offsets[cell + 1] - topology.offsets[cell]);
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

/// Sorts cells by their first local point, those with the same one by their number.
void sort_cells(const SpaceTopology &topology, const SpaceDistribution &space, std::vector<int> &cells)
{
  std::vector<int> first, offsets(space.owned.size() + space.ghosts.size() + 1, 0);
  first.reserve(cells.size());
  for (const int cell : cells)
    {
      int smallest = topology.n_points;
      for (int k = topology.offsets[cell]; k < topology.offsets[cell + 1]; ++k)
        smallest = std::min(smallest, space.local[topology.points[k]]);
      first.push_back(smallest);
      ++offsets[smallest + 1];
    }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<int> sorted(cells.size());
  for (std::size_t k = 0; k < first.size(); ++k)
    sorted[offsets[first[k]]++] = cells[k];
  cells = std::move(sorted);
}

/// Rank of every multiplier: the one that owns most of its control points, of several the first.
void assign_multipliers(const SpaceTopology &topology, int n_ranks, std::vector<int> &owner)
{
  owner.resize(topology.n_points);
  std::vector<int> count(n_ranks);
  for (int k = 0; k < topology.n_multipliers; ++k)
    {
      const int cell = topology.n_elements() + k;
      std::fill(count.begin(), count.end(), 0);
      for (int l = topology.offsets[cell]; l < topology.offsets[cell + 1]; ++l)
        if (topology.points[l] < topology.n_control_points())
          ++count[owner[topology.points[l]]];
      owner[topology.n_control_points() + k] =
          static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
    }
}

/// The order of the owned points: control points such that incomplete factors stay small, each multiplier behind the
/// last of its neighbours, so that these are eliminated before its own diagonal, which is zero, is divided by.
std::vector<std::int64_t> order_owned(const SpaceTopology &topology, const SparseGraph &graph,
                                      const std::vector<std::int64_t> &owned)
{
  const int                 n_control  = topology.n_control_points();
  const auto                multiplier = std::lower_bound(owned.begin(), owned.end(), n_control);
  std::vector<std::int64_t> control(owned.begin(), multiplier), ordered;
  std::vector<int>          place(topology.n_points, -1);
  for (std::size_t i = 0; i < control.size(); ++i)
    place[control[i]] = static_cast<int>(i);
  const auto order = reverse_cuthill_mckee(restricted(graph, control, place));
  for (std::size_t i = 0; i < order.size(); ++i)
    place[control[order[i]]] = static_cast<int>(i);

  std::vector<std::vector<std::int64_t>> behind(control.size() + 1); // entry 0: without a neighbour
  for (auto m = multiplier; m != owned.end(); ++m)
    {
      int last = -1;
      for (const int neighbour : graph.row(static_cast<int>(*m)))
        last = std::max(last, place[neighbour]);
      behind[last + 1].push_back(*m);
    }
  for (std::size_t i = 0; i <= control.size(); ++i)
    {
      if (i > 0)
        ordered.push_back(control[order[i - 1]]);
      ordered.insert(ordered.end(), behind[i].begin(), behind[i].end());
    }
  return ordered;
}

} // namespace

SpaceDistribution distribute(const SpaceTopology &topology, int n_ranks, int rank, const Partitioner &partitioner)
{
  const int        n_points   = topology.n_points;
  const int        n_elements = topology.n_elements();
  const auto       cells      = cells_of_points(topology);
  const auto       graph      = graph_of_points(topology, cells);
  std::vector<int> owner(topology.n_control_points(), 0);
  if (n_ranks > 1)
    {
      owner =
          partitioner(leading(graph, topology.n_control_points()), costs_of_points(topology, cells, graph), n_ranks);
      check(owner, topology.n_control_points(), n_ranks);
    }
  assign_multipliers(topology, n_ranks, owner);
  const auto cell_owner = [&](int cell) {
    return owner[topology.points[(topology.offsets[cell] + topology.offsets[cell + 1]) / 2]];
  };

  SpaceDistribution result;
  result.element_owner.resize(n_elements);
  for (int e = 0; e < n_elements; ++e)
    result.element_owner[e] = cell_owner(e);

  for (int i = 0; i < n_points; ++i)
    if (owner[i] == rank)
      result.owned.push_back(i);
  result.owned = order_owned(topology, graph, result.owned);
  result.local.assign(n_points, -1);
  for (std::size_t i = 0; i < result.owned.size(); ++i)
    result.local[result.owned[i]] = static_cast<int>(i);

  std::vector<char> active(topology.n_cells(), 0);
  for (const auto point : result.owned)
    for (const int cell : cells.row(static_cast<int>(point)))
      active[cell] = 1;
  std::vector<char> ghost(n_points, 0);
  std::vector<int>  active_pieces; // as cells
  for (int cell = 0; cell < topology.n_cells(); ++cell)
    if (active[cell])
      {
        (cell < n_elements ? result.elements : active_pieces).push_back(cell);
        for (int k = topology.offsets[cell]; k < topology.offsets[cell + 1]; ++k)
          if (owner[topology.points[k]] != rank)
            ghost[topology.points[k]] = 1;
      }
  for (int i = 0; i < n_points; ++i)
    if (ghost[i])
      {
        result.local[i] = static_cast<int>(result.owned.size() + result.ghosts.size());
        result.ghosts.push_back(i);
      }

  sort_cells(topology, result, result.elements);
  sort_cells(topology, result, active_pieces);
  const auto add_points = [&](int cell, std::vector<int> &points, std::vector<int> &offsets) {
    for (int k = topology.offsets[cell]; k < topology.offsets[cell + 1]; ++k)
      points.push_back(result.local[topology.points[k]]);
    offsets.push_back(static_cast<int>(points.size()));
  };
  result.element_offsets.assign(1, 0);
  for (const int e : result.elements)
    {
      result.owns.push_back(result.element_owner[e] == rank);
      add_points(e, result.element_points, result.element_offsets);
    }
  result.interface_offsets.assign(1, 0);
  for (const int cell : active_pieces)
    {
      result.interfaces.push_back(cell - n_elements);
      result.owns_interface.push_back(cell_owner(cell) == rank);
      add_points(cell, result.interface_points, result.interface_offsets);
    }

  result.graph = local_graph(graph, result);
  return result;
}

} // namespace sherd
