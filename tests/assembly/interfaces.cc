// label: unit
// ranks: 1 2 3
#include <numbers>

#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/geometry/split.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// A quarter of a roof in four patches, refined across their interfaces; x = 2 and y = 0 are planes of symmetry.
Surface<2, 3> patched_roof()
{
  auto roof = split_patches(
      shapes::roof<2>(3., 4., 40. * std::numbers::pi / 180., {4, 4}, shapes::Fit::exact, shapes::Part::quarter),
      {2, 2});
  refine_at_random(roof, 1, 2, 11);
  return roof;
}

std::vector<Tie> symmetric_ties(const Surface<2, 3> &surface)
{
  Supports supports;
  supports.symmetry("right", Component::x);
  supports.symmetry("bottom", Component::y);
  return ties(supports, surface);
}

/// The roof with values of all its points disturbed, alike on any number of ranks.
struct Joined
{
  Surface<2, 3>    surface = patched_roof();
  Shell            model   = shell(Toughness<3>([](double x, double y, double z) { return z + x * y; }));
  std::vector<Tie> tied;
  ShellSpace<2, 3> space;
  State<2, 3>      state;
  Assembler<Shell> assembler;

  Joined(MPI_Comm comm, Continuity continuity, const std::vector<Tie> &tied_ = {}, double disorder = .02)
      : tied(tied_),
        space(Environment(comm), surface, continuity),
        state(space),
        assembler(model, space, state.distribution, tied)
  {
    add(disorder, random_values());
  }
  Joined(const Joined &) = delete;

  /// Numbers in [-1, 1] for every point, 0 where a multiplier has no unknown; tied ones follow their masters.
  Eigen::VectorXd random_values() const
  {
    std::mt19937    random(5);
    Eigen::VectorXd values(4 * space.n_points());
    for (int i = 0; i < values.size(); ++i)
      {
        values[i] = symmetric(random);
        if (space.is_multiplier(i / 4) && i % 4 != 0 && i % 4 != 3)
          values[i] = 0.;
      }
    follow_ties(values);
    return values;
  }

  void follow_ties(Eigen::VectorXd &values) const
  {
    for (const auto &tie : tied)
      {
        double &value = values[4 * tie.point + tie.field] = 0.;
        for (std::size_t k = 0; k < tie.masters.size(); ++k)
          value += tie.factors[k] * values[4 * tie.masters[k] + tie.field];
      }
  }

  void add(double scale, const Eigen::VectorXd &values) { add(scale, values, state); }

  void add(double scale, const Eigen::VectorXd &values, State<2, 3> &to) const
  {
    for (int a = 0; a < to.distribution->n_local(); ++a)
      {
        const auto id = to.distribution->global(a);
        for (int c = 0; c < 3; ++c)
          to.position.local()[3 * a + c] += scale * values[4 * id + c];
        to.phase.local()[a] += scale * values[4 * id + 3];
      }
  }

  /// Force on all ranks of the state moved by scale * values.
  Eigen::VectorXd force(double scale, const Eigen::VectorXd &values) const
  {
    auto moved = state;
    add(scale, values, moved);
    Vector f(state.distribution, 4);
    assembler.force({moved.position, moved.acceleration, moved.phase}, moved.history, f);
    const auto all = gather(f);
    return Eigen::Map<const Eigen::VectorXd>(all.data(), all.size());
  }

  Energies energies(double scale, const Eigen::VectorXd &values) const
  {
    auto moved = state;
    add(scale, values, moved);
    return assembler.energies(moved.position, moved.velocity, moved.phase);
  }

  Eigen::MatrixXd tangent() const
  {
    Vector f(state.distribution, 4);
    Matrix K = assembler.make_matrix();
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, 0., PhaseTangent::consistent,
                        f, K);
    return dense(K);
  }
};

double largest(const Eigen::MatrixXd &values)
{
  return values.cwiseAbs().maxCoeff();
}

const std::vector<Continuity> methods = {continuity::Penalty{10., 20.}, continuity::LagrangeMultiplier{}};

} // namespace

