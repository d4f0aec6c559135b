#pragma once

#include <string>
#include <variant>
#include <vector>

#include <sherd/geometry/surface.h>

namespace sherd
{

/// The one control point on two named edges that meet; the surface passes through it.
struct Corner
{
  std::string first, second; ///< names of edges, in any order
};

/// All control points of one patch.
struct PatchRegion
{
  int patch;
};

/// All control points.
struct WholeSurface
{
};

/// Part of a surface that a support holds: a named edge (a plain string), a corner, a patch or everything. It names
/// parts, not unknowns, and so follows refinement.
struct Region
{
  Region(const char *edge) : part(std::string(edge)) {}
  Region(std::string edge) : part(std::move(edge)) {}
  Region(Corner corner) : part(std::move(corner)) {}
  Region(PatchRegion patch) : part(patch) {}
  Region(WholeSurface all) : part(all) {}

  std::variant<std::string, Corner, PatchRegion, WholeSurface> part;
};

/// "edge \"top\"", "corner of \"left\" and \"top\"", "patch 2", "the whole surface".
std::string describe(const Region &region);

/// Control points of @p region, surface numbering, each once: those that act on an edge, the one of a corner, all of a
/// patch.
/// @throws InvalidParameter   unknown edge; edges that do not meet in one corner; a patch that does not exist
template <int degree, int spacedim>
std::vector<int> points_of(const Region &region, const Surface<degree, spacedim> &surface);

} // namespace sherd

#include <sherd/space/region.templates.h>
