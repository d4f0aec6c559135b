// label: unit
// ranks: 1 2 3
#include <numbers>

#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

constexpr double now = .3;

/// A quarter of a roof whose sides are all held weakly or level in some way; x = 2 and y = 0 are planes of symmetry.
Supports weak_supports()
{
  const continuity::Penalty factors{3., 5.};
  Supports                  supports;
  supports.symmetry_weakly("right", Component::x, factors);
  supports.clamp_weakly("left", factors);
  supports.rotate(
      "top", [](double t) { return .4 + t * t; }, factors);
  supports.phase_symmetry_weakly("top", factors);
  return supports;
}

/// The roof with disturbed values, the symmetry of y = 0 by ties or not at all, alike on any number of ranks.
struct WeakRoof
{
  Surface<2, 3>    surface;
  Shell            model = shell(Toughness<3>([](double x, double y, double z) { return z + x * y; }));
  std::vector<Tie> tied;
  ShellSpace<2, 3> space;
  State<2, 3>      state;
  Assembler<Shell> assembler;

  WeakRoof(MPI_Comm comm, const Supports &supports, bool with_ties, double disorder = .02)
      : surface(refined_roof()),
        tied(with_ties ? symmetric_ties(surface) : std::vector<Tie>()),
        space(Environment(comm), surface),
        state(space),
        assembler(model, space, state.distribution, tied, supports.weak_edges())
  {
    add(disorder, random_values(), state);
  }
  WeakRoof(const WeakRoof &) = delete;

  static Surface<2, 3> refined_roof()
  {
    auto roof =
        shapes::roof<2>(3., 4., 40. * std::numbers::pi / 180., {4, 4}, shapes::Fit::exact, shapes::Part::quarter);
    refine_at_random(roof, 1, 2, 11);
    return roof;
  }

  static std::vector<Tie> symmetric_ties(const Surface<2, 3> &surface)
  {
    Supports supports;
    supports.symmetry("bottom", Component::y);
    return ties(supports, surface);
  }

  /// Numbers in [-1, 1] for every control point; tied ones follow their masters.
  Eigen::VectorXd random_values() const
  {
    std::mt19937    random(5);
    Eigen::VectorXd values(4 * space.n_points());
    for (auto &value : values)
      value = symmetric(random);
    for (const auto &tie : tied)
      {
        double &value = values[4 * tie.point + tie.field] = 0.;
        for (std::size_t k = 0; k < tie.masters.size(); ++k)
          value += tie.factors[k] * values[4 * tie.masters[k] + tie.field];
      }
    return values;
  }

  static void add(double scale, const Eigen::VectorXd &values, State<2, 3> &to)
  {
    for (int a = 0; a < to.distribution->n_local(); ++a)
      {
        const auto id = to.distribution->global(a);
        for (int c = 0; c < 3; ++c)
          to.position.local()[3 * a + c] += scale * values[4 * id + c];
        to.phase.local()[a] += scale * values[4 * id + 3];
      }
  }

  State<2, 3> moved(double scale, const Eigen::VectorXd &values) const
  {
    auto result = state;
    add(scale, values, result);
    return result;
  }

  LoadValues<Shell> at_time(double t) const { return assembler.evaluate(Loads<3>(), t); }

  Eigen::VectorXd on_all_ranks(const Vector &f) const
  {
    const auto all = gather(f);
    return Eigen::Map<const Eigen::VectorXd>(all.data(), all.size());
  }

  /// Force on all ranks.
  Eigen::VectorXd force(const State<2, 3> &at, double t = now) const
  {
    Vector f(state.distribution, 4), external = f;
    assembler.force({at.position, at.acceleration, at.phase}, at.history, at_time(t), f, external);
    return on_all_ranks(f);
  }

  double energy(const State<2, 3> &at, double t = now) const
  {
    return assembler.energies(at.position, at.velocity, at.phase, t).constraint;
  }

  Eigen::MatrixXd tangent() const
  {
    Vector f(state.distribution, 4), external = f;
    Matrix K = assembler.make_matrix();
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, 0., PhaseTangent::consistent,
                        at_time(now), f, external, K);
    return dense(K);
  }
};

double largest(const Eigen::MatrixXd &values)
{
  return values.cwiseAbs().maxCoeff();
}

} // namespace

