#pragma once

#include <array>
#include <vector>

#include <sherd/geometry/surface.h>

/// Patches cut into patches. The surface and its names stay what they were: knots of the cuts are raised to the
/// multiplicity degree by knot insertion (exact), a name goes to all parts of its sides, and the parts are joined along
/// the cuts. What changes is the space of functions: it may kink along an interface, so that a shell and its phase
/// field need continuity there (theory G).
///
/// A cut ends on two sides of its patch. Where one of them is joined to another patch, that is cut at the same point,
/// and so on, until the cut meets the boundary of the surface or itself: interfaces stay conforming.
///
/// Parts take the place of their patch, those along u first, and keep their part of its parameter domain.
/// All of these need patches without local refinement (tensor_product()): cut first, refine afterwards.
namespace sherd
{

/// Cuts patch @p patch along the line u = parameter (Direction::u) or v = parameter (Direction::v).
/// @throws InvalidParameter   a patch that does not exist or was refined locally, a parameter outside the open domain
template <int degree, int spacedim>
Surface<degree, spacedim> split_patches(const Surface<degree, spacedim> &surface, int patch, Direction direction,
                                        double parameter);

/// Cuts every patch into pieces[0] x pieces[1] parts of equal parameter lengths; elements are cut where the number of
/// parts does not divide theirs. More parts arise where a u line of one patch continues as a v line of the next and
/// pieces[0] differs from pieces[1].
/// @throws InvalidParameter   less than one part, a patch that was refined locally
template <int degree, int spacedim>
Surface<degree, spacedim> split_patches(const Surface<degree, spacedim> &surface, const std::array<int, 2> &pieces);

/// Cuts all patches along their C0 lines (knots of multiplicity degree or more, as in a full circle from one patch), so
/// that each line is an interface.
/// @throws InvalidParameter   a patch that was refined locally
template <int degree, int spacedim>
Surface<degree, spacedim> split_at_c0_lines(const Surface<degree, spacedim> &surface);

/// The parts that patch lines u = at_u[i] and v = at_v[j] leave of a patch, those along u first. Shared control points
/// are the same numbers in both parts.
/// @param at_u, at_v   ascending, inside the open domain
/// @throws InvalidParameter   otherwise, or if the patch was refined locally
template <int degree, int spacedim>
std::vector<Patch<degree, spacedim>> split_patches(const Patch<degree, spacedim> &patch,
                                                   const std::vector<double> &at_u, const std::vector<double> &at_v);

} // namespace sherd
