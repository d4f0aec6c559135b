#pragma once

#include "measure.h"

#include <sherd/geometry/shapes.h>
#include <sherd/solve/instances.h>

namespace sherd::performance
{

inline models::Shell make_model(std::type_identity<models::Shell>)
{
  const auto laws = material::neo_hooke_canham_shell(1e6, .3, .01);
  return models::Shell({laws.membrane, laws.bending, {.thickness = .01}}, degradation::Cubic(), {}, 1., .02, 1.);
}

template <int degree>
models::KoiterShell<degree> make_model(std::type_identity<models::KoiterShell<degree>>)
{
  const auto laws = material::koiter_shell(1e6, .3, .01);
  return models::KoiterShell<degree>(split::None(laws.membrane, laws.bending), degradation::Cubic(), {}, 1., .02, 1.);
}

/// A part of a cylinder that unbends and stretches, so that its layers are cut, on n x n elements; the system of a time
/// step in which waves of the membrane pass two elements.
template <class Model_>
struct Sheet
{
  using Model                 = Model_;
  static constexpr int degree = Model::degree;

  explicit Sheet(int n, shapes::Fit fit = shapes::Fit::smooth)
      : surface(shapes::cylinder<degree>(1., 1., {-.5, .5}, {n, n}, fit)),
        space(world(), surface),
        model(make_model(std::type_identity<Model>())),
        state(space),
        assembler(model, space, state.distribution),
        matrix(assembler.make_matrix()),
        force(state.distribution, 4),
        mass_weight(GeneralizedAlpha(.5).stages(.02 / n, .02 / n).front().mass_weight())
  {
    auto x = state.position.local();
    for (int a = 0; a < state.distribution->n_local(); ++a)
      x[3 * a + 2] *= .9;
  }

  void linearise()
  {
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, mass_weight,
                        PhaseTangent::consistent, force, matrix);
  }

  Surface<degree, 3>    surface;
  ShellSpace<degree, 3> space;
  Model                 model;
  State<degree, 3>      state;
  Assembler<Model>      assembler;
  Matrix                matrix;
  Vector                force;
  double                mass_weight;
};

} // namespace sherd::performance
