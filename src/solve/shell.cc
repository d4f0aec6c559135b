#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::Shell>;

} // namespace sherd
