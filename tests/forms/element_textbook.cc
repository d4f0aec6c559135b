// label: unit
#include <catch2/catch.hpp>

#include <forms/textbook_element.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

template <class Model>
void check_against_textbook(Shape shape, double J, const LayerSettings &layers = {.thickness = .3})
{
  constexpr int               dim = Model::spacedim, n_fields = Model::n_fields;
  const auto                  surface = sample_surface<Model::degree, Model::spacedim>(shape);
  const int                   element = shape == Shape::overloaded ? most_loaded_element(surface) : 1;
  const auto                  model   = sample_model<Model>(layers);
  const ElementProblem<Model> problem(model, surface, element);
  const double                size         = std::sqrt(problem.area());
  const auto                  y            = problem.deformed(deformation<dim>(J), .03 * size, 21);
  const auto                  acceleration = random_vector(y.size(), 4);
  // Loading at every other point.
  auto history = problem.active_energy(y);
  for (std::size_t q = 0; q < history.size(); ++q)
    history[q] *= q % 2 == 0 ? 2. : .5;

  const auto expected =
      textbook_element(model, surface, element, y, acceleration, {history.begin(), history.end()}, .8);
  const auto kernel = problem.linearise(y, history, .8);
  const auto force  = problem.force(y, history, acceleration);

  // Rounding of second derivatives on small elements, relative to the largest entry.
  CAPTURE(static_cast<int>(shape), J, problem.n_points());
  CHECK((force - expected.force).cwiseAbs().maxCoeff() < 1e-11 * expected.force.cwiseAbs().maxCoeff());
  CHECK((kernel.matrix - expected.matrix).cwiseAbs().maxCoeff() < 1e-11 * expected.matrix.cwiseAbs().maxCoeff());
  // The blocks differ in size; each has to be right.
  for (int r = 0; r < n_fields; ++r)
    for (int c = 0; c < n_fields; ++c)
      {
        double largest = 0., defect = 0.;
        for (int A = 0; A < problem.n_points(); ++A)
          for (int B = 0; B < problem.n_points(); ++B)
            {
              const double value = expected.matrix(n_fields * A + r, n_fields * B + c);
              largest            = std::max(largest, std::abs(value));
              defect = std::max(defect, std::abs(kernel.matrix(n_fields * A + r, n_fields * B + c) - value));
            }
        CAPTURE(r, c, largest);
        CHECK(defect < 1e-11 * largest);
      }
}

} // namespace

TEMPLATE_TEST_CASE("The kernel agrees with the formulas of the theory, index by index", "", CubicFourthStretch,
                   QuadraticSecondStretch)
{
  const auto   shape = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const double J     = GENERATE(1.3, .75);
  check_against_textbook<TestType>(shape, J);
}

TEST_CASE("So it does for splines of degree 3")
{
  check_against_textbook<CubicFourthStretch3>(GENERATE(Shape::overloaded, Shape::rational), 1.2);
}

TEMPLATE_TEST_CASE("The kernel of the shell agrees with the formulas of the theory, index by index", "",
                   StretchShell<2>, StretchShell<3>, StretchShell<4>, WholeShell<2>, KoiterShell<3>, KoiterShell<4>)
{
  const auto   shape = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const double J     = GENERATE(1.3, 1.02, .75);
  check_against_textbook<TestType>(shape, J, thick_layers(shape, GENERATE(Cut::frozen, Cut::kept)));
}
