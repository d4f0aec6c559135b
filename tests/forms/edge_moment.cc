// label: unit
#include <catch2/catch.hpp>

#include <forms/loaded_surfaces.h>
#include <sherd/forms/edge_moment.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

template <int degree>
PieceMoment<degree> varying_moment()
{
  PieceMoment<degree> m;
  for (int q = 0; q <= degree; ++q)
    m[q] = 1.3 - .8 * q + .3 * q * q;
  return m;
}

template <int degree>
PieceMoment<degree> constant_moment(double value)
{
  PieceMoment<degree> m;
  m.fill(value);
  return m;
}

/// Per side of the parameter rectangle the piece with the most control points.
template <int degree>
std::vector<EdgeGeometry<degree, 3>> one_piece_a_side(const Surface<degree, 3> &surface)
{
  std::vector<EdgeGeometry<degree, 3>> result;
  for (const auto &[name, sides] : surface.edges())
    {
      auto pieces = edge_geometry(surface, sides.front());
      result.push_back(*std::max_element(pieces.begin(), pieces.end(), [](const auto &a, const auto &b) {
        return a.points.size() < b.points.size();
      }));
    }
  return result;
}

/// n of the surface with control points x at quadrature point q of an edge.
template <int degree>
Point<3> normal_at(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x, int q)
{
  Point<3> a1 = Point<3>::Zero(), a2 = a1;
  for (Eigen::Index A = 0; A < x.rows(); ++A)
    {
      a1 += piece.quadrature[q].d1[A] * x.row(A).transpose();
      a2 += piece.quadrature[q].d2[A] * x.row(A).transpose();
    }
  return a1.cross(a2).normalized();
}

/// Force and derivative by the indices of theory E.3, summed literally.
template <int degree>
std::pair<ControlValues<3>, Eigen::MatrixXd> by_indices(const EdgeGeometry<degree, 3> &piece, const ControlValues<3> &x,
                                                        const PieceMoment<degree> &moment)
{
  const Eigen::Index n = x.rows();
  const int          e = piece.normal_direction;
  const double       s = piece.outward;
  ControlValues<3>   f = ControlValues<3>::Zero(n, 3);
  Eigen::MatrixXd    K = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int q = 0; q <= degree; ++q)
    {
      const auto                 &point = piece.quadrature[q];
      const std::vector<double>   N[2]  = {point.d1, point.d2};
      Eigen::Matrix<double, 3, 2> a     = Eigen::Matrix<double, 3, 2>::Zero();
      for (Eigen::Index A = 0; A < n; ++A)
        for (int i = 0; i < 2; ++i)
          a.col(i) += N[i][A] * x.row(A).transpose();
      const Eigen::Matrix2d             up     = (a.transpose() * a).inverse();
      const Eigen::Matrix<double, 3, 2> dual   = a * up;
      const Point<3>                    normal = a.col(0).cross(a.col(1)).normalized();
      const double                      root   = std::sqrt(up(e, e));
      const double                      m      = moment[q] * point.dS;
      for (Eigen::Index A = 0; A < n; ++A)
        for (int i = 0; i < 2; ++i)
          {
            const double nu = s * up(e, i) / root;
            f.row(A) -= m * N[i][A] * nu * normal.transpose();
            for (Eigen::Index B = 0; B < n; ++B)
              for (int c = 0; c < 2; ++c)
                {
                  K.block<3, 3>(3 * A, 3 * B) += m * N[i][A] * nu * dual.col(c) * normal.transpose() * N[c][B];
                  for (int d = 0; d < 2; ++d)
                    {
                      const double first = -.5 * (up(e, c) * up(i, d) + up(e, d) * up(i, c)) / root;
                      const double nu_cd = s * (first + up(e, i) * up(e, c) * up(e, d) / (2. * root * root * root));
                      K.block<3, 3>(3 * A, 3 * B) -=
                          m * N[i][A] * normal * (nu_cd * 2. * N[c][B] * a.col(d)).transpose();
                    }
                }
          }
    }
  return {f, K};
}

Eigen::VectorXd flat(const ControlValues<3> &values)
{
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}

ControlValues<3> shaped(const Eigen::VectorXd &values)
{
  return Eigen::Map<const ControlValues<3>>(values.data(), values.size() / 3, 3);
}

/// Sum over an edge of x_A x f_A, shape=(3), and of f_A.
template <int degree>
std::pair<Point<3>, Point<3>> resultants(const Surface<degree, 3> &surface, const std::string &name,
                                         const ControlValues<3> &x, double m)
{
  Point<3> moment = Point<3>::Zero(), force = moment;
  for (const auto &edge : surface.edge(name))
    for (const auto &piece : edge_geometry(surface, edge))
      {
        const auto values = rows_of(x, piece.points);
        const auto f      = edge_moment_force(piece, values, constant_moment<degree>(m));
        for (Eigen::Index A = 0; A < f.rows(); ++A)
          {
            moment += values.row(A).transpose().cross(f.row(A).transpose());
            force += f.row(A).transpose();
          }
      }
  return {moment, force};
}

