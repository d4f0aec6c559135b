#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/assembly/tie_transfers.h>
#include <sherd/forms/unknowns.h>
#include <sherd/space/shell_space.h>

namespace sherd
{

/// Between the global vectors and the arrays of one cell on an interface or an edge. Arrays have the index
/// point * n_fields + field on the points of the cell: control points first, perhaps a multiplier behind them.
template <int n_fields>
class CellScatter
{
public:
  static constexpr int spacedim = n_fields - 1;

  CellScatter() = default;

  /// @param control_points   surface numbering, neighbours of each other in the graph of @p space
  /// @param multiplier       surface numbering, -1: none
  CellScatter(const SpaceDistribution &space, const std::vector<int> &control_points, int multiplier,
              const TiesByPoint &ties)
      : n_owned_(static_cast<int>(space.owned.size())), ties_(ties.template transfers<n_fields>(control_points))
  {
    for (const int point : control_points)
      points_.push_back(space.local[point]);
    if (multiplier >= 0)
      points_.push_back(space.local[multiplier]);
    const auto n = points_.size();
    positions_.assign(n * n, -1);
    for (std::size_t i = 0; i < n; ++i)
      if (points_[i] < n_owned_)
        {
          const auto row = space.graph.row(points_[i]);
          for (std::size_t j = 0; j < n; ++j)
            positions_[i * n + j] =
                static_cast<int>(std::lower_bound(row.begin(), row.end(), points_[j]) - row.begin());
        }
  }

  /// Local points.
  const std::vector<int> &points() const { return points_; }

  /// Control values of the first @p n points.
  ControlValues<spacedim> position(const Vector &position, Eigen::Index n) const
  {
    ControlValues<spacedim> values(n, spacedim);
    for (Eigen::Index i = 0; i < n; ++i)
      for (int c = 0; c < spacedim; ++c)
        values(i, c) = position.local()[points_[i] * spacedim + c];
    return values;
  }

  Eigen::VectorXd phase(const Vector &phase, Eigen::Index n) const
  {
    Eigen::VectorXd values(n);
    for (Eigen::Index i = 0; i < n; ++i)
      values[i] = phase.local()[points_[i]];
    return values;
  }

  /// R^T f of one field: what acts on tied control values acts on their masters. shape=(n_control_points)
  Eigen::VectorXd to_masters(int field, const Eigen::VectorXd &f) const
  {
    return ties_ ? Eigen::VectorXd((*ties_)[field] * f) : f;
  }

  /// R_c^T K R_d of two fields, shape=(n_control_points, n_control_points).
  Eigen::MatrixXd to_masters(int c, int d, const Eigen::MatrixXd &K) const
  {
    return ties_ ? Eigen::MatrixXd((*ties_)[c] * K * (*ties_)[d].transpose()) : K;
  }

  /// Adds the rows of owned points.
  void add(const Eigen::VectorXd &from, Vector &to) const
  {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i] < n_owned_)
        for (int c = 0; c < n_fields; ++c)
          to.local()[points_[i] * n_fields + c] += from[i * n_fields + c];
  }

  /// Adds the block rows of owned points to a matrix of the unknowns of a part.
  void add(const Eigen::MatrixXd &from, Unknowns part, Matrix &to) const
  {
    const auto n      = points_.size();
    const auto fields = fields_of(part, spacedim);
    for (std::size_t i = 0; i < n; ++i)
      if (const int point = points_[i]; point < n_owned_)
        for (int c = 0; c < fields.count; ++c)
          {
            double *row = to.values().data() + to.row_start(point) + c * to.row_length(point);
            for (std::size_t j = 0; j < n; ++j)
              for (int d = 0; d < fields.count; ++d)
                row[positions_[i * n + j] * fields.count + d] +=
                    from(i * n_fields + fields.first + c, j * n_fields + fields.first + d);
          }
  }

private:
  int                                   n_owned_ = 0;
  std::vector<int>                      points_;
  std::vector<int>                      positions_; ///< of block (A, B) in the row of A, in blocks; row-major
  std::optional<TieTransfers<n_fields>> ties_;
};

} // namespace sherd
