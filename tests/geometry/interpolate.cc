// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/interpolate.h>

using namespace sherd;

namespace
{

/// Polynomial of one degree in u and in v with random coefficients in [-1, 1).
struct Polynomial
{
  Polynomial(int degree, std::mt19937 &random) : coefficients(degree + 1, degree + 1)
  {
    for (double &c : coefficients.reshaped())
      c = test::symmetric(random);
  }

  double operator()(double u, double v) const
  {
    double sum = 0.;
    for (Eigen::Index i = coefficients.rows() - 1; i >= 0; --i)
      {
        double row = 0.;
        for (Eigen::Index j = coefficients.cols() - 1; j >= 0; --j)
          row = row * v + coefficients(i, j);
        sum = sum * u + row;
      }
    return sum;
  }

  Eigen::MatrixXd coefficients;
};

template <int degree>
std::vector<double> open_knots(const std::vector<double> &interior)
{
  std::vector<double> knots(degree + 1, 0.);
  knots.insert(knots.end(), interior.begin(), interior.end());
  knots.insert(knots.end(), degree + 1, 1.);
  return knots;
}

template <int degree, int spacedim, class Exact>
double largest_defect(const Surface<degree, spacedim> &surface, const Exact &exact, unsigned seed)
{
  std::mt19937 random(seed);
  double       largest = 0.;
  for (int k = 0; k < 400; ++k)
    {
      const double u = .5 * (1. + test::symmetric(random)), v = .5 * (1. + test::symmetric(random));
      largest = std::max(largest, (test::position_at(surface.patch(0), u, v) - exact(u, v)).norm());
    }
  return largest;
}

template <int degree>
void check_reproduction()
{
  // Spans from .01 to .5, different in u and v.
  const auto       knots_u = open_knots<degree>({.13, .4, .41, .9}), knots_v = open_knots<degree>({.5, .75});
  std::mt19937     random(17);
  const Polynomial x(degree, random), y(degree, random), z(degree, random), bump(degree, random);
  const auto       w = [&](double u, double v) { return 40. + bump(u, v); }; // |bump| < 25

  const auto position = [&](double u, double v) { return Point<3>(x(u, v), y(u, v), z(u, v)); };
  const auto plain    = interpolate<degree, 3>(knots_u, knots_v, position);
  CHECK(largest_defect(plain, position, 1) < 1e-13);
  CHECK((plain.weights().array() == 1.).all());
  CHECK(plain.n_elements() == 15);

  const auto homogeneous = [&](double u, double v) { return Eigen::Vector4d(x(u, v), y(u, v), z(u, v), w(u, v)); };
  const auto rational    = interpolate<degree, 3>(knots_u, knots_v, homogeneous);
  CHECK(largest_defect(
            rational, [&](double u, double v) -> Point<3> { return position(u, v) / w(u, v); }, 2) < 1e-14);
  CHECK((rational.weights().array() != rational.weights()[0]).any());

  const auto plane =
      interpolate<degree, 2>(knots_u, knots_v, [&](double u, double v) { return Point<2>(x(u, v), y(u, v)); });
  CHECK(largest_defect(
            plane, [&](double u, double v) { return Point<2>(x(u, v), y(u, v)); }, 3) < 1e-13);
}

template <int degree>
double order_of_interpolation()
{
  const auto map = [](double u, double v) {
    return Point<3>(std::sin(3. * u + v), std::exp(u * v), std::cos(2. * v - u));
  };
  double error[2];
  for (const int level : {0, 1})
    {
      std::vector<double> interior;
      for (int i = 1; i < 8 << level; ++i)
        interior.push_back(double(i) / (8 << level));
      const auto knots = open_knots<degree>(interior);
      error[level]     = largest_defect(interpolate<degree, 3>(knots, knots, map), map, 4);
    }
  return std::log2(error[0] / error[1]);
}

} // namespace

TEST_CASE("Interpolation reproduces polynomial and rational maps on non-uniform knots")
{
  check_reproduction<2>();
  check_reproduction<3>();
  check_reproduction<4>();
}

TEST_CASE("Interpolation of a smooth map has order degree + 1")
{
  // The maximum over sampled points of both levels wobbles a little.
  CHECK(order_of_interpolation<2>() > 2.8);
  CHECK(order_of_interpolation<3>() > 3.8);
  CHECK(order_of_interpolation<4>() > 4.8);
}

TEST_CASE("A kink on a knot of full multiplicity is reproduced")
{
  const auto knots   = open_knots<2>({.3, .3, .8});
  const auto map     = [](double u, double v) { return Point<3>(u, v, std::abs(u - .3) * (1. + v)); };
  const auto surface = interpolate<2, 3>(knots, knots, map);
  CHECK(largest_defect(surface, map, 5) < 1e-14);
}

TEST_CASE("Equal weights stay one number, also under refinement")
{
  const auto knots   = open_knots<3>({.25, .7});
  auto       surface = interpolate<3, 3>(knots, knots,
                                   [](double u, double v) { return Eigen::Vector4d(3. * u, 3. * v, 3. * u * v, 3.); });
  CHECK((surface.weights().array() == 3.).all());
  test::refine_at_random(surface, 2, 2, 9);
  CHECK((surface.weights().array() == 3.).all());
  CHECK(largest_defect(
            surface, [](double u, double v) { return Point<3>(u, v, u * v); }, 6) < 1e-14);
}

TEST_CASE("Sides depend on the values of the map on them only")
{
  const auto knots = open_knots<3>({.2, .5, .6});
  const auto make  = [&](double inside) {
    return interpolate<3, 3>(knots, knots, [inside](double u, double v) {
      const double bubble = inside * u * (1. - u) * v * (1. - v);
      return Eigen::Vector4d(std::sin(u) + bubble, std::cos(v), bubble, 1. + .3 * std::sin(u + v) + bubble);
    });
  };
  const auto one = make(0.), other = make(1.);
  for (const auto &[name, sides] : one.edges())
    for (const int i : points_along(one, sides.front()))
      {
        CHECK((one.control_points().row(i) - other.control_points().row(i)).norm() < 1e-15);
        CHECK(one.weights()[i] == Approx(other.weights()[i]).epsilon(1e-15));
      }
}

TEST_CASE("Interpolation names the sides and refuses what does not fit")
{
  const auto knots = open_knots<2>({.5});
  const auto flat  = [](double u, double v) { return Point<2>(u, v); };
  const auto named = interpolate<2, 2>(knots, knots, flat, name_sides("west", "east", "south", "north"));
  CHECK(named.edge("east").front().side == Side::u_max);
  CHECK(named.edge("south").front().side == Side::v_min);

  CHECK_THROWS_AS((interpolate<2, 2>({0., 1., 2., 3., 4.}, knots, flat)), InvalidParameter);
  CHECK_THROWS_AS((interpolate<2, 2>(knots, knots, [](double u, double v) { return Point<3>(u, v, u - .5); })),
                  InvalidParameter);
  CHECK_THROWS_AS((interpolation_coefficients<2>(knots, knots, Eigen::MatrixXd::Zero(15, 1))), DimensionMismatch);
}
