#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::Shell>;
template class MonolithicSolver<models::Shell, GeneralizedAlpha>;
template class StaticSolver<models::Shell>;

} // namespace sherd
