// label: unit
#include <catch2/catch.hpp>

#include <forms/loaded_surfaces.h>
#include <sherd/forms/pressure.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// All that the forms of loads know of a model.
template <int degree_>
struct Shell
{
  static constexpr int degree = degree_, spacedim = 3, n_fields = 4;
};

/// Unknowns of one element by control point, y[A * 4 + c]: position x, y, z and phase.
template <int degree>
class LoadedElement
{
public:
  using Model              = Shell<degree>;
  static constexpr int n_b = ElementFields<Model>::n_b, n_q = ElementData<Model>::n_q;

  LoadedElement(const Surface<degree, 3> &surface, int element)
  {
    data.geometry = element_geometry(surface, element);
    X             = rows_of(surface.control_points(), data.geometry.points);
  }

  int n() const { return static_cast<int>(X.rows()); }

  /// x = X + random, phase @p phi + random.
  Eigen::VectorXd deformed(double disorder, double phi, unsigned seed) const
  {
    std::mt19937    random(seed);
    Eigen::VectorXd y(4 * n());
    for (int A = 0; A < n(); ++A)
      {
        for (int d = 0; d < 3; ++d)
          y[4 * A + d] = X(A, d) + disorder * symmetric(random);
        y[4 * A + 3] = phi + disorder * symmetric(random);
      }
    return y;
  }

  ElementFields<Model> fields(const Eigen::VectorXd &y) const
  {
    ElementFields<Model> f{};
    for (int A = 0; A < n(); ++A)
      for (int b = 0; b < n_b; ++b)
        {
          const double E = data.geometry.extraction(A, b);
          for (int d = 0; d < 3; ++d)
            f.position[d][b] += E * y[4 * A + d];
          f.phase[b] += E * y[4 * A + 3];
        }
    return f;
  }

  Eigen::VectorXd force(const Eigen::VectorXd &y, const ElementPressure<Model> &pressure) const
  {
    ElementVector<Model> f{};
    add_pressure(data, fields(y), pressure, f);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(4 * n());
    for (int A = 0; A < n(); ++A)
      for (int c = 0; c < 4; ++c)
        for (int b = 0; b < n_b; ++b)
          result[4 * A + c] += data.geometry.extraction(A, b) * f.value[c][b];
    return result;
  }

  Eigen::MatrixXd stiffness(const Eigen::VectorXd &y, const ElementPressure<Model> &pressure) const
  {
    ElementMatrix<Model> k{};
    add_pressure_tangent(data, fields(y), pressure, k);
    const Eigen::MatrixXd &E = data.geometry.extraction;
    Eigen::MatrixXd        result(4 * n(), 4 * n());
    for (int c = 0; c < 4; ++c)
      for (int d = 0; d < 4; ++d)
        {
          Eigen::MatrixXd block(n_b, n_b);
          for (int a = 0; a < n_b; ++a)
            for (int b = 0; b < n_b; ++b)
              block(a, b) = k.value[c * n_b + a][d * n_b + b];
          block = E * block * E.transpose();
          for (int A = 0; A < n(); ++A)
            for (int B = 0; B < n(); ++B)
              result(4 * A + c, 4 * B + d) = block(A, B);
        }
    return result;
  }

  ElementData<Model> data{};
  ControlValues<3>   X;
};

template <int degree>
LoadedElement<degree> sample_element(Shape shape)
{
  const auto surface = curved_surface<degree>(shape);
  return {surface, shape == Shape::overloaded ? most_loaded_element(surface) : surface.n_elements() / 2};
}

template <int degree>
ElementPressure<Shell<degree>> varying_pressure(double constant, double by_phase)
{
  ElementPressure<Shell<degree>> p;
  for (int q = 0; q < p.n_q; ++q)
    {
      p.constant[q] = constant * (1. + .3 * std::sin(1. + q));
      p.by_phase[q] = by_phase * (1. + .3 * std::cos(2. * q));
    }
  return p;
}

template <int degree>
ElementPressure<Shell<degree>> constant_pressure(double p0)
{
  ElementPressure<Shell<degree>> p{};
  p.constant.fill(p0);
  return p;
}

