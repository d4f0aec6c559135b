// label: unit
// ranks: 1 3
#include <numbers>

#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/geometry/split.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Rows of the fields of a part of a system with @p n_fields fields a point.
std::vector<int> rows_of(Unknowns part, int n_fields, Eigen::Index n_rows)
{
  const auto       range = fields_of(part, n_fields - 1);
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(n_rows); ++i)
    if (range.contains(i % n_fields))
      rows.push_back(i);
  return rows;
}

double largest(const Eigen::MatrixXd &values)
{
  return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.;
}

Eigen::VectorXd all_values(const Vector &v)
{
  const auto values = gather(v);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Half problems are the rows and columns of the whole, up to the order of its sums.
template <Unknowns part, class Model>
void check_half(const Assembler<Model> &assembler, const State<Model::degree, Model::spacedim> &state,
                const Loads<Model::spacedim> &loads, PhaseTangent tangent)
{
  constexpr int      n_fields = Model::n_fields;
  const BalanceLevel level{state.position, state.acceleration, state.phase};
  const auto         values = assembler.evaluate(loads, 1.);
  Vector             force(state.distribution, n_fields), external = force, half_force = force, half_external = force;
  Matrix             whole = assembler.make_matrix(), half = assembler.make_matrix(part);
  REQUIRE(half.block_size() == fields_of(part, Model::spacedim).count);
  half_force.fill(3.); // what was there before does not count
  half.values()[0] = 5.;
  assembler.linearise(level, state.history, .7, tangent, values, force, external, whole);
  assembler.template linearise_part<part>(level, state.history, .7, tangent, values, half_force, half_external, half);

  const Eigen::MatrixXd K = dense(whole), k = dense(half);
  const auto            rows     = rows_of(part, n_fields, K.rows());
  const Eigen::MatrixXd expected = K(rows, rows);
  CHECK(largest(k - expected) <= 1e-13 * largest(expected));

  const auto other = rows_of(part == Unknowns::phase ? Unknowns::displacement : Unknowns::phase, n_fields, K.rows());
  const Eigen::VectorXd f = all_values(force), fe = all_values(external);
  const auto            check = [&](const Vector &forces, const Vector &loads_of_half) {
    const Eigen::VectorXd g = all_values(forces), ge = all_values(loads_of_half);
    CHECK(largest(g(rows) - f(rows)) <= 1e-13 * largest(f(rows)));
    CHECK(largest(g(other)) == 0.);
    CHECK(largest(ge(rows) - fe(rows)) <= 1e-13 * largest(fe));
  };
  check(half_force, half_external);
  half_force.fill(2.);
  half_external.fill(0.);
  assembler.template part_force<part>(level, state.history, values, half_force, half_external);
  check(half_force, half_external);
}

/// The residual of the phase, its memory and the work withheld are those of the active energy that the level has.
template <class Model>
void check_known_energy(const Assembler<Model> &assembler, const State<Model::degree, Model::spacedim> &state)
{
  const BalanceLevel level{state.position, state.acceleration, state.phase};
  const auto         energy = assembler.active_energy(level);
  const auto         values = [&](const QuadratureField &active) {
    const BalanceLevel known{state.position, state.acceleration, state.phase, &active};
    Vector             force(state.distribution, Model::n_fields), other = force;
    assembler.template part_force<Unknowns::phase>(known, state.history, {}, force, other);
    auto result = gather(force);
    result.push_back(assembler.withheld_work(known, state.previous_phase, state.history));
    const auto committed = assembler.committed(known, state.history);
    for (int e = 0; e < assembler.space().n_active_elements(); ++e)
      result.insert(result.end(), committed[e], committed[e] + state.n_q);
    return result;
  };
  Vector force(state.distribution, Model::n_fields), other = force;
  assembler.template part_force<Unknowns::phase>(level, state.history, {}, force, other);
  auto       expected  = gather(force);
  const auto committed = assembler.committed(level, state.history);
  expected.push_back(assembler.withheld_work(level, state.previous_phase, state.history));
  for (int e = 0; e < assembler.space().n_active_elements(); ++e)
    expected.insert(expected.end(), committed[e], committed[e] + state.n_q);
  CHECK(values(energy) == expected);

  auto larger = energy;
  for (int e = 0; e < assembler.space().n_active_elements(); ++e)
    for (int q = 0; q < state.n_q; ++q)
      larger[e][q] = 2. * energy[e][q] + 1.;
  CHECK(values(larger) != expected);
}

template <class Model>
void check_halves(const Assembler<Model> &assembler, const State<Model::degree, Model::spacedim> &state,
                  const Loads<Model::spacedim> &loads)
{
  check_half<Unknowns::displacement>(assembler, state, loads, PhaseTangent::consistent);
  check_half<Unknowns::phase>(assembler, state, loads, PhaseTangent::consistent);
  check_half<Unknowns::phase>(assembler, state, loads, PhaseTangent::switched);
  check_known_energy(assembler, state);

  Matrix whole = assembler.make_matrix(), half = assembler.make_matrix(Unknowns::displacement);
  assembler.mass_matrix(whole);
  assembler.template part_mass_matrix<Unknowns::displacement>(half);
  const Eigen::MatrixXd M = dense(whole), m = dense(half);
  const auto            rows = rows_of(Unknowns::displacement, Model::n_fields, M.rows());
  CHECK(largest(m - M(rows, rows)) <= 1e-13 * largest(M));
}

/// A quarter of a roof; x = 2 and y = 0 are planes of symmetry.
Surface<2, 3> quarter()
{
  return shapes::roof<2>(3., 4., 40. * std::numbers::pi / 180., {4, 4}, shapes::Fit::exact, shapes::Part::quarter);
}

Loads<3> all_kinds_of_loads()
{
  Loads<3> loads;
  loads.pressure([](const Point<3> &X, double t) { return t * (1. + X[0]); }, PressureRelease::by_phase);
  loads.pressure([](const Point<3> &, double) { return .3; }, PressureRelease::none);
  loads.traction("top", [](const Point<3> &X, double) { return Point<3>(1. + X[1], -2., .5); });
  loads.edge_moment("top", [](const Point<3> &, double) { return .2; });
  return loads;
}

/// Positions and phase disturbed, with a multiplier where there is one; alike on any number of ranks.
void disturb(const ShellSpace<2, 3> &space, const std::vector<Tie> &tied, State<2, 3> &state)
{
  std::mt19937        random(5);
  std::vector<double> values(4 * space.n_points());
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
    {
      values[i] = .02 * symmetric(random);
      if (space.is_multiplier(i / 4) && i % 4 != 0 && i % 4 != 3)
        values[i] = 0.;
    }
  for (const auto &tie : tied)
    {
      double &value = values[4 * tie.point + tie.field] = 0.;
      for (std::size_t k = 0; k < tie.masters.size(); ++k)
        value += tie.factors[k] * values[4 * tie.masters[k] + tie.field];
    }
  for (int a = 0; a < state.distribution->n_local(); ++a)
    {
      const auto id = state.distribution->global(a);
      for (int c = 0; c < 3; ++c)
        {
          state.position.local()[3 * a + c] += values[4 * id + c];
          if (!space.is_multiplier(static_cast<int>(id)))
            state.acceleration.local()[3 * a + c] = 3. * values[4 * id + c];
        }
      state.phase.local()[a] += values[4 * id + 3] - .3;
    }
}

} // namespace

