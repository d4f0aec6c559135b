#include <sherd/solve/instances.h>

namespace sherd
{

SHERD_HALF_KERNELS(, models::Plate)

} // namespace sherd
