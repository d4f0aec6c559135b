#pragma once

#include <vector>

#include <sherd/algebra/matrix.h>

namespace sherd
{

/// An owned scalar row that holds its diagonal alone.
struct KnownRow
{
  int    row;
  double sign; ///< of the diagonal; its scaled value is 1 or -1
};

/// D of the equilibrated matrix D A D.
struct Equilibration
{
  std::vector<double>   scaling; ///< diagonal of D, shape=(n_local * block_size)
  std::vector<KnownRow> known;
};

/// Replaces A by D A D with D = diag(|a_ii|^-1/2); where a_ii is zero to rounding, the scaled row has the largest entry
/// 1. Collective. Throws NoConvergence on all ranks if a value is not finite or a row is zero.
Equilibration equilibrate(Matrix &matrix);

/// Throws NoConvergence on all ranks if an owned value is not finite. Collective.
void check_finite(const Vector &rhs);

} // namespace sherd
