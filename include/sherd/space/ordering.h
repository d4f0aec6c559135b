#pragma once

#include <span>
#include <vector>

#include <sherd/base/sparse_graph.h>

namespace sherd
{

/// Reverse Cuthill-McKee order of the vertices: order[new] = old. Every component starts at a pseudo-peripheral vertex
/// (George and Liu) and stays contiguous. Incomplete factors in this order have less fill and converge faster than in
/// a random one.
///
/// @param graph  symmetric; entries of a vertex with itself are allowed and have no effect
///
/// Throws DimensionMismatch if a column is out of range. The order depends on the graph alone.
std::vector<int> reverse_cuthill_mckee(const SparseGraph &graph);

/// Largest |new(i) - new(j)| over the edges (i, j) when the vertices are numbered by @p order, order[new] = old.
int bandwidth(const SparseGraph &graph, std::span<const int> order);

} // namespace sherd
