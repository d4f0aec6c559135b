// label: unit
#include <limits>

#include <catch2/catch.hpp>

#include <forms/element_problem.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

const LayerSettings thick{.thickness = .9};

/// About no axis of the frame.
Eigen::Matrix3d turn(double angle)
{
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(1., -2., .5).normalized()).toRotationMatrix();
}

/// x -> Q x + shift of all positions.
Eigen::VectorXd moved(Eigen::VectorXd y, const Eigen::Matrix3d &Q, const Eigen::Vector3d &shift)
{
  for (Eigen::Index A = 0; A < y.size() / 4; ++A)
    y.segment<3>(4 * A) = (Q * y.segment<3>(4 * A) + shift).eval();
  return y;
}

/// A smooth surface, and the control points of its deformed shape as those of a second one.
template <int degree>
struct Pair
{
  Surface<degree, 3> reference, deformed;

  /// Refines both alike.
  void refine(const std::vector<int> &marked, double length)
  {
    reference.refine(marked, {{length, length}});
    deformed.refine(marked, {{length, length}});
  }
};

template <int degree>
Pair<degree> sample_pair()
{
  const auto surface = bulged(shapes::plate<degree, 3>({4., 4.}, {4, 4}));
  auto       patch   = surface.patch(0);
  for (int i = 0; i < patch.control_points.rows(); ++i)
    {
      const Point<3> X            = patch.control_points.row(i).transpose();
      const Point<3> bent         = X + .1 * Point<3>(0., .3 * X[2], .2 * X[0] * X[1] - .1 * X[1] * X[1]);
      patch.control_points.row(i) = (deformation<3>(1.1) * bent).transpose();
    }
  return {surface, {{std::move(patch)}, surface.edges()}};
}

/// Energies of an intact shell, summed over the elements.
template <class Model>
Energies total_energies(const Model &model, const Pair<Model::degree> &pair)
{
  Energies sum;
  for (int e = 0; e < pair.reference.n_elements(); ++e)
    {
      const ElementProblem<Model> problem(model, pair.reference, e);
      Eigen::VectorXd             y(4 * problem.n_points());
      for (int A = 0; A < problem.n_points(); ++A)
        y.segment<4>(4 * A) << pair.deformed.control_points().row(problem.data.geometry.points[A]).transpose(), 1.;
      sum += problem.energies(y, 0. * y);
    }
  return sum;
}

} // namespace

TEMPLATE_TEST_CASE("A rigid motion of a shell makes no force and no energy", "", StretchShell<2>, StretchShell<3>,
                   KoiterShell<3>, KoiterShell<4>)
{
  const auto   shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const double angle   = GENERATE(0., .3, 2.5);
  const auto   problem = sample_problem<TestType>(shape, thick_layers(shape));
  auto         y       = problem.deformed(Eigen::Matrix3d::Identity(), 0., 1);
  for (int A = 0; A < problem.n_points(); ++A)
    y[4 * A + 3] = 1.;
  y = moved(y, turn(angle), {2., -7., 1.});

  // What remains is the stiffness times the rounding of positions, some ten of them to a sum.
  const auto      K         = problem.linearise(y, {}).matrix;
  const double    stiffness = K.cwiseAbs().rowwise().sum().maxCoeff();
  const double    rounding  = std::numeric_limits<double>::epsilon() * y.cwiseAbs().maxCoeff();
  Eigen::VectorXd f         = problem.force(y, {});
  CAPTURE(static_cast<int>(shape), angle, stiffness, f.norm());
  CHECK(f.cwiseAbs().maxCoeff() < 2. * rounding * stiffness);
  CHECK(problem.energy(y) < rounding * rounding * stiffness * y.size());
}

TEMPLATE_TEST_CASE("Turning a shell turns its force and leaves its energy", "", StretchShell<2>, KoiterShell<3>,
                   StretchShell<4>)
{
  const auto problem  = sample_problem<TestType>(GENERATE(Shape::distorted, Shape::rational), thick);
  const auto y        = problem.deformed(deformation<3>(1.05), .03, 8);
  const auto Q        = turn(GENERATE(1.1, 2.5));
  const auto turned   = moved(y, Q, {3., 1., -2.});
  const auto f        = problem.force(y, {});
  const auto expected = moved(f, Q, Eigen::Vector3d::Zero());
  REQUIRE(f.norm() > .1);
  // Rounding of positions times the stiffness.
  const double tolerance = 1e-15 * problem.linearise(y, {}).matrix.cwiseAbs().rowwise().sum().maxCoeff();
  CAPTURE(tolerance);
  CHECK((problem.force(turned, {}) - expected).cwiseAbs().maxCoeff() < 10. * tolerance);
  CHECK(problem.energy(turned) == Approx(problem.energy(y)).epsilon(1e-12));

  // Internal forces are in balance.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = sum;
  for (int A = 0; A < problem.n_points(); ++A)
    {
      const Eigen::Vector3d x = y.template segment<3>(4 * A), force = f.template segment<3>(4 * A);
      sum += force;
      moment += x.cross(force);
    }
  CHECK(sum.norm() < 10. * tolerance);
  CHECK(moment.norm() < 50. * tolerance);
}

