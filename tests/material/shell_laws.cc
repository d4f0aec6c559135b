#include <catch2/catch.hpp>

#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/verify/derivative.h>
#include <sherd/verify/random_state.h>

#include <cmath>
#include <limits>

using namespace sherd;
using material::Canham, material::Koiter, material::NeoHooke, material::StVenantKirchhoff;

namespace
{
constexpr double E = 7., nu = .3, T = .2;

/// C^abcd of theory B.5, component by component, times a constant.
Voigt4 koiter_tensor(const Voigt &A)
{
  const double          Lambda = E * T * nu / (1. - nu * nu), mu = E * T / (2. * (1. + nu));
  const Eigen::Matrix2d M{{A[0], A[2]}, {A[2], A[1]}};
  const int             row[3] = {0, 1, 0}, column[3] = {0, 1, 1};
  Voigt4                C;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      {
        const int a = row[i], b = column[i], c = row[k], d = column[k];
        C(i, k) = Lambda * M(a, b) * M(c, d) + mu * (M(a, c) * M(b, d) + M(a, d) * M(b, c));
      }
  return C;
}

double quadratic(const Voigt4 &C, const Voigt &x, const Voigt &y)
{
  return voigt_weight.cwiseProduct(x).dot(C * voigt_weight.cwiseProduct(y));
}

template <class Law>
void check_bending(const Law &law)
{
  verify::RandomNumbers random(41);
  for (int n = 0; n < 20; ++n)
    {
      const auto  state = verify::random_shell_state(random, 1.1, T);
      const Voigt a(random(-.1, .1), random(-.1, .1), random(-.1, .1)), b(random(-1., 1.), random(-1., 1.), 1.);
      const auto  at = [&](const double h) {
        return law.bend(verify::ShellState{state.reference, state.current + h * a, state.reference_curvature,
                                           state.current_curvature + h * b}
                             .point());
      };

      const auto moment =
          verify::check_derivative([&](const double h) { return at(h).energy; }, contract(at(0.).moment, b));
      const auto stiffness = verify::check_derivative([&](const double h) { return at(h).moment; },
                                                      Voigt(at(0.).stiffness * voigt_weight.cwiseProduct(b)));

      CHECK(moment.passed());
      CHECK(stiffness.passed());
      CHECK(at(0.).stiffness.isApprox(at(0.).stiffness.transpose(), 1e-15));
      CHECK(at(0.).energy > 0.);
    }
}
} // namespace

TEST_CASE("bending laws: moment and stiffness are derivatives, and do not depend on the deformed metric")
{
  check_bending(Canham(.7));
  check_bending(Koiter(E, nu, T));
  check_bending(Koiter(material::Moduli{.4, 2.}, T)); // negative Poisson's ratio
}

TEST_CASE("Canham: energy is c/2 tr K^2 of mixed components")
{
  verify::RandomNumbers random(42);
  for (int n = 0; n < 20; ++n)
    {
      const auto            point = verify::random_shell_state(random, 1.1, T).point();
      const Voigt          &A = point.reference.metric.contravariant, &k = point.curvature_change;
      const Eigen::Matrix2d K =
          Eigen::Matrix2d{{A[0], A[2]}, {A[2], A[1]}} * Eigen::Matrix2d{{k[0], k[2]}, {k[2], k[1]}};

      CHECK(Canham(.7).bend(point).energy == Approx(.35 * (K * K).trace()).epsilon(1e-13));
    }
}

TEST_CASE("Koiter: membrane and bending are those of theory B.5")
{
  const auto            laws = material::koiter_shell(E, nu, T);
  const split::None     shell(laws.membrane, laws.bending);
  verify::RandomNumbers random(43);
  for (int n = 0; n < 20; ++n)
    {
      const auto   state = verify::random_shell_state(random, n % 2 ? 1.2 : .8, T);
      const auto   point = state.point();
      const Voigt4 C     = koiter_tensor(point.reference.metric.contravariant);
      const Voigt  eps = .5 * (state.current - state.reference), k = point.curvature_change;

      const auto response = shell.respond(point);

      CHECK(response.energy_active ==
            Approx(.5 * quadratic(C, eps, eps) + T * T / 24. * quadratic(C, k, k)).epsilon(1e-13));
      CHECK(response.energy_passive == 0.);
      const Voigt tau = C * voigt_weight.cwiseProduct(eps), moment = T * T / 12. * C * voigt_weight.cwiseProduct(k);
      CHECK((response.stress_active.membrane - tau).norm() < 1e-13 * tau.norm());
      CHECK((response.stress_active.moment - moment).norm() < 1e-13 * moment.norm());
      CHECK(response.tangent_active.membrane.isApprox(C, 1e-13));
      CHECK(response.tangent_active.bending.isApprox(T * T / 12. * C, 1e-13));
      CHECK(response.tangent_active.coupling.norm() == 0.);
      CHECK(response.tangent_active.moment_coupling.norm() == 0.);
    }
}

