// label: unit
#include <limits>

#include <catch2/catch.hpp>

#include <forms/element_problem.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

using Model   = CubicFourthStretch;
using Problem = ElementProblem<Model>;

Eigen::Matrix2d turn(double angle)
{
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

/// Undeformed, intact, moved as a rigid body.
Eigen::VectorXd rigid(const Problem &problem, double angle, const Eigen::Vector2d &shift)
{
  auto y = problem.deformed(turn(angle), 0., 1);
  for (int A = 0; A < problem.n_points(); ++A)
    {
      y.segment<2>(3 * A) += shift;
      y[3 * A + 2] = 1.;
    }
  return y;
}

} // namespace

TEST_CASE("A rigid motion makes no force and no energy")
{
  const auto   shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const auto   problem = sample_problem<Model>(shape);
  const double angle   = GENERATE(0., .3, 2.5);
  const auto   y       = rigid(problem, angle, {20., -7.});
  // Positions up to 25 are rounded to 4e-15, strains to that over the size of the element, forces to the same times
  // stiffness and size. The gradient of the constant phase cancels alike.
  CHECK(problem.force(y, {}).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(problem.energy(y) < 1e-24);
}

TEST_CASE("Turning the body turns the force")
{
  const auto      problem = sample_problem<Model>(GENERATE(Shape::overloaded, Shape::rational));
  const auto      y       = problem.deformed(deformation(1.2), .03, 8);
  const auto      Q       = turn(1.1);
  Eigen::VectorXd turned  = y;
  for (int A = 0; A < problem.n_points(); ++A)
    turned.segment<2>(3 * A) = Q * y.segment<2>(3 * A) + Eigen::Vector2d(3., 1.);
  const auto f = problem.force(y, {}), f_turned = problem.force(turned, {});
  REQUIRE(f.norm() > .1);
  for (int A = 0; A < problem.n_points(); ++A)
    {
      CHECK((f_turned.segment<2>(3 * A) - Q * f.segment<2>(3 * A)).norm() < 1e-13 * (1. + f.norm()));
      CHECK(std::abs(f_turned[3 * A + 2] - f[3 * A + 2]) < 1e-13 * (1. + f.norm()));
    }
  // Internal forces are in balance.
  Eigen::Vector2d sum    = Eigen::Vector2d::Zero();
  double          moment = 0.;
  for (int A = 0; A < problem.n_points(); ++A)
    {
      sum += f.segment<2>(3 * A);
      moment += y[3 * A] * f[3 * A + 1] - y[3 * A + 1] * f[3 * A];
    }
  CHECK(sum.norm() < 1e-13 * f.norm());
  CHECK(std::abs(moment) < 1e-12 * f.norm());
}

TEST_CASE("Force, tangent and energy do not depend on the parameters")
{
  const auto surface = distorted(shapes::plate<2, 2>({3., 3.}, {3, 3}), .15);
  const auto patch   = surface.patch(0);
  const int  element = 3; // on the left edge: not symmetric under exchange of the parameters

  SECTION("their unit")
  {
    auto knots_u = shapes::uniform_knots<2>(3), knots_v = knots_u;
    for (auto &knot : knots_u)
      knot *= 1e3;
    for (auto &knot : knots_v)
      knot *= .03;
    const Surface<2, 2> scaled({{LRBasis<2>(knots_u, knots_v), patch.control_points, patch.weights}}, {});
    const Problem       a(sample_model<Model>(), surface, element), b(sample_model<Model>(), scaled, element);
    const auto          y = a.deformed(deformation(1.2), .03, 9);
    const auto          A = a.linearise(y, {}, 1.), B = b.linearise(y, {}, 1.);
    CHECK((A.force - B.force).norm() < 1e-13 * A.force.norm());
    CHECK((A.matrix - B.matrix).norm() < 1e-13 * A.matrix.norm());
    CHECK(a.energy(y) == Approx(b.energy(y)).epsilon(1e-13));
  }
  SECTION("their order, which turns the surface over")
  {
    auto exchanged = patch;
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 5; ++i)
        exchanged.control_points.row(i * 5 + j) = patch.control_points.row(j * 5 + i);
    const Surface<2, 2> other({exchanged}, {});
    const Problem       a(sample_model<Model>(), surface, element), b(sample_model<Model>(), other, 1);
    const auto          y = a.deformed(deformation(.8), .03, 9);
    const auto          f = a.force(y, {});
    Eigen::VectorXd     z(y.size()), back(y.size());
    const auto          partner = [](int A) { return A % 3 * 3 + A / 3; };
    for (int A = 0; A < 9; ++A)
      z.segment<3>(3 * partner(A)) = y.segment<3>(3 * A);
    const auto g = b.force(z, {});
    for (int A = 0; A < 9; ++A)
      back.segment<3>(3 * A) = g.segment<3>(3 * partner(A));
    CHECK((f - back).norm() < 1e-13 * f.norm());
    CHECK(a.energy(y) == Approx(b.energy(z)).epsilon(1e-13));
  }
}

