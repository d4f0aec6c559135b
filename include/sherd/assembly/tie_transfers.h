#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <sherd/space/ties.h>

namespace sherd
{

/// R^T of a list of control points for each field, c = R c_free: the row of a tied point is empty and has gone to its
/// masters. So vectors f and matrices K of the list become R^T f and R^T K R. Shape=(n, n).
template <int n_fields>
using TieTransfers = std::array<Eigen::MatrixXd, n_fields>;

/// Ties by the point that is tied.
class TiesByPoint
{
public:
  TiesByPoint(const std::vector<Tie> &ties, int n_points) : ties_(&ties), of_(ties.empty() ? 0 : n_points)
  {
    for (std::size_t t = 0; t < ties.size(); ++t)
      of_[ties[t].point].push_back(static_cast<int>(t));
  }

  /// Transfers of @p points, in any order, which hold the masters of all that are tied among them; none if none is.
  template <int n_fields>
  std::optional<TieTransfers<n_fields>> transfers(std::span<const int> points) const
  {
    const auto is_tied = [&](int point) { return !of_.empty() && !of_[point].empty(); };
    if (std::none_of(points.begin(), points.end(), is_tied))
      return {};
    const auto             n = static_cast<Eigen::Index>(points.size());
    TieTransfers<n_fields> result;
    result.fill(Eigen::MatrixXd::Identity(n, n));
    for (Eigen::Index i = 0; i < n; ++i)
      for (const int t : of_[points[i]])
        {
          const auto &tie = (*ties_)[t];
          auto       &R   = result[tie.field];
          R(i, i)         = 0.;
          for (std::size_t m = 0; m < tie.masters.size(); ++m)
            {
              const auto found = std::find(points.begin(), points.end(), tie.masters[m]);
              assert(found != points.end());
              R(found - points.begin(), i) = tie.factors[m];
            }
        }
    return result;
  }

private:
  const std::vector<Tie>       *ties_;
  std::vector<std::vector<int>> of_;
};

} // namespace sherd
