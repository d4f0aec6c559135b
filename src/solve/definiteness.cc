#include <sherd/solve/definiteness.h>

#include <algorithm>
#include <cstdint>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <sherd/base/all_gather.h>

namespace sherd
{

bool positive_definite(const Matrix &matrix, int field, const std::vector<int> &points)
{
  const auto &distribution = matrix.distribution();
  const auto  comm         = distribution.comm();

  std::vector<std::int64_t> ids;
  for (const int point : points)
    ids.push_back(distribution.global(point));
  ids = all_gather(comm, ids);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const auto number = [&](int local) {
    const auto id    = distribution.global(local);
    const auto found = std::lower_bound(ids.begin(), ids.end(), id);
    return found != ids.end() && *found == id ? static_cast<int>(found - ids.begin()) : -1;
  };

  std::vector<int>    rows, columns;
  std::vector<double> values;
  for (int a = 0; a < distribution.n_owned(); ++a)
    if (const int i = number(a); i >= 0)
      {
        const auto row = matrix.graph().row(a);
        for (std::size_t k = 0; k < row.size(); ++k)
          if (const int j = number(row[k]); j >= 0)
            {
              rows.push_back(i);
              columns.push_back(j);
              values.push_back(matrix.values()[matrix.row_start(a) + field * matrix.row_length(a) +
                                               k * matrix.block_size() + field]);
            }
      }
  rows    = all_gather(comm, rows);
  columns = all_gather(comm, columns);
  values  = all_gather(comm, values);

  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t k = 0; k < rows.size(); ++k)
    triplets.emplace_back(rows[k], columns[k], values[k]);
  Eigen::SparseMatrix<double> submatrix(ids.size(), ids.size());
  submatrix.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(submatrix);
  const Eigen::VectorXd                                    pivots = factors.vectorD();
  return factors.info() == Eigen::Success &&
         std::all_of(pivots.begin(), pivots.end(), [](double pivot) { return pivot > 0.; });
}

} // namespace sherd
