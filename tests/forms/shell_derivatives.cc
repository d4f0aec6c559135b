// label: unit
#include <catch2/catch.hpp>

#include <forms/element_problem.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Which sample deformation: layers are cut by change of sign in all, some or no points.
enum class Bending
{
  tension,     ///< J about 1.3, thin: no cuts
  compression, ///< J about .75, thin: no cuts
  cut          ///< J about 1, thick: most points are cut
};

constexpr double smooth_step = 2e-3, cut_step = 5e-4; // cuts move quickly with the deformation

/// Difference quotients of second derivatives on the small elements of local refinement are rounded sooner.
template <class Problem>
int n_steps(const Problem &problem)
{
  return problem.area() < .1 ? 8 : 10;
}

struct SampleState
{
  Eigen::VectorXd y, direction;
  int             n_cuts = 0; ///< over the quadrature points
};

LayerSettings sample_layers(Shape shape, Bending bending, Cut cut)
{
  return bending == Bending::cut ? thick_layers(shape, cut) : LayerSettings{.thickness = .02, .cut = cut};
}

/// Cuts of every point, and on which side J is; less than nothing where a cut is nearly lost or nearly double.
template <class Problem>
std::vector<int> cuts(const Problem &problem, const LayerSettings &layers, const Eigen::VectorXd &y)
{
  std::vector<int> result;
  for (int q = 0; q < problem.n_q; ++q)
    {
      const auto point   = problem.point(y, q);
      const auto stretch = layer_stretch(point, layers.thickness, layers.metric);
      const auto weight  = thickness_weight(stretch);
      const auto scale   = std::abs(stretch.q[0]) + std::abs(stretch.q[1]) + std::abs(stretch.q[2]);
      const auto steep   = [&](int i) { return std::abs(stretch.slope(weight.cuts[i])) > .2 * scale; };
      bool       clear   = true;
      for (int i = 0; i < weight.n_cuts; ++i)
        clear = clear && steep(i);
      result.push_back(clear ? weight.n_cuts + (point.J > 1. ? 10 : 0) : -1);
    }
  return result;
}

/// The same position with its middle at the origin, so that positions are rounded like differences of positions.
Eigen::VectorXd centred(Eigen::VectorXd y)
{
  Point<3>           middle = Point<3>::Zero();
  const Eigen::Index n      = y.size() / 4;
  for (Eigen::Index A = 0; A < n; ++A)
    middle += y.segment<3>(4 * A) / n;
  for (Eigen::Index A = 0; A < n; ++A)
    y.segment<3>(4 * A) -= middle;
  return y;
}

/// A random deformation whose energy is smooth along a random direction, over the step of the difference quotients.
template <class Problem>
SampleState smooth_state(const Problem &problem, const LayerSettings &layers, Bending bending, double step)
{
  const double size = std::sqrt(problem.area());
  const double J    = bending == Bending::tension ? 1.3 : bending == Bending::compression ? .75 : 1.02;
  for (unsigned seed = 1; seed < 400; ++seed)
    {
      SampleState state;
      state.y = centred(problem.deformed(deformation<3>(J), (bending == Bending::cut ? .04 : .02) * size, seed));
      const Eigen::VectorXd d = random_vector(state.y.size(), seed + 1000);
      state.direction         = only<3>(Part::u, d) * size + only<3>(Part::phi, d);
      const auto here         = cuts(problem, layers, state.y);
      bool       smooth       = std::find(here.begin(), here.end(), -1) == here.end();
      for (const double h : {-1., -.5, .5, 1.})
        smooth = smooth && cuts(problem, layers, state.y + h * step * state.direction) == here;
      for (const int n : here)
        state.n_cuts += n % 10;
      if (smooth && (state.n_cuts > 0) == (bending == Bending::cut))
        return state;
    }
  FAIL("no smooth state among the random ones");
  return {};
}

