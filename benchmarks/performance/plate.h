#pragma once

#include <cmath>

#include "measure.h"

#include <sherd/fracture/pre_crack.h>
#include <sherd/geometry/shapes.h>
#include <sherd/solve/instances.h>

namespace sherd::performance
{

/// The notched plate of step-7, strained and with a crack, on n x n/2 elements without refinement; the system of the
/// largest time step.
struct Plate
{
  using Model = models::Plate;

  explicit Plate(int n)
      : l0(.2 / n),
        surface(shapes::plate<2, 2>({.1, .05}, {n, n / 2})),
        space(world(), surface),
        model(split::SurfaceStretch<material::NeoHooke>(material::NeoHooke(material::plane_strain_moduli(32e9, .2))),
              degradation::Cubic(), {}, 3., l0, 2450.),
        state(space),
        assembler(model, space, state.distribution),
        matrix(assembler.make_matrix()),
        force(state.distribution, 3),
        mass_weight(GeneralizedAlpha(.5).stages(2. * l0 / (.6 * 2125.), 2. * l0 / (.6 * 2125.)).front().mass_weight())
  {
    const PreCrack<2> notch({Segment<2>{{0., .025}, {.05, .025}}}, l0);
    const auto        X = surface.control_points();
    for (int a = 0; a < state.distribution->n_local(); ++a)
      {
        const Point<2> position = X.row(state.distribution->global(a)).transpose();
        state.phase.local()[a]  = notch.phase(position, model.crack_density);
        state.position.local()[2 * a + 1] += 5e-5 * position[1];
      }
    for (int e = 0; e < space.n_active_elements(); ++e)
      for (int q = 0; q < state.n_q; ++q)
        state.history[e][q] = notch.history(assembler.quadrature_position(e, q), model.degradation, 3.);
  }

  void linearise()
  {
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, mass_weight,
                        PhaseTangent::consistent, force, matrix);
  }

  double           l0;
  Surface<2, 2>    surface;
  ShellSpace<2, 2> space;
  Model            model;
  State<2, 2>      state;
  Assembler<Model> assembler;
  Matrix           matrix;
  Vector           force;
  double           mass_weight;
};

} // namespace sherd::performance