/// Forces of p0 = 1 on all control points of a surface in the position x, shape=(n_control_points, 3).
template <int degree>
ControlValues<3> unit_pressure_forces(const Surface<degree, 3> &surface, const ControlValues<3> &x)
{
  ControlValues<3> sum = ControlValues<3>::Zero(x.rows(), 3);
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const LoadedElement<degree> element(surface, e);
      const auto                 &points = element.data.geometry.points;
      Eigen::VectorXd             y      = Eigen::VectorXd::Ones(4 * element.n());
      for (int A = 0; A < element.n(); ++A)
        y.segment<3>(4 * A) = x.row(points[A]).transpose();
      const auto f = element.force(y, constant_pressure<degree>(1.));
      for (int A = 0; A < element.n(); ++A)
        sum.row(points[A]) += f.template segment<3>(4 * A).transpose();
    }
  return sum;
}

/// int n da of a patch from its boundary: 1/2 closed int x x dx, in the sense of rotation about n.
template <int degree>
Point<3> vector_area(const Surface<degree, 3> &surface, const ControlValues<3> &x)
{
  Point<3> sum = Point<3>::Zero();
  for (const Side side : {Side::u_min, Side::u_max, Side::v_min, Side::v_max})
    for (const auto &piece : edge_geometry(surface, Edge{0, side}))
      for (int q = 0; q <= degree; ++q)
        {
          const auto &point = piece.quadrature[q];
          Point<3>    at = Point<3>::Zero(), tangent = at;
          for (std::size_t A = 0; A < piece.points.size(); ++A)
            {
              const Point<3> control = x.row(piece.points[A]).transpose();
              at += point.value[A] * control;
              tangent += (piece.normal_direction == 0 ? point.d2[A] : point.d1[A]) * control;
            }
          // Round the parameter square: along +v at u_max, -v at u_min, +u at v_min, -u at v_max.
          const double sense = piece.normal_direction == 0 ? piece.outward : -piece.outward;
          sum += .5 * sense * gauss_legendre(degree + 1).weights[q] * at.cross(tangent);
        }
  return sum;
}

/// The octant of a sphere with the normal outward: longitude along u, latitude along v, a pole at v = 1.
template <int degree>
Surface<degree, 3> sphere_octant(double radius)
{
  const double                 w = std::sqrt(.5);
  std::vector<Eigen::Vector3d> arc{{1., 0., 1.}, {w, w, w}, {0., 1., 1.}}; // (w x, w y, w)
  while (static_cast<int>(arc.size()) <= degree)
    arc = elevate(arc);
  constexpr int    n = degree + 1;
  Patch<degree, 3> patch{LRBasis<degree>(shapes::uniform_knots<degree>(1), shapes::uniform_knots<degree>(1)),
                         ControlValues<3>(n * n, 3), Eigen::VectorXd(n * n)};
  for (int j = 0, k = 0; j < n; ++j)
    for (int i = 0; i < n; ++i, ++k)
      {
        const double across = arc[j][0] / arc[j][2];
        patch.control_points.row(k) << across * arc[i][0] / arc[i][2], across * arc[i][1] / arc[i][2],
            arc[j][1] / arc[j][2];
        patch.control_points.row(k) *= radius;
        patch.weights[k] = arc[i][2] * arc[j][2];
      }
  return {{std::move(patch)}, {}};
}

/// The six faces of the box [0, 1] x [0, 2] x [0, 3], normals outward, all in the position x -> F x + (shift).
template <int degree>
Surface<degree, 3> box(const Eigen::Matrix3d &F, const Point<3> &shift)
{
  const Point<3>                size(1., 2., 3.);
  std::vector<Patch<degree, 3>> faces;
  for (int d = 0; d < 3; ++d)
    for (const bool far : {false, true})
      {
        // The normal of the parameters (i, j) is e_d for i, j = d+1, d+2, and -e_d for the exchanged ones.
        const int i = (d + (far ? 1 : 2)) % 3, j = (d + (far ? 2 : 1)) % 3;
        auto      patch = shapes::plate<degree, 3>({size[i], size[j]}, {2, 1}).patch(0);
        for (Eigen::Index k = 0; k < patch.control_points.rows(); ++k)
          {
            Point<3> X;
            X[i]                        = patch.control_points(k, 0);
            X[j]                        = patch.control_points(k, 1);
            X[d]                        = far ? size[d] : 0.;
            patch.control_points.row(k) = (F * X + shift).transpose();
          }
        faces.push_back(std::move(patch));
      }
  return {std::move(faces), {}};
}

