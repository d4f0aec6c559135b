#include <catch2/catch.hpp>

#include <sherd/material/canham.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/verify/split.h>

#include <array>
#include <functional>

using namespace sherd;

namespace
{
constexpr double T = .1;

/// A split of the shell in which one thing is wrong by one part in a thousand.
struct WrongSplit
{
  std::function<void(SplitResponse<3> &)>                     mistake;
  split::SurfaceStretch<material::NeoHooke, material::Canham> right{
      material::NeoHooke(1.7, .6), material::Canham(.02), {.thickness = T, .cut = Cut::kept}};

  double bulk() const { return right.bulk(); }
  double shear() const { return right.shear(); }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    auto response = right.respond(point);
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
} // namespace

TEST_CASE("verify: each tangent of a shell split is checked on its own")
{
  CHECK(verify::split(WrongSplit{[](auto &) {}}, verify::ShellCheck{.thickness = T}).passed());
  const auto check = [](const auto block) {
    const auto report = verify::split(WrongSplit{[block](SplitResponse<3> &r) { r.tangent_active.*block *= 1.001; }},
                                      verify::ShellCheck{.thickness = T});
    INFO(report);
    CHECK(n_wrong(report) == 1);
  };
  check(&Tangent<3>::membrane);
  check(&Tangent<3>::coupling);
  check(&Tangent<3>::moment_coupling);
  check(&Tangent<3>::bending);
}

TEST_CASE("verify: mistakes in moment, driving and energy of a shell split are found")
{
  const auto check = [](const std::function<void(SplitResponse<3> &)> &mistake, const int expected) {
    const auto report = verify::split(WrongSplit{mistake}, verify::ShellCheck{.thickness = T});
    INFO(report);
    CHECK(n_wrong(report) == expected);
  };
  check([](auto &r) { r.stress_passive.moment *= 1.001; },
        4); // both energies, and what the tangents e and f derive from
  check([](auto &r) { r.driving.moment *= 1.001; }, 1);
  check([](auto &r) { r.energy_passive += 1e-10; }, 1);          // seen at rest
  check([](auto &r) { r.energy_active = -r.energy_active; }, 4); // sign, driving, both sums
}

TEST_CASE("verify: a frozen cut fails the check of a gradient and passes its own")
{
  const split::SurfaceStretch split(material::NeoHooke(1.7, .6), material::Canham(.02), {.thickness = T});

  CHECK_FALSE(verify::split(split, verify::ShellCheck{.thickness = T}).passed());
  CHECK(verify::split(split, {.thickness = T, .stress = verify::StressKind::frozen}).passed());
}
