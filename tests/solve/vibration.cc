// label: verification
#include <catch2/catch.hpp>

#include <algorithm>

#include <sherd/solve/modal_analysis.h>

#include "koiter_body.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

constexpr double thickness = .01; // of the plate's width: stretching modes are far above those of bending

/// Young's modulus at which the flexural rigidity is one.
double modulus(double nu)
{
  return 12. * (1. - nu * nu) / (thickness * thickness * thickness);
}

Supports simply_supported()
{
  Supports supports;
  for (const auto *edge : {"left", "right", "bottom", "top"})
    supports.fix(edge);
  return supports;
}

Supports clamped()
{
  Supports supports;
  for (const auto *edge : {"left", "right", "bottom", "top"})
    supports.clamp(edge);
  return supports;
}

template <class Model>
std::vector<double> frequencies(const Model &model, int n, const Supports &supports, const EigenSettings &settings)
{
  constexpr int         degree = Model::degree;
  const Environment     env(MPI_COMM_WORLD);
  const auto            plate = shapes::plate<degree, 3>({1., 1.}, {n, n});
  ShellSpace<degree, 3> space(env, plate);
  std::vector<double>   omega;
  for (const auto &mode : vibration_modes(model, space, supports, State<degree, 3>(space), settings))
    omega.push_back(mode.omega);
  return omega;
}

/// Frequencies of a square plate of width, rigidity and mass one.
template <int degree>
std::vector<double> plate(int n, const Supports &supports, const EigenSettings &settings, double nu = .3)
{
  return frequencies(KoiterBody<degree>::make_model(modulus(nu), nu, thickness), n, supports, settings);
}

/// omega / (pi^2 (m^2 + n^2)) - 1
double error(double omega, int m, int n)
{
  return omega / (M_PI * M_PI * (m * m + n * n)) - 1.;
}

} // namespace

// Theory J.3.
TEST_CASE("Simply supported plate: the first frequency has the errors of the theory", "[vibration]")
{
  const auto first = [](const std::vector<double> &omega) { return error(omega[0], 1, 1); };
  CHECK(first(plate<2>(8, simply_supported(), {.n_modes = 1})) == Approx(3.2e-3).margin(.05e-3));
  CHECK(first(plate<2>(16, simply_supported(), {.n_modes = 1})) == Approx(8.1e-4).margin(.05e-4));
  CHECK(first(plate<3>(8, simply_supported(), {.n_modes = 1})) == Approx(8.6e-6).margin(.05e-6));
  // Frequencies are Rayleigh quotients: never below, but for rounding, which the condition number of K enlarges to
  // 1e-9.
  const double fourth = first(plate<4>(8, simply_supported(), {.n_modes = 1}));
  CHECK(fourth > -1e-8);
  CHECK(fourth < 1e-7);
}

// The error of a frequency is the square of that of its mode in energy: order 2 (p - 1).
TEST_CASE("Simply supported plate: frequencies converge with order 2 (p - 1), double ones come twice", "[vibration]")
{
  const EigenSettings six{.n_modes = 6};
  const auto          check = [](const std::vector<double> &coarse, const std::vector<double> &fine, double order) {
    const std::vector<std::array<int, 2>> mn{{1, 1}, {1, 2}, {2, 1}, {2, 2}, {1, 3}, {3, 1}};
    for (std::size_t k = 0; k < mn.size(); ++k)
      {
        const auto [m, n] = mn[k];
        INFO("mode " << m << ", " << n << ": " << coarse[k] << ", " << fine[k]);
        CHECK(error(fine[k], m, n) > 0.);
        CHECK(std::log2(error(coarse[k], m, n) / error(fine[k], m, n)) == Approx(order + .2).margin(.25));
      }
    for (const auto &omega : {coarse, fine})
      for (const int k : {1, 4})
        CHECK(omega[k + 1] == Approx(omega[k]).epsilon(1e-9));
  };
  check(plate<2>(8, simply_supported(), six), plate<2>(16, simply_supported(), six), 2.);
  check(plate<3>(8, simply_supported(), six), plate<3>(16, simply_supported(), six), 4.);
}

// The Gauss curvature of a deflection that vanishes along a straight edge integrates to zero, also of a discrete one.
// So Canham's bending, which lacks that term, and Koiter's differ in nothing here, and with clamped edges Poisson's
// ratio has no influence.
TEST_CASE("Supported plates: the Poisson effect of bending has no influence", "[vibration]")
{
  const EigenSettings six{.n_modes = 6};
  const auto          same = [](const std::vector<double> &a, const std::vector<double> &b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      CHECK(a[k] == Approx(b[k]).epsilon(1e-7));
  };
  const auto laws = material::neo_hooke_canham_shell(modulus(.3), .3, thickness);
  CHECK(laws.bending.stiffness() == Approx(1.));
  const models::Shell canham(split::SurfaceStretch(laws.membrane, laws.bending, {.thickness = thickness}),
                             degradation::Cubic(1e-4), {}, 1., 1., 1.);
  same(frequencies(canham, 12, simply_supported(), six), plate<2>(12, simply_supported(), six));
  same(plate<3>(8, clamped(), six, 0.), plate<3>(8, clamped(), six, .3));
}

// 35.985 for every Poisson's ratio (A. W. Leissa, Vibration of plates, NASA SP-160, 1969).
TEST_CASE("Clamped plate: first frequency", "[vibration]")
{
  CHECK(plate<4>(8, clamped(), {.n_modes = 1})[0] == Approx(35.985).margin(.001));
  CHECK(plate<3>(16, clamped(), {.n_modes = 1}, 0.)[0] == Approx(35.985).margin(.001));
}

// A body without supports: shift and invert needs a shift below its six rigid modes. Their squares are zero but for
// rounding, which is that of a membrane 12 / T^2 = 1.2e5 times as stiff as the bending.
TEST_CASE("Free plate: six rigid modes, then that of a twisted square", "[vibration]")
{
  const auto omega = plate<4>(8, {}, {.n_modes = 9, .shift = -100.});
  for (int k = 0; k < 6; ++k)
    CHECK(omega[k] * omega[k] == Approx(0.).margin(1e-4));
  CHECK(omega[6] == Approx(13.468).margin(.001));
  CHECK(omega[7] == Approx(19.596).margin(.001));
  CHECK(omega[8] == Approx(24.270).margin(.002));
}
