#pragma once

#include <span>
#include <vector>

#include <sherd/base/sparse_graph.h>

namespace sherd
{

/// Parts of similar weight with few edges between them: the part of each vertex, in [0, n_parts), by METIS with a
/// fixed seed, so that the same input gives the same parts on every rank and in every run.
///
/// @param graph    symmetric; entries of a vertex with itself are allowed and have no effect
/// @param weights  work of each vertex, not negative, shape=(graph.n_rows()); equal weights if empty
/// @param n_parts  at least 1; with more parts than vertices every vertex is a part of its own and the rest is empty
///
/// Throws InvalidParameter (parts, weights), DimensionMismatch (number of weights, column out of range) and Error
/// (METIS itself fails).
std::vector<int> partition(const SparseGraph &graph, std::span<const int> weights, int n_parts);

} // namespace sherd
