#pragma once

#include <sherd/adapt/adaptivity.h>
#include <sherd/assembly/energy_balance.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/solve/instances.h>
#include <sherd/time/generalized_alpha.h>

namespace sherd::test
{

using Split = split::SurfaceStretch<material::NeoHooke>;
using Glass = BrittleShell<2, 2, Split, degradation::Cubic, crack_density::FourthOrder>;

/// A plate of 10 x 24 with a crack from its left edge to x = 3 at mid-height, in units of its length scale, toughness
/// and mass, pulled at top and bottom with constant speed. Coarse at first: elements of 2 l0. It is so high that the
/// crack runs before the plate is damaged everywhere.
struct CrackingPlate
{
  static Glass glass()
  {
    return {Split(material::NeoHooke(material::surface_moduli(1e4, .2))), degradation::Cubic(), {}, 1., 1., 1.};
  }
  /// The speed is reached after 0.04: a jump would be a shock of unlimited acceleration.
  static Supports pull(double speed)
  {
    const auto travel = [=](double t) { return speed * (t < .04 ? t * t / .08 : t - .02); };
    Supports   supports;
    supports.prescribe("top", Component::y, travel);
    supports.prescribe("bottom", Component::y, [=](double t) { return -travel(t); });
    return supports;
  }
  static PreCrack<2> notch() { return PreCrack<2>({Segment<2>{{0., 12.}, {3., 12.}}}, 1.); }

  Environment                               env;
  Glass                                     model = glass();
  Surface<2, 2>                             plate;
  ShellSpace<2, 2>                          space;
  Supports                                  supports;
  Loads<2>                                  loads;
  State<2, 2>                               state;
  MonolithicSolver<Glass, GeneralizedAlpha> solver;
  Adaptivity<Glass>                         adaptivity;
  StepController                            controller{StepControlSettings{.initial = 2e-3}};

  CrackingPlate(MPI_Comm comm, const RefinementSettings &refinement, double speed = .2,
                const NewtonSettings &settings = {}, std::array<int, 2> elements = {5, 12},
                Partitioner partitioner = partition)
      : CrackingPlate(comm, shapes::plate<2, 2>({10., 24.}, elements), continuity::Penalty(), refinement, speed,
                      settings, std::move(partitioner))
  {
  }

  /// The plate in another form, of several patches.
  CrackingPlate(MPI_Comm comm, Surface<2, 2> surface, const Continuity &continuity,
                const RefinementSettings &refinement, double speed = .2, const NewtonSettings &settings = {},
                Partitioner partitioner = partition)
      : env(comm),
        plate(std::move(surface)),
        space(env, plate, continuity, std::move(partitioner)),
        supports(pull(speed)),
        state(space),
        solver(model, space, supports, loads, GeneralizedAlpha(.5), settings),
        adaptivity(plate, refinement)
  {
  }
  CrackingPlate(const CrackingPlate &) = delete;

  void prepare(const PreCrack<2> &cracks = notch())
  {
    adaptivity.prepare(solver, plate, space, state, cracks);
    controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());
  }

  StepSummary advance(double end) { return adaptivity.advance(solver, plate, space, state, controller, end); }

  Energies energies() { return solver.energies(state); }

  /// Largest edge of the elements whose centre the predicate selects.
  template <class Where>
  double largest_edge(const Where &where) const
  {
    double largest = 0.;
    for (int e = 0; e < plate.n_elements(); ++e)
      {
        const auto geometry = element_geometry(plate, e);
        if (where(Point<2>(geometry.position(ShapeValues<2>::n_points / 2))))
          for (int d = 0; d < 2; ++d)
            largest = std::max(largest, std::sqrt(geometry.reference[0].covariant[d]));
      }
    return largest;
  }
};

} // namespace sherd::test
