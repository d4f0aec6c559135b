#pragma once

#include <sherd/adapt/adaptivity.h>
#include <sherd/assembly/energy_balance.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/geometry/shapes.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/time/generalized_alpha.h>

namespace sherd::test
{

using Split = split::SurfaceStretch<material::NeoHooke>;
using Glass = BrittleShell<2, 2, Split, degradation::Cubic, crack_density::FourthOrder>;

/// A plate of 16 x 8 with a crack from its left edge to x = 3 at mid-height, in units of its length scale, toughness
/// and mass, pulled at top and bottom with constant speed. Coarse at first: elements of 2 l0.
struct CrackingPlate
{
  static Glass glass()
  {
    return {Split(material::NeoHooke(material::surface_moduli(1e4, .2))), degradation::Cubic(), {}, 1., 1., 1.};
  }
  static Supports pull(double speed)
  {
    Supports supports;
    supports.prescribe("top", Component::y, [=](double t) { return speed * t; });
    supports.prescribe("bottom", Component::y, [=](double t) { return -speed * t; });
    return supports;
  }
  static PreCrack<2> notch() { return PreCrack<2>({Segment<2>{{0., 4.}, {3., 4.}}}, 1.); }

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
                const NewtonSettings &settings = {}, std::array<int, 2> elements = {8, 4})
      : env(comm),
        plate(shapes::plate<2, 2>({16., 8.}, elements)),
        space(env, plate),
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

  Energies energies() const { return solver.energies(state, state.phase); }

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