using Degrees = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

} // namespace

TEMPLATE_LIST_TEST_CASE("The load stiffness is the derivative of the pressure", "", Degrees)
{
  constexpr int degree  = TestType::value;
  const auto    shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const auto    element = sample_element<degree>(shape);
  if (shape == Shape::overloaded)
    REQUIRE(element.n() > (degree + 1) * (degree + 1));
  // Phases away from zero all over the path of the difference quotients: released in part, and closed.
  const double    phi       = GENERATE(.6, -.5);
  const auto      y         = element.deformed(.06, phi, 5);
  const auto      pressure  = varying_pressure<degree>(1.3, -.7);
  const auto      K         = element.stiffness(y, pressure);
  Eigen::VectorXd direction = element.deformed(1., 0., 6);
  for (int A = 0; A < element.n(); ++A)
    direction.segment<3>(4 * A) -= element.X.row(A).transpose();
  const auto check =
      verify::check_derivative([&](double h) -> Eigen::VectorXd { return -element.force(y + h * direction, pressure); },
                               Eigen::VectorXd(K * direction));
  INFO("order " << check.order << ", defect " << check.smallest_defect);
  CHECK(check.passed());

  // Along the phase alone the force is linear.
  Eigen::VectorXd phase = direction;
  for (int A = 0; A < element.n(); ++A)
    phase.segment<3>(4 * A).setZero();
  const Eigen::VectorXd slope = -(element.force(y + .01 * phase, pressure) - element.force(y, pressure)) / .01;
  CHECK((slope - K * phase).norm() < 1e-11);
  CHECK((phi < 0. ? slope.norm() == 0. : slope.norm() > 1e-3));
  // The pressure does not drive the phase.
  for (int A = 0; A < element.n(); ++A)
    {
      CHECK(K.row(4 * A + 3).norm() == 0.);
      CHECK(element.force(y, pressure)[4 * A + 3] == 0.);
    }
}

TEMPLATE_LIST_TEST_CASE("Load stiffness with the normal and the contravariant tangents of the theory", "", Degrees)
{
  constexpr int                      degree   = TestType::value;
  const auto                         element  = sample_element<degree>(GENERATE(Shape::overloaded, Shape::rational));
  const auto                         y        = element.deformed(.06, .6, 5);
  const auto                         pressure = varying_pressure<degree>(1.3, -.7);
  const Eigen::MatrixXd             &E        = element.data.geometry.extraction;
  std::optional<ShapeValues<degree>> storage;
  const auto                        &s        = element.data.geometry.shapes(storage);
  Eigen::MatrixXd                    expected = Eigen::MatrixXd::Zero(y.size(), y.size());
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto row = [&](const auto &values) {
        return Eigen::VectorXd(E * Eigen::Map<const Eigen::VectorXd>(values.data(), s.n_functions));
      };
      const Eigen::VectorXd       N = row(s.value[q]), N1 = row(s.d1[q]), N2 = row(s.d2[q]);
      Eigen::Matrix<double, 3, 2> a   = Eigen::Matrix<double, 3, 2>::Zero();
      double                      phi = 0.;
      for (int A = 0; A < element.n(); ++A)
        {
          const Point<3> x = y.segment(4 * A, 3);
          a += x * Eigen::RowVector2d(N1[A], N2[A]);
          phi += N[A] * y[4 * A + 3];
        }
      const Eigen::Matrix<double, 3, 2> dual   = a * (a.transpose() * a).inverse();
      const Point<3>                    m      = a.col(0).cross(a.col(1));
      const Point<3>                    normal = m.normalized();
      const double                      da     = m.norm() * BernsteinTable<degree>::get().weights[q];
      const double                      p      = pressure.constant[q] + pressure.by_phase[q] * phi;
      for (int A = 0; A < element.n(); ++A)
        for (int B = 0; B < element.n(); ++B)
          {
            for (int i = 0; i < 2; ++i)
              expected.block<3, 3>(4 * A, 4 * B) -=
                  da * p * N[A] * (normal * dual.col(i).transpose() - dual.col(i) * normal.transpose()) *
                  (i == 0 ? N1[B] : N2[B]);
            expected.block<3, 1>(4 * A, 4 * B + 3) -= da * pressure.by_phase[q] * N[A] * N[B] * normal;
          }
    }
  CHECK((element.stiffness(y, pressure) - expected).norm() < 1e-13 * expected.norm());
}

