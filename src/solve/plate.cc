#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::Plate>;
template class MonolithicSolver<models::Plate, GeneralizedAlpha>;
template class MonolithicSolver<models::Plate, Newmark>;

} // namespace sherd
