// label: unit
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include <forms/element_problem.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// J - 1 must not change its sign on the path of the difference quotients, where the stress has a kink.
template <class Problem>
bool stays_on_one_side(const Problem &problem, const Eigen::VectorXd &y, const Eigen::VectorXd &direction, double J)
{
  for (const double h : {-1e-2, 0., 1e-2})
    for (int q = 0; q < problem.n_q; ++q)
      if ((problem.point(y + h * direction, q).J > 1.) != (J > 1.))
        return false;
  return true;
}

} // namespace

TEMPLATE_TEST_CASE("Every block of the tangent is the derivative of the force", "", CubicFourthStretch,
                   QuadraticSecondStretch, CubicSecondNone, QuadraticFourthNone)
{
  const auto   shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const double J       = GENERATE(1.3, .75);
  const auto   past    = GENERATE(Past::loading, Past::unloading, Past::both);
  const auto   problem = sample_problem<TestType>(shape);
  if (shape == Shape::overloaded)
    REQUIRE(problem.n_points() > 12);
  CAPTURE(static_cast<int>(shape), J, static_cast<int>(past));

  // The overloaded element is four times smaller.
  const double size      = std::sqrt(problem.area());
  const auto   y         = problem.deformed(deformation(J), .03 * size, 5);
  const auto   history   = past_history(problem, y, past);
  const auto   tangent   = problem.linearise(y, history).matrix;
  const auto   direction = random_vector(y.size(), 17);
  for (const auto column : {Part::u, Part::phi})
    {
      const Eigen::VectorXd d = only<2>(column, direction) * (column == Part::u ? size : 1.);
      REQUIRE(stays_on_one_side(problem, y, d, J));
      for (const auto row : {Part::u, Part::phi})
        {
          const auto check = verify::check_derivative(
              [&](double h) { return only<2>(row, problem.force(y + h * d, history)); }, only<2>(row, tangent * d));
          CAPTURE(static_cast<int>(row), static_cast<int>(column), check.order, check.smallest_defect);
          CHECK(check.order > check.required_order);
          CHECK(check.smallest_defect < check.allowed_defect);
        }
    }

  // Phase and deformation couple in the row of the phase only where the history loads.
  const Eigen::VectorXd coupling = only<2>(Part::phi, tangent * only<2>(Part::u, direction));
  CHECK((coupling.norm() > 1e-3 * tangent.norm() * size) == (past != Past::unloading));
}

TEMPLATE_TEST_CASE("While the history loads, the force is the derivative of the energy", "", CubicFourthStretch,
                   QuadraticSecondStretch, CubicSecondNone, QuadraticFourthNone)
{
  const auto            shape     = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const double          J         = GENERATE(1.3, .75);
  const auto            problem   = sample_problem<TestType>(shape);
  const double          size      = std::sqrt(problem.area());
  const auto            y         = problem.deformed(deformation(J), .03 * size, 6);
  const Eigen::VectorXd direction = random_vector(y.size(), 3);
  const Eigen::VectorXd d         = only<2>(Part::u, direction) * size + only<2>(Part::phi, direction);
  REQUIRE(stays_on_one_side(problem, y, d, J));
  const auto check =
      verify::check_derivative([&](double h) { return problem.energy(y + h * d); }, problem.force(y, {}).dot(d));
  CAPTURE(static_cast<int>(shape), J, check.order, check.smallest_defect);
  CHECK(check.order > check.required_order);
  CHECK(check.smallest_defect < check.allowed_defect);

  // Then the tangent is a Hessian.
  const auto K = problem.linearise(y, {}).matrix;
  CHECK((K - K.transpose()).norm() < 1e-13 * K.norm());
}

TEST_CASE("Force and tangent return the same force")
{
  const auto problem = sample_problem<CubicFourthStretch>(Shape::rational);
  const auto y       = problem.deformed(deformation(1.2), .03, 5);
  const auto history = past_history(problem, y, Past::both);
  const auto force   = problem.force(y, history);
  CHECK((force - problem.linearise(y, history, 2.).force).norm() <
        1e-15 * force.norm()); // two compilations of one code
}

TEST_CASE("The switched tangent has a positive phase stiffness, and differs in nothing else")
{
  // Intact under three times the onset energy: kappa = g'' H + Gc/(2 l0) is negative.
  const auto      problem = sample_problem<CubicFourthStretch>(Shape::distorted);
  Eigen::VectorXd y       = problem.deformed(Eigen::Matrix2d::Identity(), 0., 1);
  for (Eigen::Index i = 2; i < y.size(); i += 3)
    y[i] = 1.;
  std::array<double, 9> history;
  for (std::size_t q = 0; q < history.size(); ++q)
    history[q] = 3. * branch::onset(problem.model.degradation, problem.data.toughness[q], .4);

  const auto consistent = problem.linearise(y, history).matrix;
  const auto switched   = problem.linearise(y, history, 0., PhaseTangent::switched).matrix;
  const auto phase      = [&](const Eigen::MatrixXd &K) {
    Eigen::MatrixXd block(problem.n_points(), problem.n_points());
    for (int A = 0; A < problem.n_points(); ++A)
      for (int B = 0; B < problem.n_points(); ++B)
        block(A, B) = K(3 * A + 2, 3 * B + 2);
    return block;
  };
  Eigen::MatrixXd difference = switched - consistent;
  for (int A = 0; A < problem.n_points(); ++A)
    for (int B = 0; B < problem.n_points(); ++B)
      difference(3 * A + 2, 3 * B + 2) = 0.;
  CHECK(difference.norm() == 0.);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(problem.n_points());
  CHECK(one.dot(phase(consistent) * one) < 0.);
  CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(phase(switched)).eigenvalues()[0] > 0.);
  // kappa = (1 - 3 (6 - 4 s)/(6 - 4 s)) Gc/(2 l0) = -2 Gc/(2 l0): the switch turns its sign.
  CHECK(one.dot(phase(switched) * one) == Approx(-one.dot(phase(consistent) * one)).epsilon(1e-12));
}