TEMPLATE_LIST_TEST_CASE("Forms of pressure add to what they are given", "", Degrees)
{
  constexpr int degree          = TestType::value;
  using Model                   = Shell<degree>;
  const auto           element  = sample_element<degree>(Shape::distorted);
  const auto           fields   = element.fields(element.deformed(.06, .6, 5));
  const auto           pressure = varying_pressure<degree>(1.3, -.7);
  ElementVector<Model> f{}, g;
  ElementMatrix<Model> k{}, l;
  add_pressure(element.data, fields, pressure, f);
  add_pressure_tangent(element.data, fields, pressure, k);
  for (auto &row : g.value)
    for (auto &value : row)
      value = 2.;
  for (int i = 0; i < l.size; ++i)
    for (int j = 0; j < l.stride; ++j)
      l.value[i][j] = j < l.size ? 3. : 0.;
  add_pressure(element.data, fields, pressure, g);
  add_pressure_tangent(element.data, fields, pressure, l);
  double wrong = 0.;
  for (int c = 0; c < 4; ++c)
    for (int b = 0; b < f.n_b; ++b)
      wrong = std::max(wrong, std::abs(g.value[c][b] - f.value[c][b] - 2.));
  for (int i = 0; i < l.size; ++i)
    for (int j = 0; j < l.stride; ++j)
      wrong = std::max(wrong, std::abs(l.value[i][j] - k.value[i][j] - (j < l.size ? 3. : 0.)));
  CHECK(wrong < 1e-14);
}

TEMPLATE_LIST_TEST_CASE("A phase of zero or less lets all of the pressure out", "", Degrees)
{
  constexpr int degree  = TestType::value;
  const auto    element = sample_element<degree>(Shape::rational);
  auto          y       = element.deformed(.06, -.4, 5);
  const auto    release = varying_pressure<degree>(0., 2.);
  CHECK(element.force(y, release).norm() == 0.);
  CHECK(element.stiffness(y, release).norm() == 0.);
  for (int A = 0; A < element.n(); ++A)
    y[4 * A + 3] = 0.;
  CHECK(element.force(y, release).norm() == 0.);
  CHECK(element.stiffness(y, release).norm() == 0.);
  // An intact shell carries it as any other pressure, one of phase 1/2 carries half.
  for (const double phi : {1., .5})
    {
      for (int A = 0; A < element.n(); ++A)
        y[4 * A + 3] = phi;
      const auto f = element.force(y, release), g = element.force(y, varying_pressure<degree>(2., 0.));
      REQUIRE(g.norm() > .1);
      ElementPressure<Shell<degree>> kept{release.by_phase, {}};
      CHECK((f - phi * element.force(y, kept)).norm() < 1e-13 * f.norm());
    }
}

TEST_CASE("Pressure on a flat plate is p times area along the normal")
{
  auto surface = distorted(shapes::plate<2, 3>({2., 3.}, {4, 4}), .05);
  refine_at_random(surface, 2, 4, 12);
  auto flat = surface.control_points();
  flat.col(2).setZero();
  const auto f = unit_pressure_forces(surface, flat);
  CHECK((f.colwise().sum() - Eigen::RowVector3d(0., 0., 6.)).norm() < 1e-13);
  CHECK(f.leftCols(2).norm() < 1e-14);
}

TEMPLATE_LIST_TEST_CASE("Resultant pressure of a bulged sheet is that of its boundary", "", Degrees)
{
  constexpr int  degree  = TestType::value;
  const auto     surface = curved_surface<degree>(Shape::overloaded);
  const auto     x       = disturbed(surface.control_points(), .05, 5);
  const Point<3> force   = unit_pressure_forces(surface, x).colwise().sum().transpose();
  // All polynomials that the rules integrate exactly.
  CHECK((force - vector_area(surface, x)).norm() < 1e-13 * 16.);
}

