#pragma once

#include <span>
#include <vector>

#include <sherd/algebra/distribution.h>
#include <sherd/algebra/matrix.h>
#include <sherd/base/sparse_graph.h>

namespace sherd
{

/// Brings the owners' values to their copies: @p values has block_size values for each local control point.
/// Collective.
void update_ghost_values(const Distribution &distribution, std::span<double> values, int block_size);

/// The rows of the ghosts, fetched from their owners: the matrix of a rank grown by one layer of its neighbours'.
class GhostRows
{
public:
  /// Fetches the graph. Collective.
  GhostRows(const Distribution &distribution, const SparseGraph &graph);

  /// Rows of all local control points, their columns cut to the local control points. The rows of the owned ones are
  /// those of the matrix.
  const SparseGraph &extended_graph() const { return extended_; }

  /// Values of the rows of the ghosts in the layout of Matrix::values(), counted from the first ghost. Collective.
  std::vector<double> fetch(const Matrix &matrix) const;

private:
  SparseGraph      extended_;
  std::vector<int> received_lengths_; ///< blocks of each row as it arrives, in the order of the exchange plan
  std::vector<int> sources_;          ///< of each kept block of a ghost's row its position in the row that arrives
};

} // namespace sherd