using Degrees = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

} // namespace

TEMPLATE_LIST_TEST_CASE("The tangent of an edge moment is the derivative of its force", "", Degrees)
{
  constexpr int degree  = TestType::value;
  const auto    shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const auto    surface = curved_surface<degree>(shape);
  const auto    moment  = varying_moment<degree>();
  std::size_t   most    = 0;
  for (const auto &piece : one_piece_a_side(surface))
    {
      INFO("direction " << piece.normal_direction << ", outward " << piece.outward);
      most                            = std::max(most, piece.points.size());
      const auto            x         = disturbed(rows_of(surface.control_points(), piece.points), .05, 5);
      const Eigen::VectorXd direction = flat(disturbed(ControlValues<3>::Zero(x.rows(), 3), 1., 6));
      const auto            K         = edge_moment_tangent(piece, x, moment);
      const auto            check     = verify::check_derivative(
          [&](double h) { return flat(edge_moment_force(piece, shaped(flat(x) + h * direction), moment)); },
          Eigen::VectorXd(K * direction));
      INFO("order " << check.order << ", defect " << check.smallest_defect);
      CHECK(check.passed());

      const auto [f, by_theory] = by_indices(piece, x, moment);
      CHECK((K - by_theory).norm() < 1e-13 * K.norm());
      CHECK((edge_moment_force(piece, x, moment) - f).norm() < 1e-13 * f.norm());
    }
  if (shape == Shape::overloaded)
    CHECK(most > (degree + 1) * (degree + 1));
}

TEMPLATE_LIST_TEST_CASE("The work of an edge moment is that on the turning normal", "", Degrees)
{
  constexpr int degree  = TestType::value;
  const auto    surface = curved_surface<degree>(GENERATE(Shape::overloaded, Shape::rational));
  const auto    moment  = varying_moment<degree>();
  for (const auto &piece : one_piece_a_side(surface))
    {
      const auto             x  = disturbed(rows_of(surface.control_points(), piece.points), .05, 5);
      const ControlValues<3> dx = disturbed(ControlValues<3>::Zero(x.rows(), 3), 1., 9);
      // int m nu . n(x + h dx) dS, nu held: the conormal is normal to the edge and to n, and points out of the surface.
      PieceMoment<degree>              weight;
      std::array<Point<3>, degree + 1> conormal;
      for (int q = 0; q <= degree; ++q)
        {
          const auto &point = piece.quadrature[q];
          Point<3>    a[2]  = {Point<3>::Zero(), Point<3>::Zero()};
          for (Eigen::Index A = 0; A < x.rows(); ++A)
            {
              a[0] += point.d1[A] * x.row(A).transpose();
              a[1] += point.d2[A] * x.row(A).transpose();
            }
          conormal[q]         = a[1 - piece.normal_direction].cross(normal_at(piece, x, q)).normalized();
          const double inside = conormal[q].dot(a[piece.normal_direction]) * piece.outward;
          conormal[q] *= inside > 0. ? 1. : -1.;
          weight[q] = moment[q] * point.dS;
        }
      const auto f     = edge_moment_force(piece, x, moment);
      const auto check = verify::check_derivative(
          [&](double h) {
            double work = 0.;
            for (int q = 0; q <= degree; ++q)
              work += weight[q] * conormal[q].dot(normal_at<degree>(piece, x + h * dx, q));
            return work;
          },
          flat(f).dot(flat(dx)), 1e-2, 11); // the work itself starts at zero: steps above its rounding
      INFO("order " << check.order << ", defect " << check.smallest_defect);
      CHECK(check.passed());
    }
}

TEMPLATE_LIST_TEST_CASE("Moment at the edges of a plate: its sign and its size", "", Degrees)
{
  constexpr int degree  = TestType::value;
  auto          surface = distorted(shapes::plate<degree, 3>({2., 3.}, {4, 4}), .05);
  {
    // Flat again, with skew parameter lines inside.
    auto patch = surface.patch(0);
    patch.control_points.col(2).setZero();
    surface = {{std::move(patch)}, surface.edges()};
  }
  refine_at_random(surface, 2, 4, 12);
  const double m = .7;
  // n = e_z; the moment vector is n x nu times m and the length of the edge.
  for (const auto &[name, conormal, length] :
       {std::tuple{"left", Point<3>(-1., 0., 0.), 3.}, std::tuple{"right", Point<3>(1., 0., 0.), 3.},
        std::tuple{"bottom", Point<3>(0., -1., 0.), 2.}, std::tuple{"top", Point<3>(0., 1., 0.), 2.}})
    {
      INFO(name);
      const auto [moment, force] = resultants(surface, name, surface.control_points(), m);
      CHECK(force.norm() < 1e-13);
      CHECK((moment - m * length * Point<3>::UnitZ().cross(conormal)).norm() < 1e-13 * length);
      for (const auto &piece : edge_geometry(surface, surface.edge(name).front()))
        {
          const auto values = rows_of(surface.control_points(), piece.points);
          const auto f      = edge_moment_force(piece, values, constant_moment<degree>(m));
          CHECK(f.leftCols(2).norm() < 1e-14);
          // A displacement of the edge itself by -n does positive work, one of its neighbours negative work.
          double edge = 0., neighbours = 0.;
          for (Eigen::Index A = 0; A < f.rows(); ++A)
            (piece.quadrature[0].value[A] > 1e-12 ? edge : neighbours) += f(A, 2);
          CHECK(edge < -.1 * m);
          CHECK(neighbours > .1 * m);
        }
    }
}