TEST_CASE("The mass is that of the area, and inertia its product with the acceleration")
{
  const auto      problem = sample_problem<Model>(GENERATE(Shape::distorted, Shape::overloaded, Shape::rational));
  const auto      y       = problem.deformed(deformation(1.1), .03, 3);
  Eigen::MatrixXd M       = problem.linearise(y, {}, 2.).matrix - problem.linearise(y, {}, 0.).matrix;
  M /= 2.;

  for (int c = 0; c < 3; ++c)
    for (int d = 0; d < 3; ++d)
      {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(y.size()), column = row;
        for (int A = 0; A < problem.n_points(); ++A)
          row[3 * A + c] = 1., column[3 * A + d] = 1.;
        const double expected = c == d && c < 2 ? problem.model.mass * problem.area() : 0.;
        CHECK(row.dot(M * column) == Approx(expected).margin(1e-12));
      }

  std::mt19937    random(2);
  Eigen::VectorXd a(y.size());
  for (auto &value : a)
    value = symmetric(random);
  const Eigen::VectorXd inertia = problem.force(y, {}, a) - problem.force(y, {});
  CHECK((inertia - M * a).norm() < 1e-12);
  // Half its square is the kinetic energy.
  CHECK(problem.energies(y, a).kinetic == Approx(.5 * a.dot(M * a)).epsilon(1e-12));
}

TEST_CASE("Energies of a homogeneous state")
{
  // Element on a plate, F and phi constant. The toughness is evaluated at the middle through its average: on an element
  // symmetric about the Gauss points, a bilinear function integrates exactly.
  const auto    surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  const Problem problem(sample_model<Model>(), surface, 6); // [2, 3] x [1, 2]
  const double  Gc = 1.1 + .3 * 2.5 * 1.5, l0 = .4, phi = .7, before = .8, rho = 1.7;
  const double  K = 2.1, G = 1.3;
  const double  J = GENERATE(1.21, .81);

  auto            y = problem.deformed(deformation(J), 0., 1);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(y.size()), old = y;
  for (int A = 0; A < problem.n_points(); ++A)
    {
      y[3 * A + 2]   = phi;
      old[3 * A + 2] = before;
      v.segment<2>(3 * A) << 3., -4.;
    }
  std::array<double, 9> history;
  history.fill(5.);
  const auto   e   = problem.energies(y, v);
  const auto   F   = deformation(J);
  const double dil = K / 4. * (J * J - 1. - 2. * std::log(J)), dev = G / 2. * ((F.transpose() * F).trace() / J - 2.);
  const double plus = J > 1. ? dil + dev : dev, minus = J > 1. ? 0. : dil;
  const degradation::Cubic g;
  CHECK(e.active == Approx(g.value(phi) * plus).epsilon(1e-12));
  CHECK(e.passive == Approx(minus).epsilon(1e-12).margin(1e-15));
  CHECK(e.elastic() == e.active + e.passive);
  CHECK(e.kinetic == Approx(.5 * rho * 25.).epsilon(1e-13));
  CHECK(e.fracture == Approx(Gc / (4. * l0) * .09).epsilon(1e-12));
  // g' at the middle of the step times the change of the phase.
  CHECK(problem.withheld_work(y, old, history) == Approx(g.first(.75) * (5. - plus) * (phi - before)).epsilon(1e-12));

  Energies sum = e;
  sum += Energies{1., 2., 3., 4.};
  CHECK(sum.active == e.active + 1.);
  CHECK(sum.passive == e.passive + 2.);
  CHECK(sum.kinetic == e.kinetic + 3.);
  CHECK(sum.fracture == e.fracture + 4.);
}

TEST_CASE("Active energy and phase at the quadrature points")
{
  const auto      problem = sample_problem<Model>(Shape::rational);
  Eigen::VectorXd y       = problem.deformed(deformation(1.2), .05, 2);
  const auto      energy  = problem.active_energy(y);
  const auto      phase   = element_phase<Model>(problem.data, problem.fields(y));
  // Their integrals with g are the active energy.
  double sum = 0.;
  for (int q = 0; q < problem.n_q; ++q)
    sum += problem.data.geometry.reference[q].dA * problem.model.degradation.value(phase[q]) * energy[q];
  CHECK(sum == Approx(problem.energies(y, 0. * y).active).epsilon(1e-13));
  // A phase that is linear in x, y comes out at the positions of the points.
  for (int A = 0; A < problem.n_points(); ++A)
    y[3 * A + 2] = 2. * problem.X(A, 0) - problem.X(A, 1);
  const auto linear = element_phase<Model>(problem.data, problem.fields(y));
  for (int q = 0; q < problem.n_q; ++q)
    {
      const auto X = problem.data.geometry.position(q);
      CHECK(linear[q] == Approx(2. * X[0] - X[1]).margin(1e-13));
    }
}

TEST_CASE("A model without length or mass is refused")
{
  const auto make = [](double l0, double mass) {
    return Model(decltype(Model::split)(material::NeoHooke(1., 1.)), degradation::Cubic(), {}, 1., l0, mass);
  };
  const double bad =
      GENERATE(0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(make(bad, 1.), InvalidParameter);
  CHECK_THROWS_AS(make(1., bad), InvalidParameter);
  CHECK_NOTHROW(make(1., 1.));
  CHECK_THROWS_WITH(make(-2., 1.), Catch::Contains("length scale"));
}

TEST_CASE("A toughness that fails inside an element says where")
{
  const auto  surface = shapes::plate<2, 2>({1., 1.}, {2, 2});
  const Model model(decltype(Model::split)(material::NeoHooke(1., 1.)), degradation::Cubic(), {},
                    Toughness<2>([](const Point<2> &X) { return X[0] > .5 ? -1. : 1.; }), .1, 1.);
  CHECK_NOTHROW(element_data(model, surface, 0));
  CHECK_THROWS_AS(element_data(model, surface, 1), InvalidParameter);
}
