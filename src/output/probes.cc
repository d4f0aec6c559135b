#include <sherd/output/probes.h>

#include <sherd/base/instantiate.h>
#include <sherd/output/probes.templates.h>

namespace sherd
{

template class Probes<2>;
template class Probes<3>;

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template Probes<spacedim>::Probes(const std::filesystem::path &, const Surface<degree, spacedim> &,                  \
                                    const std::vector<PointProbe<spacedim>> &, const std::vector<std::string> &);      \
  template Probes<spacedim> Probes<spacedim>::resume(const std::filesystem::path &, const Surface<degree, spacedim> &, \
                                                     const std::vector<PointProbe<spacedim>> &,                        \
                                                     const std::vector<std::string> &, double);                        \
  template void             Probes<spacedim>::append(const Surface<degree, spacedim> &, const Snapshot<spacedim> &,    \
                                                     const std::vector<Point<spacedim>> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
