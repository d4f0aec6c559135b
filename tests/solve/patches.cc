// label: verification
// ranks: 1 2 3
#include <cstdlib>
#include <map>
#include <optional>

#include <catch2/catch.hpp>

#include <Eigen/LU>

#include <assembly/body.h>
#include <geometry/joined_surfaces.h>
#include <solve/breathing_sphere.h>
#include <solve/linear_benchmarks.h>
#include <sherd/geometry/shapes/sphere.h>
#include <sherd/geometry/split.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Deflection at the centre of a simply supported unit square with the energy (lap w)^2 / 2 (shear modulus next to
/// zero) and unit load, of two patches that meet on the centre line, relative to the exact one. This energy does not
/// resist torsion, so that the plate needs its continuity more than others.
template <int degree>
double plate_error(int n, const Continuity &continuity)
{
  constexpr double exact = .00406235, no_shear = 1e-6;
  Supports         supports;
  supports.fix(WholeSurface{}, Component::x);
  supports.fix(WholeSurface{}, Component::y);
  for (const auto edge : {"left", "right", "bottom", "top"})
    supports.fix(edge, Component::z);
  Loads<3> loads;
  loads.surface_load([](const Point<3> &, double t) { return Point<3>(0., 0., t); });
  const material::Moduli moduli{12. * (1. - no_shear), 12. * no_shear};
  KoiterBody<degree>     body(
          KoiterBody<degree>::make_model(material::StVenantKirchhoff(moduli), material::Koiter(moduli, 1.)),
          split_patches(shapes::plate<degree, 3>({1., 1.}, {n, n}), {2, 1}), supports, loads, {}, continuity);
  return body.displacement(body.solver.solve_linear(body.state, 1.), .5 * n, .5 * n)[2] / exact - 1.;
}

Continuity penalty(double factor)
{
  return continuity::Penalty{factor, factor};
}

const Continuity multiplier = continuity::LagrangeMultiplier{};

/// Energy of a crack across a strip by its width and Gc, phase field and continuity together. The strip is 16 l0 long;
/// the phase is held at zero in its middle, which is where two patches meet or an element border in one.
/// @param continuity   of the two patches; none: one patch
double crack_in_strip(int elements_per_length_scale, const std::optional<Continuity> &continuity)
{
  constexpr double length = 16., width = .5;
  const int        n       = static_cast<int>(length) * elements_per_length_scale;
  auto             surface = shapes::plate<2, 2>({length, width}, {n, 1});
  if (continuity)
    surface = split_patches(surface, {2, 1});
  Sheet model        = sheet(1.);
  model.length_scale = 1.;
  const ShellSpace<2, 2> space(Environment(MPI_COMM_SELF), surface, continuity.value_or(continuity::None()));
  State<2, 2>            state(space);
  const Assembler<Sheet> assembler(model, space, state.distribution);
  Vector                 force(state.distribution, 3);
  Matrix                 matrix = assembler.make_matrix();
  assembler.linearise({state.position, state.acceleration, state.phase}, state.history, 0., PhaseTangent::consistent,
                      force, matrix);

  // The energy is quadratic in phi - 1: its minimum among fields that are the same across the strip, as at the middle
  // of a long crack, with phi = 0 in the middle. One column for each x, and one for the multiplier. In one patch phi is
  // the mean of two control values there, which are equal.
  const Eigen::MatrixXd       all = dense(matrix)(Eigen::seq(2, Eigen::last, 3), Eigen::seq(2, Eigen::last, 3));
  const auto                  X   = surface.control_points();
  std::map<std::int64_t, int> columns;
  const auto                  column = [&](int point) {
    const std::int64_t key = space.is_multiplier(point) ? point : -std::llround(1e6 * X(point, 0)) - 1;
    return columns.emplace(key, static_cast<int>(columns.size())).first->second;
  };
  for (int i = 0; i < space.n_points(); ++i)
    column(i);
  Eigen::MatrixXd same = Eigen::MatrixXd::Zero(space.n_points(), static_cast<Eigen::Index>(columns.size()));
  for (int i = 0; i < space.n_points(); ++i)
    same(i, column(i)) = 1.;
  Eigen::MatrixXd K     = same.transpose() * all * same;
  Eigen::VectorXd b     = Eigen::VectorXd::Zero(K.rows());
  const double    reach = continuity ? 1e-6 : .51 / elements_per_length_scale;
  for (int i = 0; i < space.n_control_points(); ++i)
    if (std::abs(X(i, 0) - .5 * length) < reach)
      {
        K.row(column(i)).setZero();
        K(column(i), column(i)) = 1.;
        b[column(i)]            = -1.;
      }
  const Eigen::VectorXd change = same * K.partialPivLu().solve(b);
  for (int a = 0; a < space.n_points(); ++a)
    state.phase.local()[a] += change[state.distribution->global(a)];
  const auto energies = assembler.energies(state.position, state.velocity, state.phase);
  return (energies.fracture + energies.constraint) / width;
}

} // namespace

