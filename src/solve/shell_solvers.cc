#include <sherd/solve/instances.h>

namespace sherd
{

template class StepEquations<models::Shell>;
template class NewtonIteration<models::Shell>;
template class NewtonIteration<models::Shell, Unknowns::displacement>;
template class NewtonIteration<models::Shell, Unknowns::phase>;
template class MonolithicSolver<models::Shell, GeneralizedAlpha>;
template class MonolithicSolver<models::Shell, AnyIntegrator>;
template class StaggeredSolver<models::Shell, AnyIntegrator>;
template class ExplicitSolver<models::Shell>;
template class StaticSolver<models::Shell>;

} // namespace sherd