TEST_CASE("Half problems of a plate are the blocks of the whole")
{
  const auto surface = crowded_plate();
  Body       body(MPI_COMM_WORLD, surface);
  body.state = distribute(random_state(surface, stretch(1.1, .95, .2)), body.space);
  Loads<2> loads;
  loads.traction("right", [](const Point<2> &X, double) { return Point<2>(1. + X[1], -2.); });
  check_halves(body.assembler, body.state, loads);
}

TEST_CASE("Half problems of a shell are the blocks of the whole, with interfaces, ties, weak edges and all loads")
{
  const int which = GENERATE(0, 1, 2);
  CAPTURE(which);
  const Continuity methods[] = {continuity::Penalty{10., 20.}, continuity::LagrangeMultiplier{}, continuity::None{}};
  auto             surface   = which < 2 ? split_patches(quarter(), {2, 2}) : quarter();
  refine_at_random(surface, 1, 2, 11);
  Supports supports;
  supports.symmetry("bottom", Component::y);
  if (which == 2)
    {
      const continuity::Penalty factors{3., 5.};
      supports.clamp_weakly("left", factors);
      supports.symmetry_weakly("right", Component::x, factors);
    }
  const auto             tied  = ties(supports, surface);
  const auto             model = shell(Toughness<3>([](double x, double y, double z) { return z + x * y; }));
  const ShellSpace<2, 3> space(Environment(MPI_COMM_WORLD), surface, methods[which]);
  State<2, 3>            state(space);
  const Assembler<Shell> assembler(model, space, state.distribution, tied, supports.weak_edges());
  disturb(space, tied, state);
  check_halves(assembler, state, all_kinds_of_loads());
}
