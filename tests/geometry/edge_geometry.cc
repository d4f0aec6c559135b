// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/edge_geometry.h>

using namespace sherd;

namespace
{

/// int f(X) dS over a named edge.
template <int degree, int spacedim, class Function>
auto integral(const Surface<degree, spacedim> &surface, const std::string &name, const Function &f)
{
  std::decay_t<decltype(f(Point<spacedim>()))> sum = 0. * f(Point<spacedim>(Point<spacedim>::Zero()));
  for (const auto &edge : surface.edge(name))
    for (const auto &piece : edge_geometry(surface, edge))
      for (const auto &q : piece.quadrature)
        sum += q.dS * f(q.position);
  return sum;
}

} // namespace

TEST_CASE("Lengths and moments of straight edges are exact, hanging lines or not")
{
  auto surface = test::distorted(shapes::plate<2, 2>({2., 3.}, {4, 4}), .1);
  test::refine_at_random(surface, 2, 4, 12);
  for (const auto &[name, length, x, y] : {std::tuple{"left", 3., 0., 1.5}, std::tuple{"right", 3., 2., 1.5},
                                           std::tuple{"bottom", 2., 1., 0.}, std::tuple{"top", 2., 1., 3.}})
    {
      INFO(name);
      CHECK(integral(surface, name, [](const Point<2> &) { return 1.; }) == Approx(length).epsilon(1e-14));
      CHECK(integral(surface, name, [](const Point<2> &X) { return X[0]; }) == Approx(length * x).margin(1e-13));
      CHECK(integral(surface, name, [](const Point<2> &X) { return X[1]; }) == Approx(length * y).margin(1e-13));
    }
}

TEST_CASE("Shape functions on an edge sum to one and reproduce the position")
{
  auto surface = test::quarter_annulus<2, 2>(1., 2.);
  test::refine_at_random(surface, 3, 2, 4);
  const auto X = surface.control_points();
  for (const auto &[name, sides] : surface.edges())
    for (const auto &piece : edge_geometry(surface, sides.front()))
      for (const auto &q : piece.quadrature)
        {
          double   sum = 0.;
          Point<2> x   = Point<2>::Zero();
          for (std::size_t k = 0; k < piece.points.size(); ++k)
            {
              sum += q.value[k];
              x += q.value[k] * X.row(piece.points[k]).transpose();
            }
          CHECK(sum == Approx(1.).epsilon(1e-14));
          CHECK((x - q.position).norm() < 1e-14);
          if (name == "inner" || name == "outer")
            CHECK(q.position.norm() == Approx(name == "inner" ? 1. : 2.).epsilon(1e-14));
          else
            CHECK(std::abs(q.position[name == "start" ? 1 : 0]) < 1e-14);
        }
}

TEST_CASE("Length and resultant pressure of an arc converge with order 6")
{
  // int e_r dS over the outer quarter of radius 2 is (2, 2).
  auto   surface = test::quarter_annulus<2, 2>(1., 2.);
  double length[3], force[3];
  for (int level = 0; level < 3; ++level)
    {
      length[level] = std::abs(integral(surface, "outer", [](const Point<2> &) { return 1.; }) - M_PI);
      force[level] =
          (integral(surface, "outer", [](const Point<2> &X) -> Point<2> { return X / 2.; }) - Point<2>(2., 2.)).norm();
      test::refine_everywhere(surface, level + 1);
    }
  CHECK(std::log2(length[0] / length[1]) > 5.);
  CHECK(std::log2(length[1] / length[2]) > 5.5);
  CHECK(std::log2(force[0] / force[1]) > 5.);
  CHECK(length[2] < 1e-7); // what four elements reach
  CHECK(force[2] < 1e-7);
  CHECK(integral(surface, "start", [](const Point<2> &) { return 1.; }) == Approx(1.).epsilon(1e-14));
}

