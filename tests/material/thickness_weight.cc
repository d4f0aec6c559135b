#include <catch2/catch.hpp>

#include <sherd/material/split/gauss_thickness.h>
#include <sherd/material/split/weight_derivatives.h>
#include <sherd/verify/derivative.h>
#include <sherd/verify/random_state.h>
#include <sherd/verify/shell_split.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

using namespace sherd;

namespace
{
constexpr double T = .1;

ThicknessWeight weight(const SurfacePoint<3> &point, const LayerMetric metric)
{
  return thickness_weight(layer_stretch(point, T, metric));
}

/// Metric of the layer at xi, theory A.3, from matrices.
double layer_determinant(const Voigt &metric_, const Voigt &curvature, const double xi, const LayerMetric model)
{
  const Eigen::Matrix2d a{{metric_[0], metric_[2]}, {metric_[2], metric_[1]}};
  const Eigen::Matrix2d b{{curvature[0], curvature[2]}, {curvature[2], curvature[1]}};
  Eigen::Matrix2d       layer = a - 2. * xi * b;
  if (model == LayerMetric::full)
    layer += xi * xi * b * a.inverse() * b;
  return layer.determinant();
}

/// w by a midpoint rule on the definition.
double midpoint_weight(const verify::ShellState &state, const LayerMetric model, const int n)
{
  double sum = 0.;
  for (int i = 0; i < n; ++i)
    {
      const double s = (2. * i + 1.) / n - 1., xi = .5 * T * s;
      if (layer_determinant(state.current, state.current_curvature, xi, model) >=
          layer_determinant(state.reference, state.reference_curvature, xi, model))
        sum += 3. * s * s / n;
    }
  return sum;
}

/// Random states: stretched, compressed, and near J = 1 with and without mean curvature.
verify::ShellState sample(verify::RandomNumbers &random, const int n)
{
  return verify::random_shell_state(random,
                                    n % 4 == 0   ? 1.25
                                    : n % 4 == 1 ? .8
                                                 : 1.,
                                    T, n % 4 == 3 ? verify::Bending::saddle : verify::Bending::general);
}

const Voigt one(1., 1., 0.);
} // namespace

TEMPLATE_TEST_CASE_SIG("thickness weight: equals a fine midpoint rule with 0, 1 and 2 cuts", "",
                       ((LayerMetric model), model), LayerMetric::full, LayerMetric::linear)
{
  verify::RandomNumbers random(51);
  std::array<int, 3>    seen{};
  for (int n = 0; n < 160; ++n)
    {
      const auto state  = sample(random, n);
      const auto result = weight(state.point(), model);

      // Each cut may shift by half an interval, 3 s^2 / (2 n).
      constexpr int n_points = 10000;
      CHECK(std::abs(result.value - midpoint_weight(state, model, n_points)) < 2. * 1.5 / n_points + 1e-12);
      CHECK(result.value >= 0.);
      CHECK(result.value <= 1.);
      ++seen[result.n_cuts];
    }
  CHECK(*std::min_element(seen.begin(), seen.end()) >= 5);
}

TEMPLATE_TEST_CASE_SIG("thickness weight: a cut lies where the layer keeps its area", "", ((LayerMetric model), model),
                       LayerMetric::full, LayerMetric::linear)
{
  verify::RandomNumbers random(52);
  for (int n = 0; n < 100; ++n)
    {
      const auto state  = sample(random, n);
      const auto result = weight(state.point(), model);
      for (int i = 0; i < result.n_cuts; ++i)
        {
          const double xi = .5 * T * result.cuts[i];
          CHECK(std::abs(layer_determinant(state.current, state.current_curvature, xi, model) /
                             layer_determinant(state.reference, state.reference_curvature, xi, model) -
                         1.) < 1e-12);
        }
      if (result.n_cuts == 2)
        CHECK(result.cuts[0] < result.cuts[1]);
    }
}

TEST_CASE("thickness weight: position of the cut in theory A.3")
{
  const auto point = verify::ShellState{one, 1.002 * one, Voigt::Zero(), Voigt(.5, .1, 0.)}.point();

  const auto full   = thickness_weight(layer_stretch(point, 1., LayerMetric::full));
  const auto linear = thickness_weight(layer_stretch(point, 1., LayerMetric::linear));

  REQUIRE(full.n_cuts == 1);
  REQUIRE(linear.n_cuts == 1);
  CHECK(std::abs(.5 * full.cuts[0] - .0033343) < 5.1e-8);
  CHECK(std::abs(.5 * linear.cuts[0] - .0033319) < 5.1e-8);
}

