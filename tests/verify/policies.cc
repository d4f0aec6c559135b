#include <catch2/catch.hpp>

#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/verify/crack_density.h>
#include <sherd/verify/degradation.h>
#include <sherd/verify/split.h>

#include <limits>
#include <sstream>

using namespace sherd;
using material::NeoHooke;

namespace
{
/// A split whose active stress, tangent or driving stress is wrong by one part in a thousand.
enum class Mistake
{
  stress,
  tangent,
  driving
};

struct WrongSplit
{
  Mistake                         mistake;
  split::SurfaceStretch<NeoHooke> right{NeoHooke(1.7, .6)};

  double bulk() const { return right.bulk(); }
  double shear() const { return right.shear(); }

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    auto response = right.respond(point);
    if (mistake == Mistake::stress)
      response.stress_active = 1.001 * response.stress_active;
    if (mistake == Mistake::tangent)
      response.tangent_active = 1.001 * response.tangent_active;
    if (mistake == Mistake::driving)
      response.driving = 1.001 * response.driving;
    return response;
  }
};

struct WrongSlope : degradation::Quadratic
{
  double first(const double phi) const { return 2.01 * phi; }
};

/// The coefficients of another definition of the length scale.
struct WrongDensity : crack_density::FourthOrder
{
  double c1(const double l0) const { return l0 * l0; }
};
} // namespace

TEMPLATE_TEST_CASE("verify: the shipped splits are consistent", "", split::None<NeoHooke>,
                   split::SurfaceStretch<NeoHooke>)
{
  for (const auto &law : {NeoHooke(1.7, .6), NeoHooke(1e-3, 5.), NeoHooke(material::plane_strain_moduli(210e3, .3))})
    {
      const auto report = verify::split(TestType(law));
      INFO(report);
      CHECK(report.passed());
    }
}

TEST_CASE("verify: a mistake in one part of a split is found and named")
{
  for (const auto mistake : {Mistake::stress, Mistake::tangent, Mistake::driving})
    {
      const auto report = verify::split(WrongSplit{mistake});

      int n_wrong = 0;
      for (const auto &entry : report.entries())
        n_wrong += !entry.passed();
      INFO(report);
      CHECK_FALSE(report.passed());
      CHECK(n_wrong == (mistake == Mistake::stress ? 2 : 1)); // the stress is also what its tangent derives from
    }
}

TEST_CASE("verify: a mistake in a degradation or a density is found")
{
  CHECK(verify::degradation(degradation::Cubic()).passed());
  CHECK_FALSE(verify::degradation(WrongSlope{}).passed());
  CHECK(verify::crack_density(crack_density::FourthOrder{}).passed());
  CHECK_FALSE(verify::crack_density(WrongDensity{}).passed());
}

TEST_CASE("verify: random states lie on the side of J = 1 they were asked for")
{
  verify::RandomNumbers random(5);
  for (int n = 0; n < 1000; ++n)
    {
      CHECK(verify::random_state(random, 1.25).point().J > 1.05);
      CHECK(verify::random_state(random, .8).point().J < .95);
    }
}

TEST_CASE("verify: a report keeps the worst figure of each name and fails on NaN or when empty")
{
  verify::Report report;
  CHECK_FALSE(report.passed());

  report.add("first", .1, 1.);
  report.add("first", .5, 1.);
  report.add("first", .2, 1.);
  CHECK(report.entries().size() == 1);
  CHECK(report.entries()[0].defect == .5);
  CHECK(report.passed());

  report.add("second", std::numeric_limits<double>::quiet_NaN(), 1.);
  report.add("second", 0., 1.);
  CHECK_FALSE(report.passed());
  std::ostringstream text;
  text << report;
  CHECK(text.str().find("WRONG second: defect nan") != std::string::npos);
}