TEST_CASE("Koiter: the energy is that of layers in plane stress, summed over the thickness")
{
  // psi is quadratic in xi, so that two Gauss points integrate it exactly.
  const auto            laws = material::koiter_shell(E, nu, T);
  verify::RandomNumbers random(44);
  for (int n = 0; n < 20; ++n)
    {
      const auto   state = verify::random_shell_state(random, 1.1, T);
      const auto   point = state.point();
      const Voigt4 C     = koiter_tensor(point.reference.metric.contravariant) / T;
      double       sum   = 0.;
      for (const double xi : {-T / std::sqrt(12.), T / std::sqrt(12.)})
        {
          const Voigt layer = .5 * (state.current - state.reference) - xi * point.curvature_change;
          sum += .5 * T * .5 * quadratic(C, layer, layer);
        }

      CHECK(laws.membrane.respond(point).energy + laws.bending.bend(point).energy == Approx(sum).epsilon(1e-13));
    }
}

TEST_CASE("shell laws: flexural rigidity")
{
  const double D = E * T * T * T / (12. * (1. - nu * nu));
  CHECK(material::flexural_rigidity(E, nu, T) == Approx(D).epsilon(1e-15));
  CHECK(Koiter(material::plane_stress_moduli(E, nu, T), T).stiffness() == Approx(D).epsilon(1e-15));
  CHECK(material::neo_hooke_canham_shell(E, nu, T).bending.stiffness() == Approx(D).epsilon(1e-15));
  CHECK(Canham(.7).stiffness() == .7);
  CHECK(material::NoBending{}.stiffness() == 0.);

  // A flat sheet rolled to a cylinder: Psi_b = D kappa^2 / 2 for both laws.
  const auto rolled =
      verify::ShellState{Voigt(1., 1., 0.), Voigt(1., 1., 0.), Voigt::Zero(), Voigt(3., 0., 0.)}.point();
  CHECK(Koiter(E, nu, T).bend(rolled).energy == Approx(.5 * D * 9.).epsilon(1e-14));
  CHECK(Canham(D).bend(rolled).energy == Approx(.5 * D * 9.).epsilon(1e-14));
}

TEST_CASE("St. Venant-Kirchhoff: stress and tangent are derivatives")
{
  const StVenantKirchhoff law(material::plane_stress_moduli(E, nu, T));
  verify::RandomNumbers   random(45);
  for (int n = 0; n < 20; ++n)
    {
      const auto  state = verify::random_state(random, n % 2 ? 1.3 : .7);
      const Voigt path(random(-1., 1.), random(-1., 1.), random(-1., 1.)), half = .5 * voigt_weight.cwiseProduct(path);
      const auto  at = [&](const double h) {
        return law.respond(verify::MetricState{state.reference, state.current + h * path}.point());
      };

      CHECK(verify::check_derivative([&](const double h) { return at(h).energy; }, at(0.).stress.membrane.dot(half))
                .passed());
      CHECK(verify::check_derivative([&](const double h) { return at(h).stress.membrane; },
                                     Voigt(at(0.).tangent.membrane * half))
                .passed());
    }
}

TEST_CASE("St. Venant-Kirchhoff and neo-Hooke: the same linear law at small strains, to full relative accuracy")
{
  const material::Moduli  moduli{1.7, .6};
  const StVenantKirchhoff linear(moduli);
  const NeoHooke          neo_hooke(moduli);
  for (const double eps : {std::ldexp(1., -23), std::ldexp(1., -34), std::ldexp(1., -45)}) // 1.2e-7, 5.8e-11, 2.8e-14
    {
      const double e11 = eps, e22 = -.5 * eps, e12 = .25 * eps;
      const auto point = verify::MetricState{Voigt(1., 1., 0.), Voigt(1. + 2. * e11, 1. + 2. * e22, 2. * e12)}.point();

      const auto response = linear.respond(point), nonlinear = neo_hooke.respond(point);

      const double trace = e11 + e22, half = .5 * (e11 - e22);
      const double energy = .5 * 1.7 * trace * trace + .6 * 2. * (half * half + e12 * e12);
      const Voigt  stress = 1.7 * trace * Voigt(1., 1., 0.) + 2. * .6 * Voigt(half, -half, e12);
      CHECK(std::abs(response.energy / energy - 1.) < 2e-15);
      CHECK((response.stress.membrane - stress).norm() < 2e-15 * stress.norm());
      CHECK(std::abs(nonlinear.energy / energy - 1.) < 10. * eps + 2e-15);
    }
  const auto rest = verify::MetricState{Voigt(2., 3., -1.), Voigt(2., 3., -1.)}.point();
  CHECK(linear.respond(rest).tangent.membrane.isApprox(neo_hooke.respond(rest).tangent.membrane, 1e-14));
}