template <class Problem>
void check_tangent(const Problem &problem, const SampleState &state, const typename Problem::History &history,
                   double step)
{
  const auto tangent = problem.linearise(state.y, history).matrix;
  for (const auto column : {Part::u, Part::phi})
    {
      const Eigen::VectorXd d = only<3>(column, state.direction);
      for (const auto row : {Part::u, Part::phi})
        {
          const auto check =
              verify::check_derivative([&](double h) { return only<3>(row, problem.force(state.y + h * d, history)); },
                                       only<3>(row, tangent * d), step, n_steps(problem));
          CAPTURE(static_cast<int>(row), static_cast<int>(column), check.order, check.smallest_defect);
          CHECK(check.passed());
        }
    }
}

template <class Problem>
void check_force(const Problem &problem, const SampleState &state, double step)
{
  const auto check = verify::check_derivative([&](double h) { return problem.energy(state.y + h * state.direction); },
                                              problem.force(state.y, {}).dot(state.direction), step, n_steps(problem));
  CAPTURE(check.order, check.smallest_defect);
  CHECK(check.passed());
  const auto K = problem.linearise(state.y, {}).matrix;
  CHECK((K - K.transpose()).norm() < 1e-13 * K.norm());
}

double step_of(Bending bending)
{
  return bending == Bending::cut ? cut_step : smooth_step;
}

ElementPressure<StretchShell<2>> sample_pressure()
{
  ElementPressure<StretchShell<2>> p;
  for (int q = 0; q < p.n_q; ++q)
    {
      p.constant[q] = .7 + .1 * q;
      p.by_phase[q] = -.4 + .2 * q;
    }
  return p;
}

} // namespace

TEMPLATE_TEST_CASE("Every block of a split shell's tangent is the derivative of its force", "", StretchShell<2>,
                   StretchShell<3>, StretchShell<4>)
{
  const auto shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const auto bending = GENERATE(Bending::tension, Bending::compression, Bending::cut);
  const auto cut     = GENERATE(Cut::frozen, Cut::kept);
  const auto layers  = sample_layers(shape, bending, cut);
  const auto problem = sample_problem<TestType>(shape, layers);
  CAPTURE(static_cast<int>(shape), static_cast<int>(bending), static_cast<int>(cut), problem.n_points());
  if (shape == Shape::overloaded)
    REQUIRE(problem.n_points() > (TestType::degree + 1) * (TestType::degree + 1));

  const auto state = smooth_state(problem, layers, bending, step_of(bending));
  for (const auto past : {Past::loading, Past::both})
    {
      CAPTURE(static_cast<int>(past));
      check_tangent(problem, state, past_history(problem, state.y, past), step_of(bending));
    }

  // Force and energy: exact with kept cuts; frozen ones leave the force out of balance with the energy where they are.
  if (cut == Cut::kept || bending != Bending::cut)
    check_force(problem, state, step_of(bending));
  else
    {
      const auto K = problem.linearise(state.y, {}).matrix;
      CHECK((K - K.transpose()).norm() > 1e-4 * K.norm());
    }
}

TEMPLATE_TEST_CASE("So it is without a split, and the force is the derivative of the energy", "", WholeShell<2>,
                   WholeShell<3>, WholeShell<4>, KoiterShell<2>, KoiterShell<3>, KoiterShell<4>)
{
  const auto   shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const auto   problem = sample_problem<TestType>(shape);
  const double size    = std::sqrt(problem.area());
  CAPTURE(static_cast<int>(shape), problem.n_points());
  SampleState state;
  state.y                 = centred(problem.deformed(deformation<3>(1.1), .04 * size, 3));
  const Eigen::VectorXd d = random_vector(state.y.size(), 17);
  state.direction         = only<3>(Part::u, d) * size + only<3>(Part::phi, d);
  check_tangent(problem, state, past_history(problem, state.y, Past::loading), smooth_step);
  check_tangent(problem, state, past_history(problem, state.y, Past::both), smooth_step);
  check_force(problem, state, smooth_step);
}

