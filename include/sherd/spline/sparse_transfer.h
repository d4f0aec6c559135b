#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace sherd
{

/// Sparse matrix T that carries control data through a refinement, c_new = T c_old.  theory H.2, H.5
///
/// Rows are the new functions. Entries are positive and each row sums to 1 (up to rounding): new control data are
/// convex combinations of old ones. In the convention field = sum_i c_i gamma_i B_i the field does not change. Rational
/// data are carried in homogeneous form: w_new = T w, (w x)_new = T (w x).
struct SparseTransfer
{
  std::vector<int>    offsets; ///< shape=(n_rows + 1), start of each row
  std::vector<int>    columns; ///< old functions, ascending inside a row
  std::vector<double> values;  ///< entries, as columns

  int n_rows() const { return offsets.empty() ? 0 : static_cast<int>(offsets.size()) - 1; }

  /// Old functions with an entry in row @p i.
  std::span<const int> row_columns(int i) const
  {
    return std::span(columns).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }

  /// Entries of row @p i.
  std::span<const double> row_values(int i) const
  {
    return std::span(values).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }

  /// T c for control data @p old_data, shape=(n_old, any); returns shape=(n_rows, same).
  template <class Derived>
  typename Derived::PlainObject apply(const Eigen::MatrixBase<Derived> &old_data) const
  {
    typename Derived::PlainObject result(n_rows(), old_data.cols());
    for (int i = 0; i < n_rows(); ++i)
      {
        result.row(i).setZero();
        for (int k = offsets[i]; k < offsets[i + 1]; ++k)
          result.row(i) += values[k] * old_data.row(columns[k]);
      }
    return result;
  }
};

/// The product second * first: control data through @p first, then through @p second.
SparseTransfer compose(const SparseTransfer &second, const SparseTransfer &first);

} // namespace sherd
