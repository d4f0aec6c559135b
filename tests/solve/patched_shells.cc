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
  CHECK(std::abs(fine.penalty) < .5 * std::abs(coarse.penalty));
  CHECK(std::abs(fine.multiplier) < .5 * std::abs(coarse.multiplier));
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
  const auto shell = [](auto degree) { return [](int n) { return roof<degree()>(n); }; };
  check_patches<2>(shell(std::integral_constant<int, 2>()), 8);
  check_patches<3>(shell(std::integral_constant<int, 3>()), 8);
}

TEST_CASE("Patches of a hemisphere converge to one patch")
{
  const auto shell = [](auto degree) { return [](int n) { return hemisphere<degree()>(n, 18.); }; };
  check_patches<2>(shell(std::integral_constant<int, 2>()), 8);
  check_patches<3>(shell(std::integral_constant<int, 3>()), 8);
}

namespace
{

/// Deflection of the middle of a clamped regular pentagon, of five patches that meet there, over that of fine cubic
/// elements with multipliers.
template <int degree>
double pentagon(int n, const Continuity &continuity)
{
  constexpr double exact = 1.;
  Supports         supports;
  supports.fix(WholeSurface{}, Component::x);
  supports.fix(WholeSurface{}, Component::y);
  supports.clamp_weakly("outer");
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., t); });
  KoiterBody<degree> body(12. * (1. - .3 * .3), .3, 1., shapes::polygon<degree>(1., 5, n), supports, loads, {},
                          continuity);
  return body.displacement(body.solver.solve_linear(body.state, 1.), 0., 0.)[2] / exact;
}

} // namespace

// Where patches meet askew, quadratic functions that are smooth across all interfaces have little freedom left around
// the corner. theory G.3
TEST_CASE("Five patches around a corner lock with quadratic elements and too large a factor")
{
  for (const int n : {4, 8, 16})
    for (const double beta : {1e2, 1e3, 1e4, 1e5})
      UNSCOPED_INFO("degree 2, n = " << n << ", beta = " << beta << ": "
                                     << pentagon<2>(n, continuity::Penalty{beta, 0.}));
  for (const int n : {4, 8, 16})
    UNSCOPED_INFO("degree 2, n = " << n << ", multiplier: " << pentagon<2>(n, continuity::LagrangeMultiplier()));
  for (const int n : {4, 8, 16})
    UNSCOPED_INFO("degree 3, n = " << n << ": " << pentagon<3>(n, continuity::Penalty()) << ", multiplier "
                                   << pentagon<3>(n, continuity::LagrangeMultiplier()));
  CHECK(pentagon<2>(4, continuity::Penalty{1e5, 0.}) < .01);
}
