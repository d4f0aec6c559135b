#include <sherd/solve/instances.h>

namespace sherd
{

template class StepEquations<models::Plate>;
template class NewtonIteration<models::Plate>;
template class NewtonIteration<models::Plate, Unknowns::displacement>;
template class NewtonIteration<models::Plate, Unknowns::phase>;
template class MonolithicSolver<models::Plate, GeneralizedAlpha>;
template class MonolithicSolver<models::Plate, Newmark>;
template class MonolithicSolver<models::Plate, AnyIntegrator>;
template class StaggeredSolver<models::Plate, AnyIntegrator>;
template class ExplicitSolver<models::Plate>;

} // namespace sherd
