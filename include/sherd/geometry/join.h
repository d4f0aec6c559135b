#pragma once

#include <vector>

#include <sherd/geometry/surface.h>

namespace sherd
{

/// One surface of the patches of several, in their order, joined along all sides that coincide (find_interfaces).
///
/// Names of edges go on, equal ones become one edge; a side that the joining turns from an edge into an interface loses
/// its names. Slits inside a part that coincide close too: give the interfaces to Surface itself where they shall not.
/// @throws InvalidParameter   no part
template <int degree, int spacedim>
Surface<degree, spacedim> join(const std::vector<Surface<degree, spacedim>> &parts);

/// Whether the two patches of an interface have their normals A_1 x A_2 on the same side of the surface.
bool normals_agree(const Interface &joined);

extern template Surface<2, 2> join(const std::vector<Surface<2, 2>> &);
extern template Surface<3, 2> join(const std::vector<Surface<3, 2>> &);
extern template Surface<4, 2> join(const std::vector<Surface<4, 2>> &);
extern template Surface<2, 3> join(const std::vector<Surface<2, 3>> &);
extern template Surface<3, 3> join(const std::vector<Surface<3, 3>> &);
extern template Surface<4, 3> join(const std::vector<Surface<4, 3>> &);

} // namespace sherd
