// label: verification
#include <catch2/catch.hpp>

#include <forms/element_problem.h>
#include <sherd/fracture/crack_density/any.h>
#include <sherd/fracture/degradation/any.h>
#include <sherd/fracture/irreversibility/any.h>
#include <sherd/material/split/spectral_layer.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>
#include <sherd/verify/derivative.h>

#include <array>

using namespace sherd;
using namespace sherd::test;

namespace
{
constexpr double thickness = .3, step = 5e-4;

/// Every policy that element_derivatives.cc and shell_derivatives.cc do not have, at least once.
using SpectralPlate =
    BrittleShell<2, 2, split::SpectralLayer<2>, degradation::Rational, crack_density::AT1, irreversibility::Penalty>;
using VoldevPlate =
    BrittleShell<2, 2, split::VolumetricDeviatoricLayer<2>, degradation::Any, crack_density::Any, irreversibility::Any>;
using SpectralShell = BrittleShell<2, 3, split::SpectralLayer<3>, degradation::WithResidual<degradation::Quadratic>,
                                   crack_density::AT1, irreversibility::History>;
using VoldevShell   = BrittleShell<2, 3, split::VolumetricDeviatoricLayer<3>, degradation::Quartic,
                                 crack_density::FourthOrder, irreversibility::Penalty>;
using MembraneShell = BrittleShell<2, 3, split::SpectralMembrane<material::Koiter>, degradation::Cubic,
                                   crack_density::SecondOrder, irreversibility::None>;

Toughness<2> sample_toughness(std::integral_constant<int, 2>)
{
  return {[](double x, double y) { return 1.1 + .3 * x * y; }};
}
Toughness<3> sample_toughness(std::integral_constant<int, 3>)
{
  return {[](double x, double y, double) { return 1.1 + .3 * x * y; }};
}

template <class Model, class Split, class Degradation>
Model model(const Split &split, const Degradation &degradation)
{
  return Model(split, degradation, {}, sample_toughness(std::integral_constant<int, Model::spacedim>()), .4, 1.7);
}

template <class Model>
ElementProblem<Model> problem(const Model &model, const Shape shape)
{
  const auto surface = sample_surface<2, Model::spacedim>(shape);
  return {model, surface, surface.n_elements() / 2};
}

struct Sample
{
  Eigen::VectorXd y, direction;
};

/// A random state in which some strains are tensile and some are not, such that the tangent does not jump along a
/// random direction.
template <class Problem>
Sample smooth_sample(const Problem &problem, const typename Problem::History &memory)
{
  const double size = std::sqrt(problem.area());
  for (unsigned seed = 1; seed < 200; ++seed)
    {
      Sample sample{problem.deformed(deformation<Problem::dim>(1.), .03 * size, seed), {}};
      // About the origin, so that positions are rounded like their differences.
      Point<Problem::dim> middle = Point<Problem::dim>::Zero();
      for (int A = 0; A < problem.n_points(); ++A)
        middle += sample.y.template segment<Problem::dim>(A * Problem::n_fields) / problem.n_points();
      for (int A = 0; A < problem.n_points(); ++A)
        sample.y.template segment<Problem::dim>(A * Problem::n_fields) -= middle;
      const Eigen::VectorXd d = random_vector(sample.y.size(), seed + 1000);
      sample.direction        = only<Problem::dim>(Part::u, d) * size + only<Problem::dim>(Part::phi, d);

      const auto at = [&](const double h) { return problem.linearise(sample.y + h * sample.direction, memory).matrix; };
      const auto middle_matrix = at(0.);
      bool       smooth        = true;
      for (const double h : {-.5, .5})
        smooth = smooth &&
                 (at((h - .5) * step) - 2. * at(h * step) + at((h + .5) * step)).norm() < 1e-3 * middle_matrix.norm();
      if (smooth)
        return sample;
    }
  FAIL("no smooth state among the random ones");
  return {};
}

/// Every block of the tangent is the derivative of the force.
template <class Problem>
void check_tangent(const Problem &problem, const typename Problem::History &memory)
{
  const auto sample  = smooth_sample(problem, memory);
  const auto tangent = problem.linearise(sample.y, memory).matrix;
  for (const auto column : {Part::u, Part::phi})
    {
      const Eigen::VectorXd d = only<Problem::dim>(column, sample.direction);
      for (const auto row : {Part::u, Part::phi})
        {
          const auto check = verify::check_derivative(
              [&](double h) { return only<Problem::dim>(row, problem.force(sample.y + h * d, memory)); },
              only<Problem::dim>(row, tangent * d), step, 10);
          CAPTURE(static_cast<int>(row), static_cast<int>(column), check.order, check.smallest_defect);
          CHECK(check.passed());
        }
    }
}

/// Without a past the force is the derivative of the energy, and the tangent is symmetric.
template <class Problem>
void check_force(const Problem &problem)
{
  const auto sample = smooth_sample(problem, {});
  const auto check = verify::check_derivative([&](double h) { return problem.energy(sample.y + h * sample.direction); },
                                              problem.force(sample.y, {}).dot(sample.direction), step, 10);
  CAPTURE(check.order, check.smallest_defect);
  CHECK(check.passed());
  const auto K = problem.linearise(sample.y, {}).matrix;
  CHECK((K - K.transpose()).norm() < 1e-13 * K.norm());
}

/// The memory of a penalty: at some points the phase lies above that of the past, at others below.
template <class Problem>
typename Problem::History damaged(double damage)
{
  typename Problem::History memory;
  memory.fill(damage);
  return memory;
}

template <class Model>
void check_plane(const Model &m)
{
  for (const auto shape : {Shape::distorted, Shape::rational})
    {
      const auto p = problem(m, shape);
      check_tangent(p, damaged<ElementProblem<Model>>(.4));
      check_force(p);
    }
}
} // namespace

