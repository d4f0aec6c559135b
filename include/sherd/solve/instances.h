#pragma once

#include <sherd/assembly/half_kernels.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/solve/explicit_solver.h>
#include <sherd/solve/monolithic_solver.h>
#include <sherd/solve/staggered_solver.h>
#include <sherd/solve/static_solver.h>
#include <sherd/time/any_integrator.h>
#include <sherd/time/generalized_alpha.h>
#include <sherd/time/newmark.h>

/// Models that the library ships compiled. A program that includes this header and uses one of them compiles in
/// seconds; any other model compiles from the headers.
namespace sherd
{

namespace models
{
/// Plate in the plane: neo-Hooke, surface-stretch split, cubic degradation, fourth-order density, degree 2 (the
/// paper's).
using Plate =
    BrittleShell<2, 2, split::SurfaceStretch<material::NeoHooke>, degradation::Cubic, crack_density::FourthOrder>;

/// The same without a split: compression cracks as tension does.
using UnsplitPlate =
    BrittleShell<2, 2, split::None<material::NeoHooke>, degradation::Cubic, crack_density::FourthOrder>;

/// Shell in space with the paper's laws: neo-Hooke and Canham, surface-stretch split, cubic degradation, fourth-order
/// density, degree 2.
using Shell = BrittleShell<2, 3, split::SurfaceStretch<material::NeoHooke, material::Canham>, degradation::Cubic,
                           crack_density::FourthOrder>;

/// Koiter's shell of published benchmarks: St. Venant-Kirchhoff in plane stress with its bending, without a split.
template <int degree>
using KoiterShell = BrittleShell<degree, 3, split::None<material::StVenantKirchhoff, material::Koiter>,
                                 degradation::Cubic, crack_density::FourthOrder>;
} // namespace models

extern template class Assembler<models::Plate>;
SHERD_HALF_KERNELS(extern, models::Plate)
extern template class StepEquations<models::Plate>;
extern template class NewtonIteration<models::Plate>;
extern template class NewtonIteration<models::Plate, Unknowns::displacement>;
extern template class NewtonIteration<models::Plate, Unknowns::phase>;
extern template class MonolithicSolver<models::Plate, GeneralizedAlpha>;
extern template class MonolithicSolver<models::Plate, AnyIntegrator>;
extern template class StaggeredSolver<models::Plate, AnyIntegrator>;
extern template class ExplicitSolver<models::Plate>;
extern template class MonolithicSolver<models::Plate, Newmark>;

extern template class Assembler<models::UnsplitPlate>;
extern template class StepEquations<models::UnsplitPlate>;
extern template class NewtonIteration<models::UnsplitPlate>;
extern template class MonolithicSolver<models::UnsplitPlate, GeneralizedAlpha>;
extern template class MonolithicSolver<models::UnsplitPlate, Newmark>;

extern template class Assembler<models::Shell>;
SHERD_HALF_KERNELS(extern, models::Shell)
extern template class StepEquations<models::Shell>;
extern template class NewtonIteration<models::Shell>;
extern template class NewtonIteration<models::Shell, Unknowns::displacement>;
extern template class NewtonIteration<models::Shell, Unknowns::phase>;
extern template class MonolithicSolver<models::Shell, GeneralizedAlpha>;
extern template class MonolithicSolver<models::Shell, AnyIntegrator>;
extern template class StaggeredSolver<models::Shell, AnyIntegrator>;
extern template class ExplicitSolver<models::Shell>;
extern template class StaticSolver<models::Shell>;

extern template class Assembler<models::KoiterShell<2>>;
extern template class Assembler<models::KoiterShell<3>>;
extern template class Assembler<models::KoiterShell<4>>;
extern template class StaticSolver<models::KoiterShell<2>>;
extern template class StaticSolver<models::KoiterShell<3>>;
extern template class StaticSolver<models::KoiterShell<4>>;

} // namespace sherd
