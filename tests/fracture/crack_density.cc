// label: verification
#include <catch2/catch.hpp>

#include <sherd/fracture/crack_density/at1.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/crack_density/second_order.h>
#include <sherd/base/exceptions.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/fracture/homogeneous.h>
#include <sherd/verify/crack_density.h>

#include "fracture/phase_field_1d.h"

#include <array>
#include <cmath>
#include <limits>

using namespace sherd;
using crack_density::AT1, crack_density::FourthOrder, crack_density::SecondOrder;
using namespace phase_field_1d;

namespace
{
constexpr double l0 = .3;

/// Energy / Gc of phi = 0 at x = 0, on elements of h l0 that span 10 l0 on each side; shift is the distance of x = 0
/// from a mesh line, in elements.
template <class Density>
double point_energy(const int degree, const double h, const double shift = 0.)
{
  const int          n     = 2 * static_cast<int>(std::round(10. / h));
  const double       start = -(.5 * n + shift) * h * l0;
  const SplineSpace  space(degree, start, start + n * h * l0, n);
  const SplineValues crack               = space.values(0., n / 2);
  Eigen::MatrixXd    B                   = Eigen::MatrixXd::Zero(1, space.n_functions());
  B.block(0, crack.first, 1, degree + 1) = crack.N.row(0);
  return constrained_energy(stiffness(space, Density{}, l0), B, Eigen::VectorXd::Ones(1), l0);
}

/// Energy / Gc of phi = 0 on one whole element.
template <class Density>
double element_energy(const int degree, const double h)
{
  const int         n      = 2 * static_cast<int>(std::ceil(20. / h)) + 1;
  const double      length = n * h * l0;
  const SplineSpace space(degree, -.5 * length, .5 * length, n);
  Eigen::MatrixXd   B = Eigen::MatrixXd::Zero(degree + 1, space.n_functions());
  B.block(0, n / 2, degree + 1, degree + 1).setIdentity();
  return constrained_energy(stiffness(space, Density{}, l0), B, Eigen::VectorXd::Ones(degree + 1), l0);
}

/// Energy / Gc of a crack in the middle of a strip of half-width a l0: twice that of its right half, where the crack
/// fixes phi = 0 and, for the smooth profile of order 4, phi' = 0.
template <class Density>
double strip_energy(const double a)
{
  const SplineSpace space(3, 0., a * l0, 200);
  const int         n_fixed = Density::order == 4 ? 2 : 1;
  Eigen::MatrixXd   B       = Eigen::MatrixXd::Zero(n_fixed, space.n_functions());
  B.leftCols(n_fixed).setIdentity();
  return 2. * constrained_energy(stiffness(space, Density{}, l0), B, Eigen::VectorXd::Ones(n_fixed), l0);
}

const std::array<double, 5> mesh_sizes{2., 1., .5, .25, .125};

/// Compares with printed values, to the digits printed.
template <class Density>
void check_column(const int degree, const std::array<double, 5> &expected, const double digits)
{
  for (std::size_t i = 0; i < mesh_sizes.size(); ++i)
    {
      INFO("degree " << degree << ", h / l0 = " << mesh_sizes[i]);
      CHECK(std::abs(point_energy<Density>(degree, mesh_sizes[i]) - expected[i]) < 1.02 * digits);
    }
}
} // namespace

TEMPLATE_TEST_CASE("crack density: the optimal profile costs exactly Gc", "", FourthOrder, SecondOrder, AT1)
{
  const auto report = verify::crack_density(TestType{});

  INFO(report);
  CHECK(report.passed());
}