TEST_CASE("bending laws: tiny changes of curvature keep their relative accuracy on a curved surface")
{
  for (const double x : {std::ldexp(1., -20), std::ldexp(1., -50)})
    {
      const Voigt B(1., -.5, .25), k(x, .5 * x, -x);
      const auto  point = verify::ShellState{Voigt(1., 1., 0.), Voigt(1., 1., 0.), B, B + k}.point();

      CHECK(std::abs(Canham(.7).bend(point).energy / (.35 * 3.25 * x * x) - 1.) < 2e-15);
      const auto koiter = Koiter(material::Moduli{1.7, .6}, 1.).bend(point);
      CHECK(std::abs(koiter.energy / (1. / 12. * (.5 * 1.7 * 2.25 + .6 * 2.125) * x * x) - 1.) < 2e-15);
    }
}

TEST_CASE("spherical inflation: energies and pressure of theory J.5")
{
  const double      K = 7.142857142857143, c = 1e-5, R = 1.;
  const NeoHooke    membrane(K, 10. / 2.6);
  const Canham      bending(c);
  const split::None shell(membrane, bending);
  const auto        respond = [&](const double lambda) {
    const Voigt one(1., 1., 0.);
    return shell.respond(verify::ShellState{one, lambda * lambda * one, -one / R, -lambda / R * one}.point());
  };
  // d Psi / d lambda = tau : da/2 + M : db, and p = (d Psi / d lambda) / (R lambda^2).
  const auto pressure = [&](const double lambda) {
    const auto stress = respond(lambda).stress_active;
    return (lambda * (stress.membrane[0] + stress.membrane[1]) - (stress.moment[0] + stress.moment[1]) / R) /
           (R * lambda * lambda);
  };

  for (const double lambda : {.8, 1.0035184586, 1.5})
    {
      const double strain = lambda - 1.;
      const double psi    = K / 4. * (std::pow(lambda, 4) - 1. - 4. * std::log(lambda)) + c * strain * strain / (R * R);
      CHECK(respond(lambda).energy_active == Approx(psi).epsilon(1e-11)); // cancellation in this formula
      CHECK(pressure(lambda) ==
            Approx(K / R * (lambda - std::pow(lambda, -3)) + 2. * c * strain / (R * R * R * lambda * lambda))
                .epsilon(1e-13));
    }
  // The balloon at p = 0.1; the table has ten digits of lambda, so that p has a relative error of 2e-8 at most.
  CHECK(pressure(1.0035184586) == Approx(.1).epsilon(2e-8));
  CHECK(respond(1.0035184586).energy_active == Approx(1.770589e-4).epsilon(5e-7));
}

TEST_CASE("shell laws: values outside their range are refused")
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {0., -1., nan, inf})
    {
      CHECK_THROWS_AS(Canham(bad), InvalidParameter);
      CHECK_THROWS_AS(StVenantKirchhoff(material::Moduli{bad, 1.}), InvalidParameter);
      CHECK_THROWS_AS(StVenantKirchhoff(material::Moduli{1., bad}), InvalidParameter);
      CHECK_THROWS_AS(Koiter(material::Moduli{bad, 1.}, T), InvalidParameter);
      CHECK_THROWS_AS(Koiter(material::Moduli{1., bad}, T), InvalidParameter);
      CHECK_THROWS_AS(Koiter(material::Moduli{1., 1.}, bad), InvalidParameter);
      CHECK_THROWS_AS(Koiter(E, nu, bad), InvalidParameter);
      CHECK_THROWS_AS(material::koiter_shell(bad, nu, T), InvalidParameter);
      CHECK_THROWS_AS(material::neo_hooke_canham_shell(E, .5, T), InvalidParameter);
    }
}
