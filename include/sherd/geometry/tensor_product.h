#pragma once

#include <optional>

#include <sherd/geometry/patch.h>

namespace sherd
{

/// The same patch on a basis without history, LRBasis(knots_u, knots_v), with points in its order: j n_u + i for index
/// i along u. Nothing if local refinement has made the functions something else than all products of two open knot
/// vectors. Exact: knots, points and weights stay the same numbers.
template <int degree, int spacedim>
std::optional<Patch<degree, spacedim>> tensor_product(const Patch<degree, spacedim> &patch);

} // namespace sherd
