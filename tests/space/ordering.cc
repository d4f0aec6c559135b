// label: unit
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/space/ordering.h>

using namespace sherd;

namespace
{

SparseGraph from_edges(int n, const std::vector<std::pair<int, int>> &edges)
{
  std::vector<std::set<int>> rows(n);
  for (const auto &[i, j] : edges)
    {
      rows[i].insert(j);
      rows[j].insert(i);
    }
  SparseGraph graph;
  for (const auto &row : rows)
    {
      graph.columns.insert(graph.columns.end(), row.begin(), row.end());
      graph.offsets.push_back(static_cast<int>(graph.columns.size()));
    }
  return graph;
}

std::vector<int> shuffled(int n)
{
  std::vector<int> result(n);
  std::iota(result.begin(), result.end(), 0);
  std::shuffle(result.begin(), result.end(), std::mt19937(5));
  return result;
}

/// width x height grid with the diagonal entries, its vertices renamed by @p name.
SparseGraph grid(int width, int height, const std::vector<int> &name)
{
  std::vector<std::pair<int, int>> edges;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      {
        const int i = y * width + x;
        edges.emplace_back(name[i], name[i]);
        if (x + 1 < width)
          edges.emplace_back(name[i], name[i + 1]);
        if (y + 1 < height)
          edges.emplace_back(name[i], name[i + width]);
      }
  return from_edges(width * height, edges);
}

bool is_permutation_of_all(std::vector<int> order, int n)
{
  std::sort(order.begin(), order.end());
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

} // namespace

TEST_CASE("A shuffled path becomes a path again")
{
  const int                        n    = 50;
  const auto                       name = shuffled(n);
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i + 1 < n; ++i)
    edges.emplace_back(name[i], name[i + 1]);
  const auto graph = from_edges(n, edges);

  const auto order = reverse_cuthill_mckee(graph);

  CHECK(is_permutation_of_all(order, n));
  CHECK(bandwidth(graph, order) == 1); // only an end of the path as start gives this
}

TEST_CASE("The bandwidth of a shuffled grid comes down to about its width")
{
  const int  width = 8, height = 40;
  const auto graph = grid(width, height, shuffled(width * height));

  const auto order = reverse_cuthill_mckee(graph);

  CHECK(is_permutation_of_all(order, width * height));
  // Levels from a corner are diagonals of at most `width` vertices; an edge spans two levels.
  CHECK(bandwidth(graph, order) <= 2 * width);
  std::vector<int> as_named(width * height);
  std::iota(as_named.begin(), as_named.end(), 0);
  CHECK(bandwidth(graph, as_named) > 10 * width);
}

TEST_CASE("Components stay together and isolated vertices are kept")
{
  // Two paths of interleaved names and two isolated vertices.
  const auto graph = from_edges(10, {{0, 2}, {2, 4}, {4, 6}, {1, 3}, {3, 5}, {9, 9}});

  const auto order = reverse_cuthill_mckee(graph);

  CHECK(is_permutation_of_all(order, 10));
  CHECK(bandwidth(graph, order) == 1);
  CHECK(reverse_cuthill_mckee(SparseGraph{}).empty());
}

TEST_CASE("The order is that of Cuthill and McKee, reversed")
{
  // A star whose arms 1, 2, 3 have 0, 1, 2 further vertices. From the end 6 of the longest path 6-5-3-0-2-4 (or from 4)
  // vertices come by distance, then by degree.
  const auto graph  = from_edges(7, {{0, 1}, {0, 2}, {0, 3}, {2, 4}, {3, 5}, {5, 6}});
  const auto order  = reverse_cuthill_mckee(graph);
  const auto from_6 = std::vector<int>{4, 2, 1, 0, 3, 5, 6}, from_4 = std::vector<int>{6, 5, 3, 1, 0, 2, 4};
  CHECK((order == from_6 || order == from_4));
}

TEST_CASE("Columns out of range are refused")
{
  CHECK_THROWS_AS(reverse_cuthill_mckee(SparseGraph{{0, 1}, {1}}), DimensionMismatch);
}
