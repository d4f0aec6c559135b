#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::KoiterShell<4>>;
template class StaticSolver<models::KoiterShell<4>>;

} // namespace sherd
