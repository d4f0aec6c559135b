#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include <sherd/space/shell_space.h>
#include <sherd/space/ties.h>
#include <sherd/spline/extraction.h>

namespace sherd
{

/// Ties of control values (theory G.5) as the element loop sees them: on an element with a tied control point each
/// field has an extraction of its own, in which the row of a tied point is empty and has gone to its masters.
///
/// So element vectors and matrices reach R^T f and R^T K R, where c = R c_free, without a pass over the global ones.
template <int degree, int spacedim>
class TiedElements
{
public:
  static constexpr int n_fields = fields_per_point<spacedim>;

  /// @param ties   of the surface of @p space
  TiedElements(const ShellSpace<degree, spacedim> &space, const std::vector<Tie> &ties)
      : index_(space.n_active_elements(), -1)
  {
    if (ties.empty())
      return;
    const auto                   &d = space.distribution();
    std::vector<std::vector<int>> ties_of(space.surface().n_control_points());
    for (std::size_t t = 0; t < ties.size(); ++t)
      ties_of[ties[t].point].push_back(static_cast<int>(t));
    for (int e = 0; e < space.n_active_elements(); ++e)
      {
        const auto [p, local]      = space.surface().locate_element(d.elements[e]);
        const auto      &basis     = space.surface().patch(p).basis;
        const auto       functions = basis.functions_of(local);
        const int        n         = static_cast<int>(functions.size());
        std::vector<int> points(n);
        bool             tied = false;
        for (int i = 0; i < n; ++i)
          {
            points[i] = space.surface().point(p, functions[i]);
            tied      = tied || !ties_of[points[i]].empty();
          }
        if (!tied)
          continue;
        Transfers transfer;
        transfer.fill(Eigen::MatrixXd::Identity(n, n));
        for (int i = 0; i < n; ++i)
          for (const int t : ties_of[points[i]])
            {
              auto &R = transfer[ties[t].field];
              R(i, i) = 0.;
              for (std::size_t m = 0; m < ties[t].masters.size(); ++m)
                {
                  const auto found = std::find(points.begin(), points.end(), ties[t].masters[m]);
                  assert(found != points.end());
                  R(found - points.begin(), i) = ties[t].factors[m];
                }
            }
        index_[e] = static_cast<int>(transfers_.size());
        transfers_.push_back(std::move(transfer));
      }
  }

  /// Number of an active element among those with ties, or -1.
  int index(int active) const { return index_[active]; }

  /// Number of elements with ties.
  int n_elements() const { return static_cast<int>(transfers_.size()); }

  /// R^T of an element with ties for one field, shape=(n, n) with n control points.
  const Eigen::MatrixXd &transfer(int index, int field) const { return transfers_[index][field]; }

private:
  using Transfers = std::array<Eigen::MatrixXd, n_fields>;

  std::vector<int>       index_; ///< into transfers_, or -1, shape=(n_active)
  std::vector<Transfers> transfers_;
};

} // namespace sherd
