#include <sherd/space/partition.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>

#include <metis.h>

#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

void check(const SparseGraph &graph, std::span<const int> weights, int n_parts)
{
  const int n = graph.n_rows();
  if (n_parts < 1)
    throw InvalidParameter("partition: number of parts = " + std::to_string(n_parts) + ", expected at least 1");
  if (!weights.empty() && static_cast<int>(weights.size()) != n)
    throw DimensionMismatch("partition: " + std::to_string(weights.size()) + " weights for " + std::to_string(n) +
                            " vertices");
  for (const int weight : weights)
    if (weight < 0)
      throw InvalidParameter("partition: vertex weight = " + std::to_string(weight) + ", expected at least 0");
  for (const int column : graph.columns)
    if (column < 0 || column >= n)
      throw DimensionMismatch("partition: column " + std::to_string(column) + " in a graph of " + std::to_string(n) +
                              " vertices");
}

const char *explain(int status)
{
  switch (status)
    {
    case METIS_ERROR_INPUT:
      return "erroneous input";
    case METIS_ERROR_MEMORY:
      return "out of memory";
    default:
      return "error of METIS";
    }
}

} // namespace

std::vector<int> partition(const SparseGraph &graph, std::span<const int> weights, int n_parts)
{
  check(graph, weights, n_parts);
  const int        n = graph.n_rows();
  std::vector<int> parts(n, 0);
  if (n_parts == 1)
    return parts;
  if (n_parts >= n)
    {
      std::iota(parts.begin(), parts.end(), 0);
      return parts;
    }

  std::vector<idx_t> offsets = {0}, columns, work(weights.begin(), weights.end()), metis_parts(n);
  for (int i = 0; i < n; ++i)
    {
      std::copy_if(graph.row(i).begin(), graph.row(i).end(), std::back_inserter(columns),
                   [i](int j) { return j != i; });
      offsets.push_back(static_cast<idx_t>(columns.size()));
    }
  if (std::all_of(work.begin(), work.end(), [](idx_t weight) { return weight == 0; }))
    work.assign(n, 1);

  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  idx_t n_vertices = n, n_constraints = 1, n_metis_parts = n_parts, cut = 0;
  // Recursive bisection gives the smaller cuts for few parts and its cost grows with their number (METIS manual).
  const auto method = n_parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int  status = method(&n_vertices, &n_constraints, offsets.data(), columns.data(), work.data(), nullptr, nullptr,
                             &n_metis_parts, nullptr, nullptr, options, &cut, metis_parts.data());
  if (status != METIS_OK)
    throw Error("partition of " + std::to_string(n) + " vertices in " + std::to_string(n_parts) +
                " parts failed: " + explain(status));
  std::copy(metis_parts.begin(), metis_parts.end(), parts.begin());
  return parts;
}

} // namespace sherd