TEST_CASE("crack density: AT1 costs Gc for any width of its bound, and tends to theory C.1")
{
  for (const double width : {.1, .03, 1e-3, 1e-4})
    {
      const auto report = verify::crack_density(AT1(width));
      INFO("width " << width << '\n' << report);
      CHECK(report.passed());
    }
  const AT1 sharp(1e-8);
  CHECK(sharp.c1(l0) == Approx(1.5 * l0 * l0).epsilon(1e-7));
  CHECK(sharp.c2(l0) == 0.);
  for (const double r : {0., .3, 1., 1.9})
    CHECK(sharp.profile(r) == Approx(r - .25 * r * r).epsilon(1e-7));
  CHECK(sharp.profile(2.1) == Approx(1.).epsilon(1e-8));
  for (const double d : {1e-3, .1, 1.})
    CHECK(sharp.local(1. - d) == Approx(1.5 * d).epsilon(1e-5));
  for (const double bad : {0., -1e-3, .11, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(AT1(bad), InvalidParameter);
}

TEST_CASE("crack density: AT1 keeps its bound without an active set, and Newton's method converges in a few iterations")
{
  // A strip under a driving energy that breaks it in the middle, from the intact state.
  const degradation::Quadratic g;
  constexpr double             Gc = .7;
  for (const double width : {1e-2, 1e-3})
    {
      const AT1         density(width);
      const SplineSpace space(2, -4. * l0, 4.05 * l0, 64);
      const double      H      = homogeneous_history(g, density, 1e-3, Gc, l0);
      const auto        strip  = [&](const double x) { return std::abs(x) < .26 * l0 ? H : 0.; };
      const auto        intact = [](const double) { return 1.; };

      const Solution found = solve(space, density, g, Gc, l0, strip, intact);

      INFO(width << ": " << found.iterations << " iterations, phi " << found.min_phi << " to " << found.max_phi
                 << ", energy " << found.energy);
      CHECK(found.iterations < (width > 5e-3 ? 12 : 22));
      CHECK(found.max_phi < 1. + 2. * width);
      CHECK(found.min_phi > -.02);
      CHECK(found.energy > 1.); // the strip is broken all across: at most 3/8 of its width more
      CHECK(found.energy < 1. + 3. / 8. * .52);

      // Below the elastic limit nothing is damaged by more than the width.
      const auto   below   = [&](const double) { return .9 * 3. * Gc / (16. * l0); };
      const double elastic = solve(space, density, g, Gc, l0, below, intact).min_phi;
      CHECK(elastic > 1. - width);
    }
}

TEST_CASE("crack density: coefficients of theory C.1")
{
  CHECK(FourthOrder{}.c1(l0) == Approx(2. * l0 * l0).epsilon(1e-15));
  CHECK(FourthOrder{}.c2(l0) == Approx(std::pow(l0, 4)).epsilon(1e-15));
  CHECK(SecondOrder{}.c1(l0) == Approx(4. * l0 * l0).epsilon(1e-15));
  CHECK(SecondOrder{}.c2(l0) == 0.);
}

TEST_CASE("crack density: profiles keep their digits near the crack and reach 99 % at the printed distance")
{
  // 1 - (1 + r) exp(-r) = r^2/2 - r^3/3 + ..., 1 - exp(-r/2) = r/2 - ...
  CHECK(FourthOrder{}.profile(1e-4) == Approx(.5e-8 * (1. - 2e-4 / 3)).epsilon(1e-7));
  CHECK(SecondOrder{}.profile(1e-8) == Approx(.5e-8).epsilon(1e-8));
  CHECK(FourthOrder{}.profile(6.64) == Approx(.99).epsilon(1e-4));
  CHECK(SecondOrder{}.profile(9.21) == Approx(.99).epsilon(1e-4));
}

TEST_CASE("crack density: energy at one point sums the three terms")
{
  CHECK(crack_energy(FourthOrder{}, 3., .5, .4, 2., 7.) ==
        Approx(3. / 2. * (.36 + 2. * .25 * 2. + .0625 * 49.)).epsilon(1e-15));
}

TEST_CASE("crack density: discrete energies of a crack on a mesh line, fourth order")
{
  check_column<FourthOrder>(2, {1.1920, 1.0509, 1.0129, 1.0033, 1.0008}, 5e-5);
  check_column<FourthOrder>(3, {1.0302, 1.0024, 1.00015, 1.00001, 1.00000}, 5e-5);
}

TEST_CASE("crack density: discrete energies of a crack on a mesh line, second order")
{
  check_column<SecondOrder>(1, {1.0408, 1.0103, 1.0025, 1.0006, 1.0001}, 5e-5);
  check_column<SecondOrder>(2, {1.3620, 1.1638, 1.0771, 1.0373, 1.0183}, 5e-5);
  check_column<SecondOrder>(3, {1.1771, 1.0812, 1.0389, 1.0190, 1.0094}, 5e-5);
}

TEST_CASE("crack density: the excess energy falls with h^2 for order 4 and, by the kink, with h for order 2")
{
  const auto order = [](const double coarse, const double fine) { return std::log2((coarse - 1.) / (fine - 1.)); };

  CHECK(order(point_energy<FourthOrder>(2, .25), point_energy<FourthOrder>(2, .125)) == Approx(2.).margin(.05));
  CHECK(order(point_energy<SecondOrder>(2, .25), point_energy<SecondOrder>(2, .125)) == Approx(1.).margin(.05));
}

TEST_CASE(
    "crack density: a discrete crack costs more than Gc wherever it lies, quadratic splines least inside an element")
{
  for (const double h : {1., .5, .25})
    {
      CHECK(point_energy<FourthOrder>(2, h, .5) > 1.);
      CHECK(point_energy<FourthOrder>(2, h, .5) < point_energy<FourthOrder>(2, h, .25));
      CHECK(point_energy<FourthOrder>(2, h, .25) < point_energy<FourthOrder>(2, h, 0.));
    }
}

TEST_CASE("crack density: a broken element adds about h / (4 l0)")
{
  CHECK(std::abs(element_energy<FourthOrder>(2, .5) - 1.1379) < 5.1e-5);
  CHECK(std::abs(element_energy<FourthOrder>(2, .25) - 1.0658) < 5.1e-5);
}

TEST_CASE("crack density: energy of a crack in a finite strip")
{
  for (const double a : {1., 3., 5., 8.})
    CHECK(std::abs(strip_energy<SecondOrder>(a) - std::tanh(.5 * a)) < 1e-9);
  CHECK(std::abs(strip_energy<FourthOrder>(3.) - .95382) < 5.1e-6);
  CHECK(std::abs(strip_energy<FourthOrder>(5.) - .99804) < 5.1e-6);
  CHECK(std::abs(strip_energy<FourthOrder>(8.) - .999989) < 5.1e-7);
}
