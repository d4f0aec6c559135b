// label: verification
#include <numbers>

#include <catch2/catch.hpp>

#include <forms/element_problem.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Control values of one element of an intact body whose positions are the control points of @p deformed.
template <class Model>
Eigen::VectorXd unknowns(const ElementProblem<Model> &problem, const ControlValues<3> &deformed)
{
  Eigen::VectorXd y(4 * problem.n_points());
  for (int A = 0; A < problem.n_points(); ++A)
    y.segment<4>(4 * A) << deformed.row(problem.data.geometry.points[A]).transpose(), 1.;
  return y;
}

template <class Model>
Energies total_energies(const Model &model, const Surface<Model::degree, 3> &reference,
                        const ControlValues<3> &deformed)
{
  Energies sum;
  for (int e = 0; e < reference.n_elements(); ++e)
    {
      const ElementProblem<Model> problem(model, reference, e);
      const auto                  y = unknowns(problem, deformed);
      sum += problem.energies(y, 0. * y);
    }
  return sum;
}

constexpr double K = 2.1, G = 1.3, c = .4;

/// A flat strip of 1 x 1.2 R / stretch, bent to an arc of 1.2 rad of a cylinder of radius R, with surface strain
/// stretch - 1 in both directions. Its layers at xi have J (1 + xi / R).
template <int degree>
Energies bent_strip(double R, double T, double stretch, LayerMetric metric = LayerMetric::full)
{
  const auto model    = sample_model<StretchShell<degree>>({.thickness = T, .metric = metric});
  const auto cylinder = shapes::cylinder<degree>(R, 1., {-.6, .6}, {2, 8}, shapes::Fit::smooth);
  const auto strip    = shapes::plate<degree, 3>({1. / stretch, 1.2 * R / stretch}, {2, 8});
  return total_energies(model, strip, cylinder.control_points());
}

} // namespace

TEMPLATE_TEST_CASE_SIG("Half of the energy of pure bending is active", "", ((int degree), degree), 2, 3, 4)
{
  const double R = 2., T = .3, area = 1.2 * R;
  const auto   e = bent_strip<degree>(R, T, 1.);
  // The arc is a spline: of degree 2 to 4 its curvature is off by O(h^2) or less, its length by 1e-4 or less.
  const double tolerance = degree == 2 ? 4e-3 : degree == 3 ? 5e-4 : 1e-6;
  CHECK(e.elastic() == Approx(.5 * c / (R * R) * area).epsilon(tolerance));
  CHECK(e.active == Approx(.5 * e.elastic()).epsilon(tolerance));
}

TEST_CASE("Layers of a stretched and bent strip")
{
  const double R = 2., T = .3;
  const auto   metric = GENERATE(LayerMetric::full, LayerMetric::linear);
  // Strains at which all layers are stretched, all are compressed, and two with a cut.
  const double stretch = GENERATE(1.1, .9, 1.01, .98);
  const double J = stretch * stretch, area = 1.2 * R / J;
  const auto   e       = bent_strip<4>(R, T, stretch, metric);
  const double bending = .5 * c * std::pow(J / R, 2);
  const double dil     = K / 4. * (J * J - 1. - 2. * std::log(J));
  // J (1 + xi / R) = 1, or J (1 + 2 xi / R)^(1/2) = 1
  const double cut = metric == LayerMetric::full ? R * (1. / J - 1.) : .5 * R * (1. / (J * J) - 1.);
  const double w   = std::abs(cut) > T / 2. ? (J > 1. ? 1. : 0.) : .5 - 4. * std::pow(cut / T, 3);
  CAPTURE(stretch, cut, w);
  REQUIRE((w > 0. && w < 1.) == (std::abs(stretch - 1.) < .05));
  CHECK(e.active == Approx(area * (w * bending + (J > 1. ? dil : 0.))).epsilon(1e-4).margin(1e-6));
  CHECK(e.passive == Approx(area * ((1. - w) * bending + (J > 1. ? 0. : dil))).epsilon(1e-4).margin(1e-6));
}

TEST_CASE("Inside a sphere patch the pressure of spherical inflation balances the shell")
{
  using Model         = StretchShell<4>;
  const double R      = 1.5;
  const double lambda = GENERATE(1.3, .8);
  const double p     = K / R * (lambda - std::pow(lambda, -3)) + 2. * c * (lambda - 1.) / (R * R * R * lambda * lambda);
  const auto   model = sample_model<Model>({.thickness = .2});
  const auto   residual = [&](int n, double pressure) {
    const auto                               sphere = shapes::sphere_patch<4>(R, {n, n}, shapes::Fit::exact);
    const ControlValues<3>                   x      = lambda * sphere.control_points();
    Eigen::Matrix<double, Eigen::Dynamic, 3> sum    = Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(x.rows(), 3);
    Eigen::VectorXd                          scale  = Eigen::VectorXd::Zero(x.rows());
    for (int e = 0; e < sphere.n_elements(); ++e)
      {
        ElementProblem<Model> problem(model, sphere, e);
        const auto            y = unknowns(problem, x);
        const auto            f = problem.force(y, {});
        problem.pressure.emplace();
        problem.pressure->constant.fill(pressure);
        problem.pressure->by_phase.fill(0.);
        const auto total = problem.force(y, {});
        for (int A = 0; A < problem.n_points(); ++A)
          {
            const int i = problem.data.geometry.points[A];
            sum.row(i) += total.segment<3>(4 * A).transpose();
            scale[i] += (total - f).segment<3>(4 * A).norm();
          }
      }
    // Functions that vanish on the border together with their first derivatives.
    const int rows    = n + 4;
    double    largest = 0.;
    for (int j = 2; j < rows - 2; ++j)
      for (int i = 2; i < rows - 2; ++i)
        largest = std::max(largest, sum.row(j * rows + i).norm() / scale[j * rows + i]);
    return largest;
  };
  // Relative to the pressure on a function. The integrands are rational: what remains is the error of the Gauss rule,
  // of order 10 for smooth integrands and less by the two derivatives of the function in the moment's part.
  const double coarse = residual(2, p), middle = residual(4, p), fine = residual(8, p);
  CAPTURE(lambda, coarse, middle, fine);
  CHECK(std::log2(coarse / middle) > 6.5);
  CHECK(std::log2(middle / fine) > 6.5);
  CHECK(fine < 1e-9);
  CHECK(residual(4, 1.001 * p) > 5e-4);
}
