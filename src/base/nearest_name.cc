#include <sherd/base/nearest_name.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace sherd
{

int edit_distance(std::string_view a, std::string_view b)
{
  const auto                    m = a.size(), n = b.size();
  std::vector<std::vector<int>> d(m + 1, std::vector<int>(n + 1));
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      {
        if (i == 0 || j == 0)
          {
            d[i][j] = static_cast<int>(i + j);
            continue;
          }
        d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
  return d[m][n];
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates)
{
  int         best = std::numeric_limits<int>::max();
  std::string nearest;
  for (const auto &candidate : candidates)
    if (const int distance = edit_distance(name, candidate); distance < best)
      {
        best    = distance;
        nearest = candidate;
      }
  return nearest;
}

} // namespace sherd
