// label: unit
#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/space/partition.h>

using namespace sherd;

namespace
{

/// n x n grid, each vertex joined to itself and to its four neighbours.
SparseGraph grid(int n)
{
  SparseGraph graph;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      {
        if (y > 0)
          graph.columns.push_back((y - 1) * n + x);
        if (x > 0)
          graph.columns.push_back(y * n + x - 1);
        graph.columns.push_back(y * n + x);
        if (x < n - 1)
          graph.columns.push_back(y * n + x + 1);
        if (y < n - 1)
          graph.columns.push_back((y + 1) * n + x);
        graph.offsets.push_back(static_cast<int>(graph.columns.size()));
      }
  return graph;
}

std::vector<int> weights_of_parts(const std::vector<int> &parts, const std::vector<int> &weights, int n_parts)
{
  std::vector<int> result(n_parts, 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
    {
      REQUIRE(parts[i] >= 0);
      REQUIRE(parts[i] < n_parts);
      result[parts[i]] += weights[i];
    }
  return result;
}

int cut(const SparseGraph &graph, const std::vector<int> &parts)
{
  int result = 0;
  for (int i = 0; i < graph.n_rows(); ++i)
    for (const int j : graph.row(i))
      result += parts[i] < parts[j] ? 1 : 0;
  return result;
}

} // namespace

TEST_CASE("Parts have similar weights and short borders")
{
  const int        n = 20, n_parts = GENERATE(2, 3, 5, 12);
  const auto       graph = grid(n);
  std::vector<int> weights(n * n, 1);
  SECTION("equal vertices") {}
  SECTION("vertices of the left half weigh four times as much")
  {
    for (int i = 0; i < n * n; ++i)
      weights[i] = i % n < n / 2 ? 4 : 1;
  }

  const auto parts = partition(graph, weights, n_parts);

  const auto   of_parts = weights_of_parts(parts, weights, n_parts);
  const double mean     = std::accumulate(of_parts.begin(), of_parts.end(), 0.) / n_parts;
  // METIS allows 3 % of imbalance with many parts; on few heavy vertices rounding adds to it.
  CHECK(*std::max_element(of_parts.begin(), of_parts.end()) < 1.1 * mean);
  CHECK(*std::min_element(of_parts.begin(), of_parts.end()) > 0.7 * mean);
  // Strips cut n edges at each of n_parts - 1 borders.
  CHECK(cut(graph, parts) <= n * (n_parts - 1) * 1.2);
  CHECK(cut(graph, parts) >= n_parts);
}

TEST_CASE("The same graph gives the same parts")
{
  const auto graph = grid(15);
  CHECK(partition(graph, {}, 4) == partition(graph, {}, 4));
  CHECK(partition(graph, {}, 9) == partition(graph, {}, 9));
  CHECK(partition(graph, {}, 4) == partition(graph, std::vector<int>(225, 1), 4));
}

TEST_CASE("One part, no vertices, more parts than vertices and separate components are no problem")
{
  CHECK(partition(grid(3), {}, 1) == std::vector<int>(9, 0));
  CHECK(partition(SparseGraph{}, {}, 3).empty());
  CHECK(partition(grid(2), {}, 7) == std::vector<int>{0, 1, 2, 3});

  SparseGraph isolated;
  isolated.offsets.assign(101, 0);
  const auto parts    = partition(isolated, {}, 2);
  const auto of_parts = weights_of_parts(parts, std::vector<int>(100, 1), 2);
  CHECK(std::abs(of_parts[0] - of_parts[1]) <= 10);

  CHECK(weights_of_parts(partition(grid(5), std::vector<int>(25, 0), 2), std::vector<int>(25, 1), 2)[0] > 0);
}

TEST_CASE("A partition refuses what has no meaning")
{
  CHECK_THROWS_AS(partition(grid(3), {}, 0), InvalidParameter);
  CHECK_THROWS_AS(partition(grid(3), std::vector<int>(8, 1), 2), DimensionMismatch);
  CHECK_THROWS_AS(partition(grid(3), std::vector<int>(9, -1), 2), InvalidParameter);
  CHECK_THROWS_AS(partition(SparseGraph{{0, 1}, {1}}, {}, 2), DimensionMismatch);
}