TEST_CASE("Weak edges: forces derive from the energy, the tangent from the forces, with ties too")
{
  for (const bool with_ties : {false, true})
    {
      CAPTURE(with_ties);
      const WeakRoof held(MPI_COMM_WORLD, weak_supports(), with_ties), loose(MPI_COMM_WORLD, {}, with_ties);
      const auto     d = held.random_values();

      // Tied rows are empty; their columns, too, but for the 1 on the diagonal.
      Eigen::VectorXd free = d;
      for (const auto &tie : held.tied)
        free[4 * tie.point + tie.field] = 0.;
      const auto force   = [&](double h) { return held.force(held.moved(h, d)); };
      const auto tangent = verify::check_derivative(force, Eigen::VectorXd(held.tangent() * free), 1e-3, 8);
      CAPTURE(tangent.order, tangent.smallest_defect);
      CHECK(tangent.passed());

      const Eigen::VectorXd of_edges = held.force(held.state) - loose.force(loose.state);
      const auto            energy   = [&](double h) { return held.energy(held.moved(h, d)); };
      CHECK(energy(0.) > 1e-5);
      CHECK(loose.energy(loose.state) == 0.);
      const auto slope = verify::check_derivative(energy, of_edges.dot(free), 1e-3, 8);
      CAPTURE(slope.order, slope.smallest_defect);
      CHECK(slope.passed());
    }
}

TEST_CASE("Weak edges: what turns does work, and its rate is that of the forces")
{
  const WeakRoof roof(MPI_COMM_WORLD, weak_supports(), true);
  Vector         rate(roof.state.distribution, 4);
  roof.assembler.weak_edges().add_force_rate(roof.state.position, now, rate);
  const auto slope =
      verify::check_derivative([&](double h) { return roof.force(roof.state, now + h); }, roof.on_all_ranks(rate));
  CAPTURE(slope.order, slope.smallest_defect);
  CHECK(slope.passed());

  double work = roof.assembler.weak_edges().work(roof.state.position, .1, now);
  MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  CHECK(std::abs(work) > 1e-4);
  CHECK(work == Approx(roof.energy(roof.state, now) - roof.energy(roof.state, .1)).epsilon(1e-10));
}

TEST_CASE("Weak edges: the reference surface of a phase field without slope is free of their forces")
{
  const continuity::Penalty factors{1., 1.};
  Supports                  supports;
  supports.symmetry_weakly("right", Component::x, factors);
  supports.clamp_weakly("left", factors);
  supports.phase_symmetry_weakly("top", factors);
  const WeakRoof roof(MPI_COMM_WORLD, supports, false, 0.);
  CHECK(largest(roof.force(roof.state)) < 1e-13);
  CHECK(roof.energy(roof.state) < 1e-26);
}

TEST_CASE("Weak edges: ranks change nothing but rounding")
{
  const WeakRoof here(MPI_COMM_SELF, weak_supports(), true), roof(MPI_COMM_WORLD, weak_supports(), true);
  const auto     expected = here.force(here.state);
  CHECK(largest(roof.force(roof.state) - expected) <= 1e-13 * largest(expected));
  const auto K = here.tangent();
  CHECK(largest(roof.tangent() - K) <= 1e-13 * largest(K));
  CHECK(roof.energy(roof.state) == Approx(here.energy(here.state)).epsilon(1e-12));
}

TEST_CASE("Weak edges: what makes no sense is refused")
{
  const auto refused = [](auto declare) {
    Supports supports;
    declare(supports);
    CHECK_THROWS_AS(WeakRoof(MPI_COMM_WORLD, supports, false), InvalidParameter);
  };
  refused([](Supports &s) { s.clamp_weakly("front"); });
  refused([](Supports &s) { s.clamp_weakly("left", {-1., 0.}); });
  refused([](Supports &s) { s.phase_symmetry_weakly("left", {0., NAN}); });
  refused([](Supports &s) { s.symmetry_weakly("right", Component::y); });
  refused([](Supports &s) { s.symmetry_weakly("top", Component::z); });

  // A sheet in the plane resists no rotation, but its phase field can be level.
  Supports clamped, level;
  clamped.clamp_weakly("left");
  level.symmetry_weakly("left", Component::x);
  const auto             model = sheet();
  const auto             plate = shapes::plate<2, 2>({1., 1.}, {2, 2});
  const ShellSpace<2, 2> space(Environment(MPI_COMM_WORLD), plate);
  const State<2, 2>      state(space);
  CHECK_THROWS_AS(Assembler<Sheet>(model, space, state.distribution, {}, clamped.weak_edges()), InvalidParameter);
  CHECK_NOTHROW(Assembler<Sheet>(model, space, state.distribution, {}, level.weak_edges()));
}
