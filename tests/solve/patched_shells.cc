// label: verification
#include <catch2/catch.hpp>

#include <sherd/geometry/shapes/polygon.h>
#include <sherd/geometry/split.h>

#include "linear_benchmarks.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

/// The same shell, cut into 2 x 2 patches.
template <int degree>
double patched_work(const KoiterBody<degree> &whole, const Continuity &continuity)
{
  return work(KoiterBody<degree>(whole.model, split_patches(whole.surface, {2, 2}), whole.supports, whole.loads, {},
                                 continuity));
}

/// Clamped unit square with D = 1 under a unit load.
template <int degree>
KoiterBody<degree> clamped_plate(int n)
{
  Supports supports;
  supports.fix(WholeSurface{}, Component::x);
  supports.fix(WholeSurface{}, Component::y);
  for (const auto edge : {"left", "right", "bottom", "top"})
    supports.clamp(edge);
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., t); });
  return {12. * (1. - .3 * .3), .3, 1., shapes::plate<degree, 3>({1., 1.}, {n, n}), supports, loads};
}

/// Changes of the energy by its value in one patch.
struct Changes
{
  double penalty, softer, stiffer, multiplier; ///< the default factor, a tenth of it, ten times as much
};

template <int degree, class Shell>
Changes changes(const Shell &shell, int n)
{
  const double  one    = work(shell(n));
  const double  beta   = continuity::penalty_factor(degree);
  const auto    whole  = [&] { return shell(n); };
  const auto    change = [&](const Continuity &method) { return patched_work<degree>(whole(), method) / one - 1.; };
  const Changes result{change(continuity::Penalty()), change(continuity::Penalty{.1 * beta, 0.}),
                       change(continuity::Penalty{10. * beta, 0.}), change(continuity::LagrangeMultiplier())};
  UNSCOPED_INFO("degree " << degree << ", n = " << n << ", energy in one patch " << one << ", changes: penalty "
                          << result.penalty << ", a tenth " << result.softer << ", ten times " << result.stiffer
                          << ", multiplier " << result.multiplier);
  return result;
}

/// Patches converge to one patch, and a penalty ten times larger or smaller changes the energy by less than 1 %.
template <int degree, class Shell>
void check_patches(const Shell &shell, int n)
{
  const auto coarse = changes<degree>(shell, n), fine = changes<degree>(shell, 2 * n);
  CHECK(std::abs(fine.penalty) < .6 * std::abs(coarse.penalty)); // h / beta
  CHECK(std::abs(fine.multiplier) < std::max(.5 * std::abs(coarse.multiplier), 1e-6));
  CHECK(std::abs(fine.softer - fine.penalty) < .01);
  CHECK(std::abs(fine.stiffer - fine.penalty) < .01);
  CHECK(std::abs(fine.penalty) < .01);
  CHECK(std::abs(fine.multiplier) < .01);
}

} // namespace

TEST_CASE("Patches of a plate converge to one patch")
{
  check_patches<2>(clamped_plate<2>, 8);
  check_patches<3>(clamped_plate<3>, 8);
}

TEST_CASE("Patches of a roof converge to one patch")
{
  check_patches<2>([](int n) { return roof<2>(n); }, 8);
  check_patches<3>([](int n) { return roof<3>(n); }, 8);
}

TEST_CASE("Patches of a hemisphere converge to one patch")
{
  check_patches<2>([](int n) { return hemisphere<2>(n, 18.); }, 8);
  check_patches<3>([](int n) { return hemisphere<3>(n, 18.); }, 8);
}

namespace
{

/// Deflection of the middle of a simply supported regular pentagon, of five patches that meet there.
template <int degree>
double pentagon(int n, const Continuity &continuity)
{
  Supports supports;
  supports.fix(WholeSurface{}, Component::x);
  supports.fix(WholeSurface{}, Component::y);
  supports.fix("outer", Component::z);
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., t); });
  KoiterBody<degree> body(12. * (1. - .3 * .3), .3, 1., shapes::polygon<degree>(1., 5, n), supports, loads, {},
                          continuity);
  return body.displacement(body.solver.solve_linear(body.state, 1.), 0., 0.)[2];
}

} // namespace

// Where patches meet askew, quadratic functions that are smooth across all interfaces have little freedom left around
// the corner. theory G.3
TEST_CASE("Five patches around a corner lock with quadratic elements and too large a factor")
{
  constexpr double exact = .0248662; // degree 3, 16 x 16 elements a patch, multipliers
  const auto       error = [&]<int degree>(std::integral_constant<int, degree>, int n, const Continuity &method) {
    const double result = pentagon<degree>(n, method) / exact - 1.;
    UNSCOPED_INFO("degree " << degree << ", n = " << n << ", method " << method.index() << ": " << result);
    return result;
  };
  const std::integral_constant<int, 2> quadratic;
  const std::integral_constant<int, 3> cubic;
  CHECK(std::abs(error(quadratic, 4, continuity::Penalty())) < .02);
  CHECK(std::abs(error(quadratic, 8, continuity::Penalty())) < .005);
  CHECK(std::abs(error(quadratic, 4, continuity::LagrangeMultiplier())) < .012);
  CHECK(error(quadratic, 4, continuity::Penalty{1e5, 0.}) < -.08);
  CHECK(error(quadratic, 8, continuity::Penalty{1e5, 0.}) < -.03);
  CHECK(std::abs(error(cubic, 4, continuity::Penalty())) < .002);
  CHECK(std::abs(error(cubic, 4, continuity::LagrangeMultiplier())) < .003);
}
