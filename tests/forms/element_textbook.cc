// label: unit
#include <catch2/catch.hpp>

#include <forms/textbook_element.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

template <class Model>
void check_against_textbook(Shape shape, double J)
{
  const auto                  surface = sample_surface<Model::degree>(shape);
  const int                   element = shape == Shape::overloaded ? most_loaded_element(surface) : 1;
  const auto                  model   = sample_model<Model>();
  const ElementProblem<Model> problem(model, surface, element);
  const double                size = std::sqrt(problem.area());
  const auto                  y    = problem.deformed(deformation(J), .03 * size, 21);
  std::mt19937                random(4);
  Eigen::VectorXd             acceleration(y.size());
  for (auto &value : acceleration)
    value = symmetric(random);
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
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      {
        double largest = 0., defect = 0.;
        for (int A = 0; A < problem.n_points(); ++A)
          for (int B = 0; B < problem.n_points(); ++B)
            {
              const double value = expected.matrix(3 * A + r, 3 * B + c);
              largest            = std::max(largest, std::abs(value));
              defect             = std::max(defect, std::abs(kernel.matrix(3 * A + r, 3 * B + c) - value));
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