TEMPLATE_TEST_CASE_SIG("thickness weight: special values", "", ((LayerMetric model), model), LayerMetric::full,
                       LayerMetric::linear)
{
  const auto w = [](const double J, const Voigt &B, const Voigt &b) {
    return weight(verify::ShellState{one, J * one, B, b}.point(), model).value;
  };
  const Voigt flat = Voigt::Zero(), rolled(2., 0., 0.);

  for (const double side : {1., -1.})
    {
      CHECK(w(1., flat, side * rolled) == .5); // pure bending of a flat sheet
      CHECK(w(1.3, flat, side * rolled) == 1.);
      CHECK(w(.7, flat, side * rolled) == 0.);
      CHECK(w(1., flat, side * Voigt(2., -2., 0.)) == 0.); // a saddle shrinks every layer but one
      CHECK(w(1., side * Voigt(2., -2., 0.), flat) == 1.); // flattened again
      CHECK(w(1. + 1e-6, flat, flat) == 1.);               // without bending by the sign of J - 1
      CHECK(w(1. - 1e-6, flat, flat) == 0.);
      CHECK(w(1.01, side * rolled, 1.01 * side * rolled) == 1.);      // a cylinder inflated
      CHECK(w(1. / 1.01, side * rolled, side * rolled / 1.01) == 0.); // and deflated
    }
}

TEMPLATE_TEST_CASE_SIG("thickness weight: the stress-free state is stretched under rounding", "",
                       ((LayerMetric model), model), LayerMetric::full, LayerMetric::linear)
{
  verify::RandomNumbers random(53);
  const auto noise = [&]() -> Voigt { return 1e-14 * Voigt(random(-1., 1.), random(-1., 1.), random(-1., 1.)); };
  for (int n = 0; n < 1000; ++n)
    {
      auto state              = sample(random, n);
      state.current           = state.reference + noise();
      state.current_curvature = state.reference_curvature + noise() / T;

      const auto result = weight(state.point(), model);

      CHECK(result.value == 1.);
      CHECK(result.n_cuts == 0);
    }
}

TEMPLATE_TEST_CASE_SIG("thickness weight: reversing the normal mirrors the cuts and keeps the weight", "",
                       ((LayerMetric model), model), LayerMetric::full, LayerMetric::linear)
{
  verify::RandomNumbers random(54);
  for (int n = 0; n < 100; ++n)
    {
      const auto state = sample(random, n);
      const auto reversed =
          verify::ShellState{state.reference, state.current, -state.reference_curvature, -state.current_curvature};

      const auto one_side = weight(state.point(), model), other_side = weight(reversed.point(), model);

      CHECK(std::abs(one_side.value - other_side.value) < 1e-15);
      REQUIRE(one_side.n_cuts == other_side.n_cuts);
      for (int i = 0; i < one_side.n_cuts; ++i)
        CHECK(std::abs(one_side.cuts[i] + other_side.cuts[one_side.n_cuts - 1 - i]) < 1e-15);
    }
}

TEST_CASE("thickness weight: roots are accurate when the quadratic is nearly linear or its roots differ widely")
{
  // (s - r) (1 - x s): one root at r, the other far outside.
  for (const double x : {0., 1e-18, 1e-13, 1e-8, 1e-3, .5})
    for (const double r : {-.9, -1e-3, 1e-12, .3})
      {
        const auto result = thickness_weight({{-r, 1. + x * r, -x}});

        REQUIRE(result.n_cuts == 1);
        CHECK(std::abs(result.cuts[0] - r) < 2e-16 * std::max(1., std::abs(r)) + 4e-16 * std::abs(r));
        CHECK(result.value == Approx(.5 * (1. - r * r * r)).epsilon(1e-15));
      }
  // Roots that only touch zero cut nothing.
  CHECK(thickness_weight({{.25, -1., 1.}}).n_cuts == 0);
  CHECK(thickness_weight({{.25, -1., 1.}}).value == 1.);
  CHECK(thickness_weight({{-.25, 1., -1.}}).value == 0.);
}

