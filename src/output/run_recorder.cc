#include <sherd/output/run_recorder.h>

#include <sherd/base/instantiate.h>
#include <sherd/output/run_recorder.templates.h>

namespace sherd
{

#define SHERD_INSTANTIATE(degree, spacedim) template class RunRecorder<degree, spacedim>;
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
