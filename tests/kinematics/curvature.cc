#include <catch2/catch.hpp>

#include <sherd/kinematics/curvature.h>
#include <sherd/kinematics/invariant_derivatives.h>
#include <sherd/verify/derivative.h>
#include <sherd/verify/random_state.h>

#include <cmath>

using namespace sherd;

namespace
{
Eigen::Matrix2d matrix(const Voigt &T)
{
  return Eigen::Matrix2d{{T[0], T[2]}, {T[2], T[1]}};
}

/// Calls check(state, direction in a, direction in b) at random states of a shell.
template <class Check>
void at_random_states(const Check &check)
{
  verify::RandomNumbers random(31);
  const auto            direction = [&] { return Voigt(random(-1., 1.), random(-1., 1.), random(-1., 1.)); };
  for (int n = 0; n < 20; ++n)
    {
      const auto  state = verify::random_shell_state(random, n % 2 ? 1.3 : .7, .5);
      const Voigt a = direction(), b = direction();
      check(state, a, b);
    }
}

SurfacePoint<3> moved(const verify::ShellState &state, const Voigt &a, const Voigt &b)
{
  return verify::ShellState{state.reference, state.current + a, state.reference_curvature, state.current_curvature + b}
      .point();
}

Voigt weighted(const Voigt &path)
{
  return voigt_weight.cwiseProduct(path);
}
} // namespace

TEST_CASE("curvature: a sphere with outward normal")
{
  const double r = 2.5;
  const Metric a = metric(Voigt(2., 3., -1.));
  const Voigt  b = -a.covariant / r;

  CHECK(mean_curvature(a, b) == Approx(-1. / r).epsilon(1e-15));
  CHECK(gauss_curvature(a, b) == Approx(1. / (r * r)).epsilon(1e-15));
}

TEST_CASE("curvature: invariants are those of the shape operator")
{
  at_random_states([](const verify::ShellState &state, const Voigt &, const Voigt &) {
    const auto            point = state.point();
    const Eigen::Matrix2d a = matrix(point.metric.contravariant), b = matrix(state.current_curvature);

    CHECK(std::abs(point.mean_curvature - .5 * (a * b).trace()) < 1e-14);
    CHECK(std::abs(point.gauss_curvature - (a * b).determinant()) < 1e-14);
    CHECK((matrix(raised(point.metric, point.curvature)) - a * b * a).norm() < 1e-14);
    const Eigen::Matrix2d cofactor = 2. * point.mean_curvature * a - a * b * a;
    CHECK((matrix(curvature_cofactor(point.metric, point.curvature)) - cofactor).norm() < 1e-13);
  });
}

TEST_CASE("surface point in space: is the point in the plane with curvatures of both states")
{
  at_random_states([](const verify::ShellState &state, const Voigt &, const Voigt &) {
    const auto             point = state.point();
    const SurfacePoint<2> &plane = point;
    const auto             alone = verify::MetricState{state.reference, state.current}.point();

    CHECK(plane.J == alone.J);
    CHECK(plane.J_minus_1 == alone.J_minus_1);
    CHECK(plane.deviator == alone.deviator);
    CHECK(point.curvature == state.current_curvature);
    CHECK(point.curvature_change == state.current_curvature - state.reference_curvature);
    const auto rest =
        verify::ShellState{state.reference, state.reference, state.reference_curvature, state.reference_curvature}
            .point();
    CHECK(rest.curvature_change.norm() == 0.);
    CHECK(std::abs(rest.mean_curvature - point.reference_mean_curvature) < 1e-15);
    CHECK(std::abs(rest.gauss_curvature - point.reference_gauss_curvature) < 1e-15);
  });
}

TEST_CASE("surface point: the trace of tiny strains keeps its relative accuracy")
{
  for (const double x : {std::ldexp(1., -20), std::ldexp(1., -40), std::ldexp(1., -50)})
    {
      const verify::MetricState state{Voigt(1., 4., 0.), Voigt(1. + 2. * x, 4. - 4. * x, 0.)};

      CHECK(std::abs(state.point().I1_minus_2 / x - 1.) < 1e-15);
    }
}

TEST_CASE("invariants: first derivatives")
{
  at_random_states([](const verify::ShellState &state, const Voigt &a, const Voigt &b) {
    const auto I     = invariant_gradients(state.point());
    const auto check = [&](const auto invariant, const Voigt &by_a, const Voigt &by_b) {
      const auto derivative = verify::check_derivative(
          [&](const double h) { return moved(state, h * a, h * b).*invariant; }, contract(by_a, a) + contract(by_b, b));
      INFO("order " << derivative.order << ", defect " << derivative.smallest_defect);
      CHECK(derivative.passed());
    };
    check(&SurfacePoint<3>::J, I.J_a, Voigt::Zero());
    check(&SurfacePoint<3>::mean_curvature, I.H_a, I.H_b);
    check(&SurfacePoint<3>::gauss_curvature, I.kappa_a, I.kappa_b);
  });
}

TEST_CASE("invariants: second derivatives")
{
  at_random_states([](const verify::ShellState &state, const Voigt &a, const Voigt &b) {
    const auto II    = invariant_hessians(state.point());
    const auto check = [&](const auto gradient, const Voigt &expected) {
      const auto derivative = verify::check_derivative(
          [&](const double h) { return Voigt(invariant_gradients(moved(state, h * a, h * b)).*gradient); }, expected);
      INFO("order " << derivative.order << ", defect " << derivative.smallest_defect);
      CHECK(derivative.passed());
    };
    check(&InvariantGradients::J_a, II.J_aa * weighted(a));
    check(&InvariantGradients::H_a, II.H_aa * weighted(a) + II.H_ab * weighted(b));
    check(&InvariantGradients::H_b, II.H_ab.transpose() * weighted(a));
    check(&InvariantGradients::kappa_a, II.kappa_aa * weighted(a) + II.kappa_ab * weighted(b));
    check(&InvariantGradients::kappa_b, II.kappa_ab.transpose() * weighted(a) + II.kappa_bb * weighted(b));
  });
}
