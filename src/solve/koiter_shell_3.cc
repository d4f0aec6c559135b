#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::KoiterShell<3>>;
template class StaticSolver<models::KoiterShell<3>>;

} // namespace sherd