TEST_CASE("Interfaces: forces derive from the energy, the tangent from the forces, with ties too")
{
  for (const auto &method : methods)
    for (const bool with_ties : {false, true})
      {
        CAPTURE(method.index(), with_ties);
        const auto   tied = with_ties ? symmetric_ties(patched_roof()) : std::vector<Tie>();
        const Joined joined(MPI_COMM_WORLD, method, tied), apart(MPI_COMM_WORLD, continuity::None{}, tied);
        const auto   d = joined.random_values();

        // Tied rows are empty; their columns, too, but for the 1 on the diagonal.
        Eigen::VectorXd free = d;
        for (const auto &tie : tied)
          free[4 * tie.point + tie.field] = 0.;
        const auto force   = [&](double h) { return joined.force(h, d); };
        const auto tangent = verify::check_derivative(force, Eigen::VectorXd(joined.tangent() * free), 1e-3, 8);
        CAPTURE(tangent.order, tangent.smallest_defect);
        CHECK(tangent.passed());

        // Control points come first in the numbering: what the interfaces add is the difference.
        Eigen::VectorXd of_interfaces = joined.force(0., d);
        const auto      n             = apart.random_values().size();
        of_interfaces.head(n) -= apart.force(0., d.head(n));
        const auto energy = [&](double h) { return joined.energies(h, d).constraint; };
        CHECK(std::abs(energy(0.)) > 1e-5);
        const auto slope = verify::check_derivative(energy, of_interfaces.dot(free), 1e-3, 8);
        CAPTURE(slope.order, slope.smallest_defect);
        CHECK(slope.passed());
        CHECK(apart.energies(0., d.head(n)).constraint == 0.);
      }
}

TEST_CASE("Interfaces: the reference surface of a phase field without slope is free of their forces")
{
  for (const auto &method : methods)
    {
      const Joined joined(MPI_COMM_WORLD, method, {}, 0.);
      CHECK(largest(joined.force(0., joined.random_values())) < 1e-13);
      CHECK(joined.energies(0., joined.random_values()).constraint < 1e-26);
    }
}

TEST_CASE("Interfaces: a multiplier has the equations of its constraints and nothing else")
{
  const Joined joined(MPI_COMM_WORLD, continuity::LagrangeMultiplier{});
  const auto   K = joined.tangent();
  const auto   n = 4 * joined.space.n_control_points();
  REQUIRE(joined.space.n_multipliers() > 8);
  for (int i = n; i < K.rows(); ++i)
    {
      CHECK(largest(K.row(i).head(n) - K.col(i).head(n).transpose()) < 1e-14 * largest(K.row(i)));
      const bool used = i % 4 == 0 || i % 4 == 3;
      CHECK((K(i, i) < 0.) == used);
      if (!used)
        CHECK(K.row(i).cwiseAbs().sum() == 1.);
      else
        {
          CHECK(largest(K.row(i).head(n)) > 1e-2);
          CHECK(std::abs(K(i, i)) < 1e-3 * largest(K.row(i)));
        }
    }
}

TEST_CASE("Interfaces: of bending lasts what the split leaves")
{
  const auto model = [](const auto &share) {
    return Shell(StretchSplit(material::NeoHooke(1., .6), material::Canham(1e-3), share), degradation::Cubic(1e-4), {},
                 1., .2, 1.);
  };
  for (const double radius : {.1, 1., 10.})
    {
      CHECK(internal::lasting_bending(model(LayerSettings{.thickness = .01}), radius) == Approx(.5).epsilon(1e-12));
      CHECK(internal::lasting_bending(model(BendingPart::active), radius) == 0.);
      CHECK(internal::lasting_bending(model(BendingPart::passive), radius) == 1.);
    }
}

