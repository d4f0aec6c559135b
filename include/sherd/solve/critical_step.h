#pragma once

#include <span>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>

namespace sherd
{

/// Mass of each owned unknown, concentrated in its control point: row sums of the magnitudes of a consistent mass
/// matrix. Without ties these are its row sums, int rho N_A dA; with them they are never less. Ghosts are up to date.
/// Collective.
Vector lumped_mass(const Matrix &mass);

/// Upper bound of the largest eigenvalue of K v = omega^2 M v with the diagonal M > 0:
///
///   omega^2 <= max_i (1 / (m_i d_i)) sum_j |K_ij| d_j  for any d > 0
///
/// (Gershgorin's circles of D^-1 M^-1 K D), with a few iterations that let d level the rows. Only unknowns that are
/// @p free count. Collective.
///
/// @param mass   one value for each unknown
/// @param free   1 where an unknown moves, shape=(n_owned * block_size)
///
/// Source: theory F.5.
double eigenvalue_bound(const Matrix &stiffness, const Vector &mass, std::span<const char> free);

} // namespace sherd
