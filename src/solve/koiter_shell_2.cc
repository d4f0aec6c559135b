#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::KoiterShell<2>>;
template class StaticSolver<models::KoiterShell<2>>;

} // namespace sherd