// Theory G.3, two digits: the penalty's own error is 2.7 h / beta, the rest is that of the elements. A multiplier is
// the limit at degree 2; at degree 3 one value a piece is less than the elements could do.
TEST_CASE("Plate of two patches: errors of both methods")
{
  CHECK(plate_error<2>(8, penalty(1.)) == Approx(3.4e-1).epsilon(.02));
  CHECK(plate_error<2>(8, penalty(10.)) == Approx(3.0e-2).epsilon(.02));
  CHECK(plate_error<2>(8, penalty(1e2)) == Approx(-1.3e-3).epsilon(.05));
  CHECK(plate_error<2>(8, penalty(1e3)) == Approx(-4.3e-3).epsilon(.02));
  CHECK(plate_error<2>(8, continuity::Penalty()) == Approx(-4.3e-3).epsilon(.02));
  CHECK(plate_error<2>(8, penalty(1e5)) == Approx(-4.68e-3).epsilon(.005));
  CHECK(plate_error<2>(8, multiplier) == Approx(-4.69e-3).epsilon(.005));
  CHECK(plate_error<2>(16, continuity::Penalty()) == Approx(-9.8e-4).epsilon(.02));
  CHECK(plate_error<2>(16, multiplier) == Approx(-1.15e-3).epsilon(.01));

  CHECK(plate_error<3>(8, penalty(1e2)) == Approx(3.5e-3).epsilon(.02));
  CHECK(plate_error<3>(8, continuity::Penalty()) == Approx(7.2e-5).epsilon(.03));
  CHECK(plate_error<3>(8, multiplier) == Approx(-2.5e-3).epsilon(.03));
  CHECK(plate_error<3>(16, continuity::Penalty()) == Approx(2.0e-5).epsilon(.1));
  CHECK(plate_error<3>(16, multiplier) == Approx(-1.9e-4).epsilon(.05));
}

TEST_CASE("Plate of two patches: without continuity it hangs from a hinge")
{
  CHECK(plate_error<2>(8, continuity::None{}) > 50.);
}

// Theory G.2: half the crack with the slope s of phi at the interface costs 1/8 (3 + (1 - 2 s l0)^2) Gc, so that a
// penalty leaves 1/4 / (1 + beta l0 / h) to Gc. Elements add 1.3 % at h = l0/2 and 0.3 % at l0/4, on an interface and
// on the border of two elements of one patch alike.
TEST_CASE("A crack on an interface costs Gc with continuity, three quarters of it without")
{
  for (const int per_length_scale : {2, 4})
    {
      const auto   energy = [&](const auto &method) { return crack_in_strip(per_length_scale, method); };
      const double none = energy(continuity::None{}), full = energy(multiplier), in_patch = energy(std::nullopt);
      CHECK(none == Approx(.75).margin(.002));
      CHECK(full > 1.);
      CHECK(full == Approx(1.).epsilon(per_length_scale == 2 ? .014 : .004));
      for (const double beta : {1., 10., 100.})
        CHECK((full - energy(penalty(beta))) / (full - none) ==
              Approx(1. / (1. + beta * per_length_scale)).epsilon(.05));
      CHECK(full == Approx(in_patch).epsilon(1e-5));
      CHECK(energy(continuity::Penalty()) == Approx(in_patch).epsilon(1e-3));
    }
}

// Four patches in place of one, which gives 0.300584 on 8 x 8 elements and converges to 0.300592 (theory J.2). The
// borders of patches add freedom along them, so that each mesh is a little softer than that of one patch.
TEST_CASE("Scordelis-Lo roof of four patches")
{
  const auto middle_of_free_edge = [](const Continuity &continuity, int n) {
    const auto    whole = roof<3>(n);
    KoiterBody<3> body(4.32e8, 0., .25, split_patches(whole.surface, {2, 2}), whole.supports, whole.loads, {},
                       continuity);
    return -body.displacement(body.solver.solve_linear(body.state, 1.), n, n, 3)[2];
  };
  for (const auto &method : {Continuity(continuity::Penalty()), multiplier})
    {
      const double coarse = middle_of_free_edge(method, 8), fine = middle_of_free_edge(method, 16);
      INFO(coarse << " " << fine);
      CHECK(coarse == Approx(.300592).epsilon(5e-4));
      CHECK(fine == Approx(.300592).epsilon(5e-5));
      CHECK(std::abs(fine - .300592) < std::abs(coarse - .300592));
    }
}

