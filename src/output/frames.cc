#include <sherd/output/frames.h>

#include <sherd/base/instantiate.h>
#include <sherd/output/frames.templates.h>

namespace sherd
{

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template BezierGrid bezier_grid(const Surface<degree, spacedim> &, const Snapshot<spacedim> &,                       \
                                  const std::vector<ElementField> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
