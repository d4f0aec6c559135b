#pragma once

#include <vector>

#include <sherd/algebra/matrix.h>

namespace sherd
{

/// Whether the principal submatrix of one field over some control points is positive definite. If it is not, the whole
/// block of that field is not either.
///
/// @param matrix  not equilibrated
/// @param field   component of the blocks
/// @param points  local control points of this rank, ghosts included; the union over all ranks is tested
///
/// Collective; the same answer on all ranks. Source: theory C.2 1.
bool positive_definite(const Matrix &matrix, int field, const std::vector<int> &points);

} // namespace sherd
