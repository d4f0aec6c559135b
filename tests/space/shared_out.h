#pragma once

#include <sherd/space/shell_space.h>

namespace sherd::test
{

/// METIS among all ranks but one, which owns nothing. Alone a rank is not asked.
inline Partitioner leaving_out(int idle)
{
  return [idle](const SparseGraph &graph, std::span<const int> weights, int n_parts) {
    auto parts = partition(graph, weights, n_parts - 1);
    for (int &part : parts)
      part += part >= idle ? 1 : 0;
    return parts;
  };
}

} // namespace sherd::test
