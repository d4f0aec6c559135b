#pragma once

#include <vector>

#include <sherd/assembly/tie_transfers.h>
#include <sherd/space/shell_space.h>

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
    const TiesByPoint by_point(ties, space.surface().n_control_points());
    std::vector<int>  points;
    for (int e = 0; e < space.n_active_elements(); ++e)
      {
        const auto [p, local] = space.surface().locate_element(space.distribution().elements[e]);
        points.clear();
        for (const int function : space.surface().patch(p).basis.functions_of(local))
          points.push_back(space.surface().point(p, function));
        if (auto transfers = by_point.template transfers<n_fields>(points))
          {
            index_[e] = static_cast<int>(transfers_.size());
            transfers_.push_back(std::move(*transfers));
          }
      }
  }

  /// Number of an active element among those with ties, or -1.
  int index(int active) const { return index_[active]; }

  /// Number of elements with ties.
  int n_elements() const { return static_cast<int>(transfers_.size()); }

  /// R^T of an element with ties for one field, shape=(n, n) with n control points.
  const Eigen::MatrixXd &transfer(int index, int field) const { return transfers_[index][field]; }

private:
  std::vector<int>                    index_; ///< into transfers_, or -1, shape=(n_active)
  std::vector<TieTransfers<n_fields>> transfers_;
};

} // namespace sherd
