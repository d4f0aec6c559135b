#include <catch2/catch.hpp>

#include <sherd/material/shell_laws.h>
#include <sherd/verify/bending.h>
#include <sherd/verify/membrane.h>

#include <functional>
#include <sstream>
#include <string>

using namespace sherd;
using material::Canham, material::Koiter, material::Moduli, material::NeoHooke, material::StVenantKirchhoff;

namespace
{
const Moduli moduli{1.7, .6};

/// A membrane law in which one thing is wrong by one part in a thousand.
struct WrongMembrane
{
  std::function<void(Response<2> &)> mistake;
  double                             bulk_error = 1.;
  StVenantKirchhoff                  right{moduli};

  double bulk() const { return bulk_error * right.bulk(); }
  double shear() const { return right.shear(); }

  Response<2> respond(const SurfacePoint<2> &point) const
  {
    auto response = right.respond(point);
    mistake(response);
    return response;
  }
};

/// A law whose dilatation does not vanish where J = 1.
struct WrongParts : NeoHooke
{
  WrongParts() : NeoHooke(moduli) {}

  Response<2> dilatation(const SurfacePoint<2> &point) const { return deviator(point); }
  Response<2> deviator(const SurfacePoint<2> &point) const { return NeoHooke::deviator(point); }
};

/// A law that knows the directions of the parametric lines.
struct Fibres
{
  double bulk() const { return .5; }
  double shear() const { return .5; }

  Response<2> respond(const SurfacePoint<2> &point) const
  {
    const double strain = .5 * (point.metric.covariant[0] - point.reference.metric.covariant[0]);
    return {.5 * strain * strain, {Voigt(strain, 0., 0.)}, {Voigt(1., 0., 0.).asDiagonal()}};
  }
};

struct WrongBending
{
  std::function<void(BendingResponse &)> mistake;
  double                                 stiffness_error = 1.;
  Koiter                                 right{moduli, .1};

  double stiffness() const { return stiffness_error * right.stiffness(); }

  BendingResponse bend(const SurfacePoint<3> &point) const
  {
    auto response = right.bend(point);
    mistake(response);
    return response;
  }
};

int n_wrong(const verify::Report &report)
{
  int n = 0;
  for (const auto &entry : report.entries())
    n += !entry.passed();
  return n;
}

std::string wrong(const verify::Report &report)
{
  std::string names;
  for (const auto &entry : report.entries())
    if (!entry.passed())
      names += entry.name + "; ";
  return names;
}
} // namespace

TEST_CASE("verify: the shipped membrane laws are consistent")
{
  const auto check = [](const auto &law) {
    const auto report = verify::membrane(law);
    INFO(report);
    CHECK(report.passed());
  };
  for (const auto &m : {moduli, Moduli{1e-3, 5.}, material::plane_strain_moduli(210e3, .3)})
    {
      check(NeoHooke(m));
      check(StVenantKirchhoff(m));
    }
}

TEST_CASE("verify: the shipped bending laws are consistent")
{
  const auto check = [](const auto &law, const double length) {
    const auto report = verify::bending(law, length);
    INFO(report);
    CHECK(report.passed());
  };
  check(Canham(.4), 1.);
  check(Canham(.4), 1e-2);
  check(Koiter(moduli, .1), .1);
  check(material::NoBending{}, 1.);
}

TEST_CASE("verify: a mistake in a membrane law is found and named")
{
  const auto check = [](const WrongMembrane &law, const int expected, const std::string &name) {
    const auto report = verify::membrane(law);
    INFO(report);
    CHECK(n_wrong(report) == expected);
    CHECK(wrong(report).find(name) != std::string::npos);
  };
  CHECK(verify::membrane(WrongMembrane{[](auto &) {}}).passed());
  check({[](auto &r) { r.stress.membrane *= 1.001; }}, 2, "stress is the derivative");   // and what the tangent derives
  check({[](auto &r) { r.tangent.membrane *= 1.001; }}, 2, "tangent is the derivative"); // and the moduli
  check({[](auto &r) { r.tangent.membrane(0, 1) *= 1.001; }}, 3, "symmetric");
  check({[](auto &r) { r.energy += 1e-10; }}, 1, "rest");
  check({[](auto &) {}, 1.001}, 1, "moduli at rest");
  CHECK(wrong(verify::membrane(Fibres{})).find("parametric coordinates") != std::string::npos);
  CHECK(wrong(verify::membrane(WrongParts())).find("sum to the law") != std::string::npos);
  CHECK(wrong(verify::membrane(WrongParts())).find("where J = 1") != std::string::npos);
}

TEST_CASE("verify: a mistake in a bending law is found and named")
{
  const auto check = [](const WrongBending &law, const int expected, const std::string &name) {
    const auto report = verify::bending(law);
    INFO(report);
    CHECK(n_wrong(report) == expected);
    CHECK(wrong(report).find(name) != std::string::npos);
  };
  CHECK(verify::bending(WrongBending{[](auto &) {}}).passed());
  check({[](auto &r) { r.moment *= 1.001; }}, 2, "moment is the derivative");
  check({[](auto &r) { r.stiffness *= 1.001; }}, 2, "stiffness is the derivative"); // and stiffness()
  check({[](auto &) {}, 1.001}, 1, "one axis");
}

TEST_CASE("verify: a report says what is wrong, by how much and where")
{
  std::ostringstream text;
  text << verify::membrane(WrongMembrane{[](auto &r) { r.tangent.membrane *= 1.001; }});
  INFO(text.str());
  CHECK(text.str().find("2 of 7 checks failed\n") == 0);
  CHECK(text.str().find("  ok    stress is the derivative of the energy") != std::string::npos);
  CHECK(text.str().find("  WRONG tangent is the derivative of the stress") != std::string::npos);
  CHECK(text.str().find("worst at state ") != std::string::npos);

  std::ostringstream right;
  right << verify::membrane(StVenantKirchhoff(moduli));
  CHECK(right.str().find("all 7 checks hold\n") == 0);
  std::ostringstream nothing;
  nothing << verify::Report();
  CHECK(nothing.str() == "nothing was checked\n");
}