TEMPLATE_TEST_CASE_SIG("thickness weight: first and second derivatives", "", ((LayerMetric model), model),
                       LayerMetric::full, LayerMetric::linear)
{
  constexpr double      step    = 5e-4;
  constexpr int         n_steps = 10; // below, rounding in the position of a cut outweighs the error of the quotient
  verify::RandomNumbers random(55);
  const auto            direction = [&] { return Voigt(random(-1., 1.), random(-1., 1.), random(-1., 1.)); };
  const auto            gradient  = [](const SurfacePoint<3> &point) {
    const auto stretch = layer_stretch(point, T, model);
    return weight_gradient(thickness_weight(stretch), stretch, layer_stretch_gradient(point, T, model));
  };
  std::array<int, 3> seen{};
  for (int n = 0; n < 60;)
    {
      const verify::internal::ShellPath path{sample(random, 2 + n % 2), direction(), direction() / T};
      const auto                        point   = path.state.point();
      const auto                        stretch = layer_stretch(point, T, model);
      const auto                        result  = thickness_weight(stretch);
      // The derivatives vanish where a cut nears the mid surface, and only rounding is left to compare.
      const bool near_middle = std::any_of(result.cuts.begin(), result.cuts.begin() + result.n_cuts,
                                           [](const double s) { return std::abs(s) < .05; });
      if (near_middle || !path.is_smooth(T, 8. * step))
        continue;
      ++n;
      ++seen[result.n_cuts];
      const auto  w  = gradient(point);
      const auto  ww = weight_hessian(result, stretch, layer_stretch_gradient(point, T, model),
                                      layer_stretch_hessian(point, T, model));
      const Voigt a = voigt_weight.cwiseProduct(path.a), b = voigt_weight.cwiseProduct(path.b);

      const auto first =
          verify::check_derivative([&](const double h) { return weight(path.at(h).point(), model).value; },
                                   contract(w.a, path.a) + contract(w.b, path.b), step, n_steps);
      const auto by_a = verify::check_derivative([&](const double h) { return gradient(path.at(h).point()).a; },
                                                 Voigt(ww.aa * a + ww.ab * b), step, n_steps);
      const auto by_b = verify::check_derivative([&](const double h) { return gradient(path.at(h).point()).b; },
                                                 Voigt(ww.ab.transpose() * a + ww.bb * b), step, n_steps);

      INFO(result.n_cuts << " cuts; orders " << first.order << ", " << by_a.order << ", " << by_b.order << "; defects "
                         << first.smallest_defect << ", " << by_a.smallest_defect << ", " << by_b.smallest_defect);
      CHECK(first.passed());
      CHECK(by_a.passed());
      CHECK(by_b.passed());
      CHECK(ww.aa.isApprox(ww.aa.transpose(), 1e-12));
      CHECK(ww.bb.isApprox(ww.bb.transpose(), 1e-12));
    }
  CHECK(seen[1] >= 10);
  CHECK(seen[2] >= 5);
}

TEST_CASE("Gauss rule in the thickness: converges to the closed form with its number of points")
{
  verify::RandomNumbers random(56);
  for (const int n_points : {2, 4, 16, 64, 256})
    {
      const GaussThickness rule(n_points);
      double               largest = 0.;
      for (int n = 0; n < 200; ++n)
        {
          const auto stretch = layer_stretch(sample(random, n).point(), T, LayerMetric::full);
          const auto exact   = thickness_weight(stretch);
          largest            = std::max(largest, std::abs(rule.weight(stretch) - exact.value));
          if (exact.n_cuts == 0)
            CHECK(std::abs(rule.weight(stretch) - exact.value) < 1e-13);
        }
      // One point moves across each of two cuts at most, with a weight of up to pi / n.
      CHECK(largest < 2. * 1.5 * std::numbers::pi / n_points);
    }
}

TEST_CASE("Gauss rule in the thickness: stress-free states are stretched, half the sheet in bending")
{
  const GaussThickness rule(5);
  CHECK(rule.weight({{-1e-14, 1e-14, 0.}}) == 1.);
  CHECK(GaussThickness(4).weight({{0., 1., 0.}}) == Approx(.5).epsilon(1e-15));
  for (const int bad : {1, 0, -3})
    CHECK_THROWS_AS(GaussThickness(bad), InvalidParameter);
}