TEST_CASE("policies of the plane: tangents, forces and energies agree")
{
  check_plane(model<SpectralPlate>(split::SpectralLayer(sample_moduli), degradation::Rational(2.)));
  check_plane(model<VoldevPlate>(split::VolumetricDeviatoricLayer(sample_moduli),
                                 degradation::Any(degradation::Quartic(.1), 1e-3)));
}

TEST_CASE("spectral layers of a shell: tangents, forces and energies agree")
{
  const auto m = model<SpectralShell>(split::SpectralLayer(sample_moduli, thickness),
                                      degradation::WithResidual(degradation::Quadratic{}, 1e-3));
  const auto p = problem(m, Shape::distorted);
  check_force(p);
  const auto y = smooth_sample(p, {}).y;
  check_tangent(p, past_history(p, y, Past::both));
}

TEST_CASE("volumetric-deviatoric layers of a shell: tangents, forces and energies agree")
{
  const auto m =
      model<VoldevShell>(split::VolumetricDeviatoricLayer(sample_moduli, thickness), degradation::Quartic(.1));
  const auto p = problem(m, Shape::rational);
  check_force(p);
  check_tangent(p, damaged<ElementProblem<VoldevShell>>(.4));
}

TEST_CASE("spectral membrane of a shell with its kinds of bending: tangents, forces and energies agree")
{
  const material::Koiter bending(sample_moduli, thickness);
  const auto             check = [&](const auto &kind) {
    const auto p =
        problem(model<MembraneShell>(split::SpectralMembrane(sample_moduli, bending, kind), degradation::Cubic(.1)),
                            Shape::distorted);
    check_tangent(p, {});
    return p;
  };
  check_force(check(BendingPart::active));
  check_force(check(BendingPart::passive));
  check_force(check(LayerSettings{.thickness = thickness, .cut = Cut::kept}));
  check(LayerSettings{.thickness = thickness});
}

TEST_CASE("penalty: it resists where the phase rises above its past, and nowhere else")
{
  const auto m =
      model<VoldevShell>(split::VolumetricDeviatoricLayer(sample_moduli, thickness), degradation::Quartic(.1));
  const auto            p    = problem(m, Shape::distorted);
  const Eigen::VectorXd y    = p.deformed(deformation<3>(1.), .02, 3);
  const auto            free = p.force(y, damaged<ElementProblem<VoldevShell>>(0.));
  CHECK((p.force(y, damaged<ElementProblem<VoldevShell>>(.05)) - free).norm() == 0.);
  // With the phase above .3 everywhere the force by unit phase is factor Gc / l0 (phi - .2) over the area.
  const Eigen::VectorXd difference = p.force(y, damaged<ElementProblem<VoldevShell>>(.8)) - free;
  CHECK(only<3>(Part::u, difference).norm() == 0.);
  double     expected = 0.;
  const auto phase    = element_phase<VoldevShell>(p.data, p.fields(y));
  for (int q = 0; q < p.n_q; ++q)
    {
      CHECK(phase[q] > .25);
      expected += m.irreversibility.factor() * p.data.toughness[q] / m.length_scale * (phase[q] - .2) *
                  p.data.geometry.reference[q].dA;
    }
  CHECK(difference.sum() == Approx(expected).epsilon(1e-12));
}