TEMPLATE_TEST_CASE("A shell does not depend on its parameters, nor on the side of its normal", "", StretchShell<2>,
                   KoiterShell<3>)
{
  constexpr int degree  = TestType::degree;
  const auto    surface = curved_surface<degree>(Shape::distorted); // 4 x 4 elements
  const auto    patch   = surface.patch(0);
  const int     element = 6;
  const auto    model   = sample_model<TestType>(thick);

  const ElementProblem<TestType> a(model, surface, element);
  const auto                     y      = a.deformed(turn(.7), .08, 9);
  const auto                     A      = a.linearise(y, {}, 1.);
  int                            n_cuts = 0;
  for (int q = 0; q < a.n_q; ++q)
    n_cuts += thickness_weight(layer_stretch(a.point(y, q), thick.thickness, thick.metric)).n_cuts;
  REQUIRE(n_cuts > 0);

  SECTION("the unit of the parameters")
  {
    auto knots_u = shapes::uniform_knots<degree>(4), knots_v = knots_u;
    for (auto &knot : knots_u)
      knot = 1e3 * knot + 20.;
    for (auto &knot : knots_v)
      knot *= .03;
    const Surface<degree, 3> scaled({{LRBasis<degree>(knots_u, knots_v), patch.control_points, patch.weights}}, {});
    const ElementProblem<TestType> b(model, scaled, element);
    const auto                     B = b.linearise(y, {}, 1.);
    CHECK((A.force - B.force).norm() < 1e-12 * A.force.norm());
    CHECK((A.matrix - B.matrix).norm() < 1e-12 * A.matrix.norm());
    CHECK(a.energy(y) == Approx(b.energy(y)).epsilon(1e-12));
  }
  SECTION("their order, which turns the normal over")
  {
    const auto                     other = turned_over(surface, 4, 4);
    const ElementProblem<TestType> b(model, other, element % 4 * 4 + element / 4);
    CHECK((a.point(y, 0).curvature.norm() > 1e-2));
    const int        rows = 4 + degree;
    Eigen::VectorXd  z(y.size());
    std::vector<int> partner(a.n_points());
    for (int i = 0; i < a.n_points(); ++i)
      {
        const int global = a.data.geometry.points[i], exchanged = global % rows * rows + global / rows;
        for (int k = 0; k < b.n_points(); ++k)
          if (b.data.geometry.points[k] == exchanged)
            partner[i] = k;
        z.template segment<4>(4 * partner[i]) = y.template segment<4>(4 * i);
      }
    // Quadrature points lie in another order, but every history is zero.
    const auto      B = b.linearise(z, {}, 1.);
    Eigen::VectorXd force(y.size());
    Eigen::MatrixXd matrix(y.size(), y.size());
    for (int i = 0; i < a.n_points(); ++i)
      {
        force.template segment<4>(4 * i) = B.force.template segment<4>(4 * partner[i]);
        for (int k = 0; k < a.n_points(); ++k)
          matrix.template block<4, 4>(4 * i, 4 * k) = B.matrix.template block<4, 4>(4 * partner[i], 4 * partner[k]);
      }
    CHECK((A.force - force).norm() < 1e-12 * A.force.norm());
    CHECK((A.matrix - matrix).norm() < 1e-12 * A.matrix.norm());
    CHECK(a.energy(y) == Approx(b.energy(z)).epsilon(1e-12));
    // The mid surface has turned over, and so have its curvatures.
    CHECK(a.point(y, 0).mean_curvature == Approx(-b.point(z, 0).mean_curvature).epsilon(1e-12));
  }
}

TEST_CASE("Refinement does not change energies that the Gauss rule integrates exactly")
{
  // Flat, sheared and stretched to parallel quadratic curves: with degree 4 the membrane energy of degree 8 is exact.
  constexpr int degree = 4;
  auto          flat   = shapes::plate<degree, 3>({4., 4.}, {2, 2});
  auto          patch  = flat.patch(0);
  const auto    knots  = shapes::uniform_knots<degree>(2);
  // Control values of the square of a parameter in units of length, by its blossom over inner knots.
  const auto square = [&](int i) {
    double sum = 0.;
    for (int k = 1; k <= degree; ++k)
      for (int l = 1; l < k; ++l)
        sum += knots[i + k] * knots[i + l];
    return 4. * sum / (degree * (degree - 1) / 2);
  };
  const int n = 2 + degree;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      {
        patch.control_points(j * n + i, 0) += .02 * square(j);
        patch.control_points(j * n + i, 1) += .03 * square(i) - .01 * square(j);
      }
  Pair<degree> pair{flat, {{std::move(patch)}, flat.edges()}};
  const auto   model  = sample_model<KoiterShell<degree>>();
  const double before = total_energies(model, pair).elastic();
  REQUIRE(before > .1);
  pair.refine({0, 7, 20}, .5);
  CHECK(total_energies(model, pair).elastic() == Approx(before).epsilon(1e-13));
  pair.refine({3, 30}, .25);
  CHECK(pair.reference.n_elements() > 10);
  CHECK(total_energies(model, pair).elastic() == Approx(before).epsilon(1e-13));
}

TEMPLATE_TEST_CASE("Energies of other surfaces converge with the order of the Gauss rule", "", KoiterShell<2>,
                   KoiterShell<3>)
{
  constexpr int degree = TestType::degree;
  const auto    model  = sample_model<TestType>();
  auto          pair   = sample_pair<degree>();
  double        energies[4];
  for (int level = 0; level < 4; ++level)
    {
      if (level > 0)
        {
          std::vector<int> all(pair.reference.n_control_points());
          std::iota(all.begin(), all.end(), 0);
          pair.refine(all, std::ldexp(1., -level));
        }
      energies[level] = total_energies(model, pair).elastic();
    }
  const double coarse = std::abs(energies[1] - energies[3]), fine = std::abs(energies[2] - energies[3]);
  CAPTURE(energies[0], energies[1], energies[2], energies[3]);
  // Order 2 degree + 2 with the finest mesh for the exact value, down to rounding.
  CHECK(fine < std::max(std::ldexp(coarse, -2 * degree - 1), 1e-11 * energies[3]));
  CHECK(fine < 1e-4 * energies[3]);
}
