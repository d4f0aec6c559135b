#include <catch2/catch.hpp>

#include <sherd/material/neo_hooke.h>
#include <sherd/verify/derivative.h>
#include <sherd/verify/random_state.h>

#include <cmath>
#include <limits>

using namespace sherd;
using material::NeoHooke;

namespace
{
const NeoHooke law(1.7, .6);

/// Response of one part of the law at a metric state.
struct Dilatation
{
  static Response<2> of(const verify::MetricState &state) { return law.dilatation(state.point()); }
};

struct Deviator
{
  static Response<2> of(const verify::MetricState &state) { return law.deviator(state.point()); }
};
} // namespace

TEMPLATE_TEST_CASE("neo-Hooke: stress and tangent are derivatives", "", Dilatation, Deviator)
{
  verify::RandomNumbers random(11);
  for (int n = 0; n < 40; ++n)
    {
      const auto  state = verify::random_state(random, n % 2 ? 1.3 : .7);
      const Voigt path(random(-1., 1.), random(-1., 1.), random(-1., 1.));
      const Voigt half = .5 * voigt_weight.cwiseProduct(path);
      const auto  at   = [&](const double h) { return TestType::of({state.reference, state.current + h * path}); };

      const auto stress =
          verify::check_derivative([&](const double h) { return at(h).energy; }, at(0.).stress.membrane.dot(half));
      const auto tangent = verify::check_derivative([&](const double h) { return at(h).stress.membrane; },
                                                    Voigt(at(0.).tangent.membrane * half));

      INFO("orders " << stress.order << ", " << tangent.order << "; defects " << stress.smallest_defect << ", "
                     << tangent.smallest_defect);
      CHECK(stress.passed());
      CHECK(tangent.passed());
      CHECK(at(0.).tangent.membrane.isApprox(at(0.).tangent.membrane.transpose(), 1e-14));
    }
}

TEST_CASE("neo-Hooke: energies are those of Eq. (3)")
{
  verify::RandomNumbers random(12);
  for (int n = 0; n < 20; ++n)
    {
      const auto   point = verify::random_state(random, n % 2 ? 1.4 : .6).point();
      const double J = point.J, I1 = point.I1;

      CHECK(law.dilatation(point).energy == Approx(1.7 / 4 * (J * J - 1. - 2. * std::log(J))).epsilon(1e-13));
      CHECK(law.deviator(point).energy == Approx(.6 / 2 * (I1 / J - 2.)).epsilon(1e-12));
    }
}

TEST_CASE("neo-Hooke: deviatoric stress is that of theory B.1")
{
  verify::RandomNumbers random(13);
  for (int n = 0; n < 20; ++n)
    {
      const auto  point = verify::random_state(random, n % 2 ? 1.4 : .6).point();
      const Voigt expected =
          .6 / point.J * (point.reference.metric.contravariant - .5 * point.I1 * point.metric.contravariant);

      CHECK((law.deviator(point).stress.membrane - expected).norm() < 1e-13 * expected.norm());
    }
}

TEST_CASE("neo-Hooke: tiny strains give the linear energy and stress to full relative accuracy")
{
  // Metrics exact in binary, A = 1 and a = 1 + 2 eps: the difference to linear elasticity is of relative order eps.
  for (const double eps : {std::ldexp(1., -23), std::ldexp(1., -34), std::ldexp(1., -45)}) // 1.2e-7, 5.8e-11, 2.8e-14
    {
      const double              e11 = eps, e22 = -.5 * eps, e12 = .25 * eps;
      const verify::MetricState state{Voigt(1., 1., 0.), Voigt(1. + 2. * e11, 1. + 2. * e22, 2. * e12)};

      const auto dilatation = law.dilatation(state.point()), deviator = law.deviator(state.point());

      const double trace = e11 + e22, half = .5 * (e11 - e22);
      const double linear_dilatation = .5 * 1.7 * trace * trace, linear_deviator = .6 * 2. * (half * half + e12 * e12);
      const double allowed = 10. * eps + 1e-14;
      CHECK(std::abs(dilatation.energy / linear_dilatation - 1.) < allowed);
      CHECK(std::abs(deviator.energy / linear_deviator - 1.) < allowed);
      const Voigt stress = 1.7 * trace * Voigt(1., 1., 0.) + 2. * .6 * Voigt(half, -half, e12);
      CHECK(((dilatation.stress + deviator.stress).membrane - stress).norm() < allowed * stress.norm());
    }
}

TEST_CASE("neo-Hooke: e - ln(1 + e) is accurate on both sides of its switch")
{
  for (const double e : {-.5, -.1, -.0999999, -1e-3, -1e-8, 1e-12, 1e-5, .05, .0999999, .1, 2.})
    {
      // The Taylor series for small e, the definition in long double for the rest.
      const long double x = e;
      const long double exact =
          std::abs(e) < 1e-4 ? x * x * (.5L - x * (1.L / 3 - x * (.25L - x * (.2L - x / 6)))) : x - std::log1p(x);
      CHECK(std::abs(material::log_defect(e) / static_cast<double>(exact) - 1.) < 5e-15);
    }
}

