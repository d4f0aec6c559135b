// label: verification
#include <catch2/catch.hpp>

#include <sherd/material/moduli.h>
#include <sherd/material/wave_speeds.h>

#include <cmath>
#include <limits>

using namespace sherd;

TEST_CASE("wave speeds: Rayleigh speeds of the table in theory F.3")
{
  struct Row
  {
    double nu, over_bar_speed, over_shear_speed;
  };
  for (const Row &row : {Row{0., .618034, .874032}, Row{.2, .584294, .905184}, Row{.25, .576164, .910996},
                         Row{.3, .568212, .916214}, Row{.4, .552892, .925165}})
    {
      const double E = 72., rho = 2.5;
      const auto   moduli = material::surface_moduli(E, row.nu);

      const auto speeds = wave_speeds(moduli.bulk, moduli.shear, rho);

      CHECK(std::abs(speeds.rayleigh / std::sqrt(E / rho) - row.over_bar_speed) < 5.1e-7); // printed digits
      CHECK(std::abs(speeds.rayleigh / speeds.shear - row.over_shear_speed) < 5.1e-7);
      CHECK(speeds.dilatational == Approx(std::sqrt(E / (rho * (1. - row.nu * row.nu)))).epsilon(1e-15));
      CHECK(speeds.shear == Approx(std::sqrt(E / (2. * (1. + row.nu) * rho))).epsilon(1e-15));
    }
}

TEST_CASE("wave speeds: the Rayleigh speed solves its equation")
{
  for (const double bulk : {1e-3, .1, 1., 10., 1e3})
    {
      const auto   speeds = wave_speeds(bulk, 1., 1.);
      const double x      = std::pow(speeds.rayleigh / speeds.shear, 2),
                   y      = std::pow(speeds.rayleigh / speeds.dilatational, 2);

      CHECK(std::pow(2. - x, 2) == Approx(4. * std::sqrt(1. - y) * std::sqrt(1. - x)).epsilon(1e-13));
      CHECK(speeds.rayleigh > 0.);
      CHECK(speeds.rayleigh < speeds.shear);
    }
}

TEST_CASE("wave speeds: data of the obstacle example")
{
  const auto moduli = material::surface_moduli(100., .3);

  CHECK(std::abs(wave_speeds(moduli.bulk, moduli.shear, 1.).rayleigh - 5.6821) < 5.1e-5);
}

TEST_CASE("wave speeds: values outside their range are refused")
{
  for (const double bad : {0., -1., std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
      CHECK_THROWS_AS(wave_speeds(bad, 1., 1.), InvalidParameter);
      CHECK_THROWS_AS(wave_speeds(1., bad, 1.), InvalidParameter);
      CHECK_THROWS_AS(wave_speeds(1., 1., bad), InvalidParameter);
    }
}
