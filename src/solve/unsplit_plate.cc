#include <sherd/solve/instances.h>

namespace sherd
{

template class Assembler<models::UnsplitPlate>;
template class StepEquations<models::UnsplitPlate>;
template class NewtonIteration<models::UnsplitPlate>;
template class MonolithicSolver<models::UnsplitPlate, GeneralizedAlpha>;
template class MonolithicSolver<models::UnsplitPlate, Newmark>;

} // namespace sherd
