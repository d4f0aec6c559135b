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
SHERD_INSTANTIATE(2, 2)
SHERD_INSTANTIATE(3, 2)
SHERD_INSTANTIATE(4, 2)
SHERD_INSTANTIATE(2, 3)
SHERD_INSTANTIATE(3, 3)
SHERD_INSTANTIATE(4, 3)
#undef SHERD_INSTANTIATE

} // namespace sherd
