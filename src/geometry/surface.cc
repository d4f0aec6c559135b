#include <sherd/base/instantiate.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/surface.h>

namespace sherd
{

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template class Surface<degree, spacedim>;                                                                            \
  template std::vector<int>                  elements_along(const Surface<degree, spacedim> &, const Edge &);          \
  template std::vector<int>                  points_along(const Surface<degree, spacedim> &, const Edge &);            \
  template std::vector<Interface>            find_interfaces(const std::vector<Patch<degree, spacedim>> &);            \
  template ElementGeometry<degree, spacedim> element_geometry(const Surface<degree, spacedim> &, int);                 \
  template SurfacePlace                      closest_place(const Surface<degree, spacedim> &, const Point<spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