TEMPLATE_LIST_TEST_CASE("Pressure on a sphere", "", Degrees)
{
  constexpr int degree = TestType::value;
  auto          octant = sphere_octant<degree>(2.);
  double        wrong[3];
  for (int level = 0; level < 3; ++level)
    {
      refine_everywhere(octant, level + 1);
      const auto x = octant.control_points();
      const auto f = unit_pressure_forces(octant, x);
      // Each projection of the octant is a quarter of a disc; f . x is r times the area.
      const Point<3> force = f.colwise().sum().transpose();
      wrong[level]         = (force / M_PI - Point<3>(1., 1., 1.)).norm();
      CHECK(f.cwiseProduct(x).sum() == Approx(2. * 2. * M_PI).epsilon(level == 2 ? 1e-7 : 1e-2));
    }
  CHECK(wrong[2] < 1e-7);
  CHECK(std::log2(wrong[1] / wrong[2]) > 5.);
}

TEMPLATE_LIST_TEST_CASE("Pressure in a closed box has no resultant and expands its volume", "", Degrees)
{
  constexpr int   degree = TestType::value;
  Eigen::Matrix3d F;
  F << 1.1, .2, -.1, .05, .9, .3, -.2, .1, 1.2;
  const auto surface = box<degree>(F, {1., -2., 3.});
  const auto x       = surface.control_points();
  const auto f       = unit_pressure_forces(surface, x);
  CHECK(f.colwise().sum().norm() < 1e-13);
  Point<3> moment = Point<3>::Zero();
  for (Eigen::Index A = 0; A < x.rows(); ++A)
    moment += x.row(A).transpose().cross(f.row(A).transpose());
  CHECK(moment.norm() < 1e-12);
  CHECK(f.cwiseProduct(x).sum() == Approx(3. * 6. * F.determinant()).epsilon(1e-13));
}

TEMPLATE_LIST_TEST_CASE("Pressure turns with the surface, and its sign with the normal", "", Degrees)
{
  constexpr int degree = TestType::value;
  SECTION("rotation")
  {
    const auto       surface = curved_surface<degree>(GENERATE(Shape::overloaded, Shape::rational));
    const auto       x       = disturbed(surface.control_points(), .05, 5);
    const auto       Q       = rotation();
    ControlValues<3> turned  = x * Q.transpose();
    turned.rowwise() += Eigen::RowVector3d(3., -1., 2.);
    const auto f = unit_pressure_forces(surface, x), g = unit_pressure_forces(surface, turned);
    CHECK((g - f * Q.transpose()).norm() < 1e-13 * f.norm());
  }
  SECTION("normal")
  {
    const auto surface = curved_surface<degree>(Shape::distorted);
    const auto other   = turned_over(surface, 4, 4);
    const auto f       = unit_pressure_forces(surface, surface.control_points());
    const auto g       = unit_pressure_forces(other, other.control_points());
    const int  n       = 4 + degree;
    REQUIRE(f.norm() > .1);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        CHECK((f.row(j * n + i) + g.row(i * n + j)).norm() < 1e-14 * f.norm());
  }
}

TEST_CASE("Declared pressures are summed at the quadrature points")
{
  const auto element = sample_element<2>(Shape::rational);
  Loads<3>   loads;
  CHECK(element_pressure(element.data, loads, 2.).constant == std::array<double, 9>{});
  loads.pressure([](const Point<3> &X, double t) { return X[0] * t; }, PressureRelease::none);
  loads.pressure([](const Point<3> &X, double) { return X[2]; }, PressureRelease::by_phase);
  loads.pressure([](const Point<3> &, double t) { return t * t; }, PressureRelease::none);
  const auto p = element_pressure(element.data, loads, 2.);
  for (int q = 0; q < p.n_q; ++q)
    {
      const auto X = element.data.geometry.position(q);
      CHECK(p.constant[q] == Approx(2. * X[0] + 4.).epsilon(1e-14));
      CHECK(p.by_phase[q] == X[2]);
    }
}