TEST_CASE("The layers of the thin-shell metric are differentiated as well")
{
  const auto layers  = thick_layers(Shape::distorted, GENERATE(Cut::frozen, Cut::kept), LayerMetric::linear);
  const auto problem = sample_problem<StretchShell<2>>(Shape::distorted, layers);
  const auto state   = smooth_state(problem, layers, Bending::cut, cut_step);
  check_tangent(problem, state, past_history(problem, state.y, Past::both), cut_step);
  if (layers.cut == Cut::kept)
    check_force(problem, state, cut_step);
}

TEST_CASE("A tangent of fixed weights is symmetric")
{
  auto layers             = thick_layers(Shape::rational);
  layers.tangent          = CutTangent::dropped;
  const auto      problem = sample_problem<StretchShell<3>>(Shape::rational, layers);
  const auto      state   = smooth_state(problem, layers, Bending::cut, cut_step);
  const auto      K       = problem.linearise(state.y, past_history(problem, state.y, Past::unloading)).matrix;
  Eigen::MatrixXd u(3 * problem.n_points(), 3 * problem.n_points());
  for (int A = 0; A < problem.n_points(); ++A)
    for (int B = 0; B < problem.n_points(); ++B)
      u.block<3, 3>(3 * A, 3 * B) = K.block<3, 3>(4 * A, 4 * B);
  CHECK((u - u.transpose()).norm() < 1e-14 * u.norm());
}

TEST_CASE("With a pressure, the tangent is the derivative of internal less external force")
{
  const auto shape   = GENERATE(Shape::distorted, Shape::overloaded, Shape::rational);
  const auto layers  = thick_layers(shape);
  auto       problem = sample_problem<StretchShell<2>>(shape, layers);
  const auto state   = smooth_state(problem, layers, Bending::cut, cut_step);
  const auto history = past_history(problem, state.y, Past::both);
  const auto without = problem.linearise(state.y, history);
  problem.pressure   = sample_pressure();
  const auto with    = problem.linearise(state.y, history);
  check_tangent(problem, state, history, cut_step);
  CHECK(only<3>(Part::u, with.force - without.force).norm() > .1 * problem.area());
  CHECK(only<3>(Part::phi, with.force - without.force).norm() == 0.);
}

TEMPLATE_TEST_CASE("The inertia of a shell is its mass matrix times the acceleration", "", StretchShell<2>,
                   KoiterShell<3>, KoiterShell<4>)
{
  const auto problem = sample_problem<TestType>(GENERATE(Shape::overloaded, Shape::rational));
  const auto y       = problem.deformed(deformation<3>(1.1), .03, 3);
  // Far more mass than stiffness, which is subtracted.
  const Eigen::MatrixXd M = (problem.linearise(y, {}, 1e6).matrix - problem.linearise(y, {}, 0.).matrix) / 1e6;
  const auto            a = random_vector(y.size(), 2);
  CHECK((problem.force(y, {}, a) - problem.force(y, {}) - M * a).norm() < 1e-12 * (1. + (M * a).norm()));
  CHECK(problem.energies(y, a).kinetic == Approx(.5 * a.dot(M * a)).epsilon(1e-12));
  for (int c = 0; c < 4; ++c)
    for (int d = 0; d < 4; ++d)
      {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(y.size()), column = row;
        for (int A = 0; A < problem.n_points(); ++A)
          row[4 * A + c] = 1., column[4 * A + d] = 1.;
        const double expected = c == d && c < 3 ? problem.model.mass * problem.area() : 0.;
        CHECK(row.dot(M * column) == Approx(expected).margin(1e-12));
      }
}

TEMPLATE_TEST_CASE("The force of a shell comes with and without its tangent", "", StretchShell<2>, KoiterShell<4>)
{
  const auto problem = sample_problem<TestType>(Shape::rational);
  const auto y       = problem.deformed(deformation<3>(1.2), .03, 5);
  const auto history = past_history(problem, y, Past::both);
  const auto force   = problem.force(y, history);
  CHECK((force - problem.linearise(y, history, 2.).force).norm() < 1e-15 * force.norm()); // one code, compiled twice
}