TEST_CASE("Pieces follow the edge in the direction of its parameter")
{
  auto surface = test::quarter_turn<2, 3>(1., 0., 1., 2.); // cylinder, u along its axis
  test::refine_at_random(surface, 3, 2, 9);
  double z = 0.;
  for (const auto &piece : edge_geometry(surface, surface.edge("start").front()))
    for (const auto &q : piece.quadrature)
      {
        CHECK(q.position[2] > z);
        z = q.position[2];
      }
  double y = 0.;
  for (const auto &piece : edge_geometry(surface, surface.edge("outer").front()))
    for (const auto &q : piece.quadrature)
      {
        CHECK(q.position[1] > y);
        y = q.position[1];
      }
}

TEMPLATE_TEST_CASE("Derivatives on an edge are those of the shape functions", "", (std::integral_constant<int, 2>),
                   (std::integral_constant<int, 3>))
{
  constexpr int degree  = TestType::value;
  auto          surface = test::quarter_turn<degree, 3>(1., 0., 3., 1.);
  auto          patch   = surface.patch(0);
  std::mt19937  random(23);
  for (auto &weight : patch.weights)
    weight *= 1. + .2 * test::symmetric(random);
  surface = {{std::move(patch)}, surface.edges()};
  test::refine_at_random(surface, 3, 2, 4);
  const auto &basis = surface.patch(0).basis;
  const auto &w     = surface.patch(0).weights;

  for (const auto &[name, sides] : surface.edges())
    for (const auto &piece : edge_geometry(surface, sides.front()))
      {
        INFO(name << ", element " << piece.element);
        CHECK(piece.normal_direction == (name == "inner" || name == "outer" ? 0 : 1));
        CHECK(piece.outward == (name == "outer" || name == "end" ? 1 : -1));
        const auto &element = basis.element(piece.element);
        const auto  box     = [&](double s, double t) {
          return std::array{element.min[0] + s * (element.max[0] - element.min[0]),
                            element.min[1] + t * (element.max[1] - element.min[1])};
        };
        for (int q = 0; q <= degree; ++q)
          {
            // One-sided differences of the recurrence of Cox and de Boor, of order 4, into the element.
            const auto  &point  = piece.quadrature[q];
            const double along  = gauss_legendre(degree + 1).points[q];
            const double border = piece.outward == 1 ? 1. : 0.;
            const auto   values = [&](double s, double t) {
              const auto      at        = box(s, t);
              const auto      functions = evaluate(basis, piece.element, at[0], at[1]);
              Eigen::VectorXd N(functions.size());
              for (std::size_t k = 0; k < functions.size(); ++k)
                N[k] = w[piece.points[k]] * functions[k].value;
              return Eigen::VectorXd(N / N.sum());
            };
            const auto slope = [&](int d) {
              const double    h = (d == piece.normal_direction ? -piece.outward : along < .5 ? 1. : -1.) * 1e-3;
              Eigen::VectorXd sum;
              const double    weights[] = {-25., 48., -36., 16., -3.};
              for (int k = 0; k < 5; ++k)
                {
                  double at[2];
                  at[piece.normal_direction]     = border;
                  at[1 - piece.normal_direction] = along;
                  at[d] += k * h;
                  const Eigen::VectorXd term = weights[k] / (12. * h) * values(at[0], at[1]);
                  sum                        = k == 0 ? term : Eigen::VectorXd(sum + term);
                }
              return sum;
            };
            const Eigen::VectorXd d1 = slope(0), d2 = slope(1);
            Point<3>              A1 = Point<3>::Zero(), A2 = A1;
            for (std::size_t k = 0; k < piece.points.size(); ++k)
              {
                // Differences: h^4 for the error of the formula and 1e-16/h for rounding.
                CHECK(std::abs(point.d1[k] - d1[k]) < 1e-9);
                CHECK(std::abs(point.d2[k] - d2[k]) < 1e-9);
                A1 += point.d1[k] * surface.patch(0).control_points.row(piece.points[k]).transpose();
                A2 += point.d2[k] * surface.patch(0).control_points.row(piece.points[k]).transpose();
              }
            CHECK((A1 - point.A1).norm() < 1e-13);
            CHECK((A2 - point.A2).norm() < 1e-13);
            const auto tangent = piece.normal_direction == 0 ? A2 : A1;
            CHECK(point.dS == Approx(tangent.norm() * gauss_legendre(degree + 1).weights[q]).epsilon(1e-13));
          }
      }
}
