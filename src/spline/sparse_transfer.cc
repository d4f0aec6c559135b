#include <sherd/spline/sparse_transfer.h>

#include <algorithm>
#include <utility>

namespace sherd
{

SparseTransfer compose(const SparseTransfer &second, const SparseTransfer &first)
{
  SparseTransfer                      result{{0}, {}, {}};
  std::vector<std::pair<int, double>> row;
  for (int i = 0; i < second.n_rows(); ++i)
    {
      row.clear();
      for (int k = second.offsets[i]; k < second.offsets[i + 1]; ++k)
        for (int l = first.offsets[second.columns[k]]; l < first.offsets[second.columns[k] + 1]; ++l)
          row.emplace_back(first.columns[l], second.values[k] * first.values[l]);
      std::sort(row.begin(), row.end());
      const auto row_start = result.columns.size();
      for (const auto &[column, value] : row)
        if (result.columns.size() > row_start && result.columns.back() == column)
          result.values.back() += value;
        else
          {
            result.columns.push_back(column);
            result.values.push_back(value);
          }
      result.offsets.push_back(static_cast<int>(result.columns.size()));
    }
  return result;
}

} // namespace sherd