TEST_CASE("Moment on curved edges: no force, and the moment of n x nu")
{
  // Cylinder of radius 2 about z from z = 0 to 1, n outward: on the edge z = 1 the conormal is e_z and
  // int n x e_z dS = int (n_y, -n_x) dS = 2 (1, -1).
  auto       surface = quarter_turn<2, 3>(2., 0., 2., 1.);
  const auto n = normal_at(edge_geometry(surface, surface.edge("outer").front()).front(), surface.control_points(), 0);
  const auto sign = n[0] > 0. ? 1. : -1.;
  refine_everywhere(surface, 1);
  refine_everywhere(surface, 2);
  const auto [moment, force] = resultants(surface, "outer", surface.control_points(), .5);
  CHECK(force.norm() < 1e-13);
  // Gauss points on four rational elements of the arc.
  CHECK((moment - sign * .5 * Point<3>(2., -2., 0.)).norm() < 1e-7);
}

TEMPLATE_LIST_TEST_CASE("Edge moments turn with the surface, and change sign with its normal", "", Degrees)
{
  constexpr int degree  = TestType::value;
  const auto    surface = curved_surface<degree>(Shape::distorted);
  const auto    moment  = varying_moment<degree>();
  const auto    Q       = rotation();
  SECTION("rotation")
  {
    for (const auto &piece : one_piece_a_side(curved_surface<degree>(Shape::rational)))
      {
        const auto x =
            disturbed(rows_of(curved_surface<degree>(Shape::rational).control_points(), piece.points), .05, 5);
        ControlValues<3> turned = x * Q.transpose();
        turned.rowwise() += Eigen::RowVector3d(3., -1., 2.);
        const auto f = edge_moment_force(piece, x, moment), g = edge_moment_force(piece, turned, moment);
        CHECK((g - f * Q.transpose()).norm() < 1e-12 * f.norm());
        // With the derivative along a spin w: K (w x x) = w x f.
        const Point<3>   w(.3, -.7, 1.1);
        ControlValues<3> spin = x, expected = f;
        for (Eigen::Index A = 0; A < x.rows(); ++A)
          {
            spin.row(A)     = w.cross(x.row(A).transpose()).transpose();
            expected.row(A) = w.cross(f.row(A).transpose()).transpose();
          }
        CHECK((edge_moment_tangent(piece, x, moment) * flat(spin) - flat(expected)).norm() < 1e-12 * f.norm());
      }
  }
  SECTION("normal")
  {
    const auto other = turned_over(surface, 4, 4);
    const auto total = [&](const Surface<degree, 3> &of) {
      ControlValues<3> sum = ControlValues<3>::Zero(of.n_control_points(), 3);
      for (const auto &[name, sides] : of.edges())
        for (const auto &piece : edge_geometry(of, sides.front()))
          {
            const auto f = edge_moment_force(piece, rows_of(of.control_points(), piece.points),
                                             constant_moment<degree>(name == "top" ? 2. : .5));
            for (std::size_t A = 0; A < piece.points.size(); ++A)
              sum.row(piece.points[A]) += f.row(A);
          }
      return sum;
    };
    const auto f = total(surface), g = total(other);
    const int  n = 4 + degree;
    REQUIRE(f.norm() > .1);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        CHECK((f.row(j * n + i) + g.row(i * n + j)).norm() < 1e-13 * f.norm());
  }
}

TEST_CASE("Control values that do not fit the piece are refused")
{
  const auto surface = shapes::plate<2, 3>({1., 1.}, {1, 1});
  const auto piece   = edge_geometry(surface, surface.edge("left").front()).front();
  const auto x       = ControlValues<3>::Zero(8, 3);
  CHECK_THROWS_AS(edge_moment_force(piece, x, constant_moment<2>(1.)), DimensionMismatch);
  CHECK_THROWS_WITH(edge_moment_tangent(piece, x, constant_moment<2>(1.)), Catch::Contains("9 control points"));
}