TEST_CASE("neo-Hooke: a rigid motion has no energy, a rotation changes nothing")
{
  const Eigen::Matrix2d tangents{{1.2, -.2}, {.3, .9}}, F{{1.2, .3}, {-.1, .7}};
  const auto            respond = [&](const Eigen::Matrix2d &gradient) {
    const Eigen::Matrix2d a = gradient * tangents;
    const SurfacePoint<2> point(ReferencePoint<2>(metric<2>(tangents.col(0), tangents.col(1))),
                                           metric<2>(a.col(0), a.col(1)));
    return law.dilatation(point) + law.deviator(point);
  };

  for (const double angle : {.3, 1.5, 3.})
    {
      const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
      CHECK(respond(R).energy < 1e-30); // the square of rounding
      CHECK(respond(R).stress.membrane.norm() < 1e-14);
      CHECK(respond(R * F).energy == Approx(respond(F).energy).epsilon(1e-14));
      CHECK((respond(R * F).stress.membrane - respond(F).stress.membrane).norm() < 1e-14);
    }
}

TEST_CASE("neo-Hooke: tangent at rest has the moduli of theory B.3")
{
  const verify::MetricState rest{Voigt(1., 1., 0.), Voigt(1., 1., 0.)};

  const Voigt4 c = (law.dilatation(rest.point()) + law.deviator(rest.point())).tangent.membrane;

  CHECK(c(0, 0) == Approx(1.7 + .6).epsilon(1e-15));
  CHECK(c(0, 1) == Approx(1.7 - .6).epsilon(1e-15));
  CHECK(c(2, 2) == Approx(.6).epsilon(1e-15));
}

TEST_CASE("neo-Hooke: equibiaxial stretch has the surface tension of theory J.5")
{
  const double              lambda = 1.3;
  const verify::MetricState state{Voigt(1., 1., 0.), Voigt(lambda * lambda, lambda * lambda, 0.)};

  // tau^ab by reference area and parameters; sigma = tau lambda^2 / J per current length.
  const auto response = law.dilatation(state.point()) + law.deviator(state.point());

  const double tension = response.stress.membrane[0] * lambda * lambda / (lambda * lambda);
  CHECK(tension == Approx(1.7 / 2 * (lambda * lambda - std::pow(lambda, -2))).epsilon(1e-14));
  CHECK(law.deviator(state.point()).energy == 0.);
}

TEST_CASE("moduli: surface, plane stress and plane strain")
{
  const auto surface = material::surface_moduli(10., .3);
  CHECK(surface.bulk == Approx(7.142857142857143).epsilon(1e-15));
  CHECK(surface.shear == Approx(10. / 2.6).epsilon(1e-15));
  CHECK(4. * surface.bulk * surface.shear / (surface.bulk + surface.shear) == Approx(10.).epsilon(1e-15));
  CHECK((surface.bulk - surface.shear) / (surface.bulk + surface.shear) == Approx(.3).epsilon(1e-14));

  const auto sheet = material::plane_stress_moduli(10., .3, .2);
  CHECK(sheet.bulk == Approx(.2 * surface.bulk).epsilon(1e-15));
  CHECK(sheet.shear == Approx(.2 * surface.shear).epsilon(1e-15));

  // Uniaxial strain in plane strain has the modulus of longitudinal waves, E (1 - nu) / ((1 + nu) (1 - 2 nu)).
  const auto strain = material::plane_strain_moduli(10., .3);
  CHECK(strain.bulk + strain.shear == Approx(10. * .7 / (1.3 * .4)).epsilon(1e-15));
  CHECK(strain.shear == Approx(10. / 2.6).epsilon(1e-15));
}

TEST_CASE("moduli and neo-Hooke: values outside their range are refused")
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {0., -1., nan, inf})
    {
      CHECK_THROWS_AS(NeoHooke(bad, 1.), InvalidParameter);
      CHECK_THROWS_AS(NeoHooke(1., bad), InvalidParameter);
      CHECK_THROWS_AS(material::surface_moduli(bad, .3), InvalidParameter);
      CHECK_THROWS_AS(material::plane_strain_moduli(bad, .3), InvalidParameter);
      CHECK_THROWS_AS(material::plane_stress_moduli(bad, .3, 1.), InvalidParameter);
      CHECK_THROWS_AS(material::plane_stress_moduli(1., .3, bad), InvalidParameter);
    }
  for (const double bad : {-1., 1., nan})
    CHECK_THROWS_AS(material::surface_moduli(1., bad), InvalidParameter);
  for (const double bad : {-1., .5, nan})
    {
      CHECK_THROWS_AS(material::plane_strain_moduli(1., bad), InvalidParameter);
      CHECK_THROWS_AS(material::plane_stress_moduli(1., bad, 1.), InvalidParameter);
    }
  CHECK_NOTHROW(material::surface_moduli(1., .9));
}