TEST_CASE("Interfaces: the penalty of the angle goes with the sheet's degradation, and nothing else changes")
{
  Joined       joined(MPI_COMM_WORLD, continuity::Penalty{});
  const Joined apart(MPI_COMM_WORLD, continuity::None{});
  const auto   soften = [&](double phi) {
    Vector phase = joined.state.phase;
    phase.fill(phi);
    joined.assembler.soften_interfaces(phase);
  };
  const auto displacements = [&](Eigen::MatrixXd K) { // without the rows of the phase
    for (int i = 3; i < K.rows(); i += 4)
      K.row(i).setZero();
    return K;
  };
  soften(1.);
  const Eigen::MatrixXd sheet = displacements(apart.tangent()), intact = displacements(joined.tangent()) - sheet;
  REQUIRE(largest(intact) > 0.);
  for (const double phi : {0., .1, .5})
    {
      soften(phi);
      const double          g     = joined.assembler.model().degradation.value(phi);
      const Eigen::MatrixXd terms = displacements(joined.tangent()) - sheet;
      // The sheet itself is not softened by it: what the interfaces add is a small difference of tangents.
      // Layers: half of bending outlasts a crack.
      CHECK(largest(terms - (.5 + .5 * g + 1e-6) / (1. + 1e-6) * intact) < 1e-12 * largest(joined.tangent()));
      const auto d      = joined.random_values();
      const auto energy = [&](double h) { return joined.energies(h, d).constraint; };
      const auto slope  = verify::check_derivative(energy, (joined.force(0., d) - apart.force(0., d)).dot(d), 1e-3, 8);
      CAPTURE(phi, slope.order, slope.smallest_defect);
      CHECK(slope.passed());
    }
}

TEST_CASE("Interfaces: the multiplier of the angle is soft where the sheet is broken, and nothing else changes")
{
  Joined     joined(MPI_COMM_WORLD, continuity::LagrangeMultiplier{});
  const auto soften = [&](double phi) {
    Vector phase = joined.state.phase;
    phase.fill(phi);
    joined.assembler.soften_interfaces(phase);
    return joined.tangent();
  };
  const auto   intact = soften(1.), before = joined.tangent();
  const double least = 1e-6 * continuity::penalty_factor(2) / InterfaceTerms<Shell>::multiplier_factor;
  CHECK(largest(intact - before) == 0.);
  for (const double phi : {0., .1, .5})
    {
      const auto   K = soften(phi);
      const double g = joined.assembler.model().degradation.value(phi);
      for (int i = 4 * joined.space.n_control_points(); i < K.rows(); i += 4)
        CHECK(K(i, i) / intact(i, i) == Approx((1. + least) / (.5 + .5 * g + least)).epsilon(1e-12));
      Eigen::MatrixXd change = K - intact;
      for (int i = 4 * joined.space.n_control_points(); i < K.rows(); i += 4)
        change(i, i) = 0.;
      CHECK(largest(change) == 0.);

      const auto      d      = joined.random_values();
      const auto      energy = [&](double h) { return joined.energies(h, d).constraint; };
      const Joined    apart(MPI_COMM_WORLD, continuity::None{});
      Eigen::VectorXd of_interfaces = joined.force(0., d);
      of_interfaces.head(4 * joined.space.n_control_points()) -=
          apart.force(0., d.head(4 * joined.space.n_control_points()));
      const auto slope = verify::check_derivative(energy, of_interfaces.dot(d), 1e-3, 8);
      CAPTURE(phi, slope.order, slope.smallest_defect);
      CHECK(slope.passed());
    }
}

TEST_CASE("Interfaces: ranks change nothing but rounding")
{
  for (const auto &method : methods)
    {
      const auto   tied = symmetric_ties(patched_roof());
      const Joined here(MPI_COMM_SELF, method, tied), body(MPI_COMM_WORLD, method, tied);
      const auto   d = here.random_values(), expected = here.force(0., d);
      CHECK(largest(body.force(0., d) - expected) <= 1e-13 * largest(expected));
      const auto K = here.tangent();
      CHECK(largest(body.tangent() - K) <= 1e-13 * largest(K));
      CHECK(body.energies(0., d).constraint == Approx(here.energies(0., d).constraint).epsilon(1e-12));
    }
}

TEST_CASE("Interfaces: factors of penalties have to be positive")
{
  CHECK_THROWS_AS(Joined(MPI_COMM_WORLD, continuity::Penalty{-1., 0.}), InvalidParameter);
}