namespace
{

/// Largest deviations over 28 steps, by the amplitude.
struct Breath
{
  double   defect = 0., spread = 0.; ///< of the mean radius from the exact one; of the radius over the surface
  Energies energies;                 ///< at the end
};

/// Theory J.5: the paper's balloon without a crack, under its pressure from t = 0 on.
Breath breathe(const Surface<2, 3> &surface, const Continuity &method, int n)
{
  constexpr double modulus = 10., nu = .3, c = 1e-5, pressure = .1, period = 1.175476;
  const double     K = .5 * modulus / (1. - nu), G = .5 * modulus / (1. + nu);
  const Breathing  exact(K, c, pressure);
  const double     amplitude = exact.stretch(.5 * period) - 1.;
  CHECK(amplitude == Approx(.00703277).epsilon(1e-5));

  const models::Shell balloon(split::SurfaceStretch(material::NeoHooke(K, G), material::Canham(c), {.thickness = 1e-4}),
                              degradation::Cubic(1e-4), {}, 1., .2, 1.);
  const Environment   env(MPI_COMM_WORLD);
  const Supports      none;
  Loads<3>            loads;
  loads.pressure([](const Point<3> &, double) { return pressure; }, PressureRelease::none);
  const ShellSpace<2, 3>                            space(env, surface, method);
  State<2, 3>                                       state(space);
  MonolithicSolver<models::Shell, GeneralizedAlpha> solver(balloon, space, none, loads, GeneralizedAlpha(1.), {});
  solver.rebuild(state);
  solver.set_initial_acceleration(state);
  Breath breath;
  for (int step = 0; step < 28; ++step)
    {
      auto result = solver.attempt(state, .0125 * period);
      REQUIRE(result.state);
      state                  = std::move(*result.state);
      const auto [low, high] = stretches(surface, state, n);
      breath.defect = std::max(breath.defect, std::abs(.5 * (low + high) - exact.stretch(state.time)) / amplitude);
      breath.spread = std::max(breath.spread, (high - low) / amplitude);
    }
  breath.energies = solver.energies(state);
  return breath;
}

} // namespace

TEST_CASE("Sphere of six patches under a step of pressure breathes as one")
{
  for (const auto &method : {Continuity(continuity::Penalty()), multiplier})
    {
      CAPTURE(method.index());
      const auto breath = breathe(shapes::sphere<2>(1., 4), method, 4);
      CAPTURE(breath.defect, breath.spread);
      CHECK(breath.defect < 1e-3);
      CHECK(breath.spread < 1e-2);
    }
}

// The patches of a sphere in any place and with parameters that run any way are the same surface; what differs is
// within the tolerance of Newton's method.
TEST_CASE("Sphere of six patches: its patches may lie anywhere and run any way")
{
  const Eigen::Matrix3d    R       = Eigen::AngleAxisd(.7, Point<3>(1., -2., .5).normalized()).toRotationMatrix();
  const auto               plain   = shapes::sphere<2>(1., 4);
  const auto               rotated = shapes::sphere<2>(1., 4, shapes::Fit::rational, R);
  std::vector<Patch<2, 3>> patches;
  for (int p = 0; p < 6; ++p) // turned by a right angle about their middle, ways that keep the normal outward
    patches.push_back(reoriented(rotated.patch(p), std::array{0, 3, 5, 6, 5, 3}[p]));
  const Surface<2, 3> turned(patches, {}, find_interfaces(patches));
  for (const auto &method : {Continuity(continuity::Penalty()), multiplier})
    {
      const auto before = breathe(plain, method, 4);
      for (const auto &surface : {rotated, turned})
        {
          const auto now = breathe(surface, method, 4);
          CHECK(now.energies.elastic() == Approx(before.energies.elastic()).epsilon(1e-5));
          CHECK(now.energies.kinetic == Approx(before.energies.kinetic).epsilon(1e-5));
          CHECK(now.defect == Approx(before.defect).margin(1e-5));
          CHECK(now.spread == Approx(before.spread).margin(1e-5));
        }
    }
}
