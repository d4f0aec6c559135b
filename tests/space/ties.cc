// label: unit
// ranks: 1 2 3
#include <algorithm>

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/space/local_ties.h>

using namespace sherd;

namespace
{

/// Refines at random around the control points that act on or next to the named edges, in one direction or both, so
/// that lines across an edge end inside the second row and first spans differ along it.
template <int degree, int spacedim>
void refine_along(Surface<degree, spacedim> &surface, const std::vector<std::string> &edges, int levels, double length,
                  unsigned seed)
{
  std::mt19937 random(seed);
  for (int level = 0; level < levels; ++level, length /= 2.)
    {
      std::vector<int> marked;
      for (const auto &name : edges)
        {
          const auto &edge  = surface.edge(name).front();
          const auto  first = points_along(surface, edge), second = second_row_along(surface, edge);
          marked.push_back(first[random() % first.size()]);
          marked.push_back(first[random() % 2]);
          marked.push_back(second[random() % second.size()]);
        }
      const unsigned kind = random() % 3;
      surface.refine(marked, {{kind == 1 ? 1e9 : length, kind == 2 ? 1e9 : length}});
    }
}

/// Lines across the left edge that end anywhere, and lines along it of any extent.
template <int degree>
Surface<degree, 2> scratched_plate(unsigned seed)
{
  const auto   plate = shapes::plate<degree, 2>({1., 1.}, {4, 4});
  auto         patch = plate.patch(0);
  std::mt19937 random(seed);
  for (int round = 0; round < 30; ++round)
    {
      const int  parts  = 2 << random() % 3; // of a span
      const int  n      = 4 * parts;
      const auto choose = [&](int from, int to) { return static_cast<int>(from + random() % (to - from)); };
      MeshLine   line{};
      if (random() % 2)
        line = {Direction::v, double(choose(1, n)) / parts, 0., double(choose(1, n + 1)) / parts};
      else
        {
          const int start = choose(0, n);
          line            = {Direction::u, double(choose(1, 2 * parts)) / parts, double(start) / parts,
                             double(choose(start + 1, n + 1)) / parts};
        }
      patch.control_points = patch.basis.insert(std::span(&line, 1)).transfer.apply(patch.control_points);
    }
  patch.weights.setOnes(patch.basis.n_functions());
  return {{std::move(patch)}, plate.edges()};
}

/// Random control values in [-1, 1) that obey supports at rest and ties, shape=(n_control_points, n_fields).
template <int degree, int spacedim>
Eigen::MatrixXd tied_values(const Surface<degree, spacedim> &surface, const Supports &supports, unsigned seed)
{
  const auto      held = holders(supports, surface);
  std::mt19937    random(seed);
  Eigen::MatrixXd values(surface.n_control_points(), spacedim + 1);
  for (int i = 0; i < values.rows(); ++i)
    for (int f = 0; f < values.cols(); ++f)
      {
        values(i, f) = test::symmetric(random);
        if (f < spacedim && held[i * spacedim + f] >= 0)
          values(i, f) = 0.;
      }
  for (const auto &tie : ties(supports, surface))
    {
      values(tie.point, tie.field) = 0.;
      for (std::size_t k = 0; k < tie.masters.size(); ++k)
        values(tie.point, tie.field) += tie.factors[k] * values(tie.masters[k], tie.field);
    }
  return values;
}

/// Largest parameter derivative of a field across an edge, at many points of it.
template <int degree, int spacedim>
double steepest(const Surface<degree, spacedim> &surface, const std::string &name, const Eigen::VectorXd &values)
{
  const auto   edge   = surface.edge(name).front();
  const auto  &patch  = surface.patch(edge.patch);
  const auto  &domain = patch.basis.domain();
  const int    normal = edge.side == Side::u_min || edge.side == Side::u_max ? 0 : 1;
  const bool   at_max = edge.side == Side::u_max || edge.side == Side::v_max;
  std::mt19937 random(3);
  double       result = 0.;
  for (int k = 0; k < 300; ++k)
    {
      std::array<double, 2> at;
      at[normal]     = at_max ? domain.max[normal] : domain.min[normal];
      at[1 - normal] = domain.min[1 - normal] + domain.size()[1 - normal] * .5 * (1. + test::symmetric(random));
      const int  e   = patch.basis.element_at(at[0], at[1]);
      const auto f   = patch.basis.functions_of(e);
      const auto v   = evaluate(patch.basis, e, at[0], at[1]);
      double     W = 0., dW = 0., c = 0., dc = 0.;
      for (std::size_t i = 0; i < f.size(); ++i)
        {
          const double w = patch.weights[f[i]], value = values[surface.point(edge.patch, f[i])];
          W += w * v[i].value;
          dW += w * v[i].first[normal];
          c += w * v[i].value * value;
          dc += w * v[i].first[normal] * value;
        }
      result = std::max(result, std::abs(dc / W - c / W * dW / W));
    }
  return result;
}

/// What every list of ties promises.
template <int degree, int spacedim>
void check_promises(const std::vector<Tie> &ties, const std::vector<int> &held,
                    const Surface<degree, spacedim> &surface)
{
  const auto       &basis    = surface.patch(0).basis;
  const int         n_fields = spacedim + 1;
  std::vector<char> tied(surface.n_control_points() * n_fields, 0);
  int               twice = 0, chained = 0, held_too = 0, uncovered = 0;
  for (const auto &tie : ties)
    {
      twice += tied[tie.point * n_fields + tie.field];
      tied[tie.point * n_fields + tie.field] = 1;
      held_too += tie.field < spacedim && held[tie.point * spacedim + tie.field] >= 0;
    }
  double row_sum = 0., least = 1.;
  for (const auto &tie : ties)
    {
      double sum = 0.;
      REQUIRE(tie.masters.size() == tie.factors.size());
      for (std::size_t k = 0; k < tie.masters.size(); ++k)
        {
          chained += tied[tie.masters[k] * n_fields + tie.field];
          sum += tie.factors[k];
          least = std::min(least, tie.factors[k]);
          for (const int e : basis.elements_of(tie.point))
            {
              const auto functions = basis.functions_of(e);
              uncovered += !std::binary_search(functions.begin(), functions.end(), tie.masters[k]);
            }
        }
      row_sum = std::max(row_sum, std::abs(sum - 1.));
    }
  CHECK(twice == 0);
  CHECK(chained == 0);
  CHECK(held_too == 0);
  CHECK(uncovered == 0);
  CHECK(row_sum < 1e-14);
  CHECK(least > 0.);
}

} // namespace

TEMPLATE_TEST_CASE_SIG("On a tensor mesh the first row equals the second", "", ((int degree), degree), 2, 3, 4)
{
  const auto surface = shapes::plate<degree, 3>({1., 1.}, {4, 3});
  Supports   supports;
  supports.symmetry("right", Component::x);
  const auto found = ties(supports, surface);
  const int  n_u = 4 + degree, n_v = 3 + degree;
  REQUIRE(static_cast<int>(found.size()) == 3 * n_v); // y, z, phase
  for (const auto &tie : found)
    {
      CHECK(tie.point % n_u == n_u - 1);
      CHECK(tie.field != 0);
      CHECK(tie.masters == std::vector{tie.point - 1});
      CHECK(tie.factors == std::vector{1.});
    }
  for (const auto &[name, sides] : surface.edges())
    for (const int i : points_along(surface, sides.front()))
      CHECK((holders(supports, surface)[3 * i] == 0) == (i % n_u == n_u - 1));
}

TEMPLATE_TEST_CASE_SIG("Slopes vanish all along symmetric edges of locally refined plates", "",
                       ((int degree, int spacedim), degree, spacedim), (2, 2), (2, 3), (3, 2), (3, 3), (4, 3))
{
  const unsigned seed    = GENERATE(range(1u, 9u));
  auto           surface = shapes::plate<degree, spacedim>({1., 1.}, {4, 4});
  refine_along(surface, {"left", "top"}, 4, .5, seed);
  Supports supports;
  supports.symmetry("left", Component::x);
  supports.symmetry("top", Component::y);
  const auto found = ties(supports, surface);
  check_promises(found, holders(supports, surface), surface);
  const auto values = tied_values(surface, supports, seed);
  for (int field = 1; field <= spacedim; ++field)
    CHECK(steepest(surface, "left", values.col(field)) < 1e-12);
  for (int field = 0; field <= spacedim; ++field)
    if (field != 1)
      CHECK(steepest(surface, "top", values.col(field)) < 1e-12);
  CHECK(steepest(surface, "left", values.col(0)) > .1);
  CHECK(steepest(surface, "right", values.col(spacedim)) > .1);
}

TEMPLATE_TEST_CASE_SIG("Slopes vanish on meshes of lines that end anywhere", "", ((int degree), degree), 2, 3)
{
  const unsigned seed    = GENERATE(range(1u, 13u));
  const auto     surface = scratched_plate<degree>(seed);
  Supports       supports;
  supports.symmetry("left", Component::x);
  supports.phase_symmetry("bottom");
  const auto found = ties(supports, surface);
  check_promises(found, holders(supports, surface), surface);
  const auto values = tied_values(surface, supports, seed);
  CHECK(steepest(surface, "left", values.col(1)) < 1e-12);
  CHECK(steepest(surface, "left", values.col(2)) < 1e-12);
  CHECK(steepest(surface, "bottom", values.col(2)) < 1e-12);
  CHECK(steepest(surface, "bottom", values.col(0)) > .1);

  // As many conditions as ties: the first-row functions are linearly independent on the edge.
  const auto      first  = points_along(surface, surface.edge("left").front());
  const auto      pieces = edge_geometry(surface, surface.edge("left").front());
  Eigen::MatrixXd trace  = Eigen::MatrixXd::Zero(pieces.size() * (degree + 1), first.size());
  for (std::size_t e = 0; e < pieces.size(); ++e)
    for (int q = 0; q <= degree; ++q)
      for (std::size_t k = 0; k < pieces[e].points.size(); ++k)
        if (const auto at = std::find(first.begin(), first.end(), pieces[e].points[k]); at != first.end())
          trace(e * (degree + 1) + q, at - first.begin()) = pieces[e].quadrature[q].value[k];
  CHECK(trace.colPivHouseholderQr().rank() == trace.cols());
}

TEST_CASE("Locally, rows of different lengths are tied by several masters")
{
  int several = 0, longer = 0;
  for (unsigned seed = 1; seed < 9; ++seed)
    {
      const auto surface = scratched_plate<2>(seed);
      const auto edge    = surface.edge("left").front();
      longer += points_along(surface, edge).size() > second_row_along(surface, edge).size();
      for (const auto &tie : level_ties(surface, edge, 2))
        several += tie.masters.size() > 1;
    }
  CHECK(longer > 3);
  CHECK(several > 10);
}

TEMPLATE_TEST_CASE_SIG("Slopes vanish on rational surfaces, with and without a slope of the denominator", "",
                       ((int degree), degree), 2, 3)
{
  const unsigned seed    = GENERATE(range(1u, 5u));
  auto           surface = test::quarter_turn<degree, 3>(1., 0., 1., 2.); // of a cylinder
  for (const int level : {1, 2})
    test::refine_everywhere(surface, level);
  refine_along(surface, {"inner", "start", "end"}, 3, .125, seed);
  Supports supports;
  supports.symmetry("start", Component::y);
  supports.symmetry("end", Component::x);
  supports.symmetry("inner", Component::z);
  const auto found = ties(supports, surface);
  check_promises(found, holders(supports, surface), surface);
  const auto values = tied_values(surface, supports, seed);
  for (const auto &[edge, normal] : {std::pair("start", 1), std::pair("end", 0), std::pair("inner", 2)})
    for (int field = 0; field <= 3; ++field)
      if (field != normal)
        CHECK(steepest(surface, edge, values.col(field)) < 1e-12);
  CHECK(steepest(surface, "outer", values.col(3)) > .1);
}

TEST_CASE("Where symmetric edges meet, one master is left, and supports win over ties")
{
  const auto surface = shapes::plate<2, 3>({1., 1.}, {3, 3}); // 5 functions each way
  Supports   supports;
  supports.symmetry("left", Component::x);
  supports.symmetry("bottom", Component::y);
  SECTION("the corner follows the point inside")
  {
    int corner = 0;
    for (const auto &tie : ties(supports, surface))
      if (tie.point == 0)
        {
          ++corner;
          CHECK(tie.field >= 2); // u_x and u_y are held
          CHECK(tie.masters == std::vector{6});
          CHECK(tie.factors == std::vector{1.});
        }
    CHECK(corner == 2);
  }
  SECTION("a held point is not tied, and may be a master")
  {
    supports.fix("left", Component::z);
    supports.clamp("top");
    const auto found = ties(supports, surface);
    check_promises(found, holders(supports, surface), surface);
    for (const auto &tie : found)
      {
        CHECK_FALSE((tie.field == 2 && tie.point % 5 == 0));
        CHECK_FALSE((tie.field < 3 && tie.point >= 15));
      }
    CHECK(std::count_if(found.begin(), found.end(), [](const Tie &t) { return t.field == 3; }) == 9);
  }
}

TEST_CASE("The phase alone may be symmetric, on a curved edge too")
{
  auto surface = test::quarter_annulus<2, 2>(1., 2.);
  for (const int level : {1, 2})
    test::refine_everywhere(surface, level);
  Supports supports;
  supports.phase_symmetry("outer");
  const auto found = ties(supports, surface);
  CHECK(found.size() == 6); // 4 elements along it
  for (const auto &tie : found)
    CHECK(tie.field == 2);
  CHECK(constraints(supports, ShellSpace<2, 2>(Environment(MPI_COMM_SELF), surface)).empty());
  CHECK(steepest(surface, "outer", tied_values(surface, supports, 1).col(2)) < 1e-12);
}

TEST_CASE("Symmetries that cannot be are refused")
{
  Supports supports;
  SECTION("an unknown edge")
  {
    supports.phase_symmetry("rim");
    CHECK_THROWS_WITH(ties(supports, shapes::plate<2, 2>({1., 1.}, {2, 2})),
                      Catch::Contains("rim") && Catch::Contains("bottom"));
  }
  SECTION("a component that the plane does not have")
  {
    supports.symmetry("left", Component::z);
    CHECK_THROWS_WITH(ties(supports, shapes::plate<2, 2>({1., 1.}, {2, 2})), Catch::Contains("x or y"));
  }
  SECTION("a wrong normal, and an edge that is not plane")
  {
    supports.symmetry("left", Component::y);
    CHECK_THROWS_AS(ties(supports, shapes::plate<2, 2>({1., 1.}, {2, 2})), InvalidParameter);
    Supports curved;
    curved.symmetry("outer", Component::x);
    CHECK_THROWS_AS(ties(curved, test::quarter_annulus<2, 2>(1., 2.)), InvalidParameter);
  }
  SECTION("a surface that does not cross the plane at right angles: a roof")
  {
    auto patch                  = shapes::plate<2, 3>({1., 1.}, {2, 2}).patch(0);
    patch.control_points.col(2) = patch.control_points.col(0);
    const Surface<2, 3> roof({patch}, {{"ridge", {{0, Side::u_min}}}});
    supports.symmetry("ridge", Component::x);
    CHECK_THROWS_WITH(ties(supports, roof), Catch::Contains("ridge") && Catch::Contains("45"));
  }
  SECTION("weights that let no slope but a constant's vanish")
  {
    auto patch       = shapes::plate<2, 2>({1., 1.}, {2, 2}).patch(0);
    patch.weights[5] = 1.5;
    const Surface<2, 2> surface({patch}, {{"left", {{0, Side::u_min}}}});
    CHECK_THROWS_WITH(level_ties(surface, surface.edge("left").front(), 2), Catch::Contains("weights"));
  }
}

TEST_CASE("Ties that need each other or contradict are refused")
{
  const std::vector<char> free(8, 0);
  CHECK_THROWS_WITH(resolve({{0, 0, {1}, {1.}}, {1, 0, {0, 2}, {.5, .5}}}, free, 2), Catch::Contains("follows itself"));
  CHECK_THROWS_WITH(resolve({{0, 1, {1}, {1.}}, {0, 1, {2}, {1.}}}, free, 2), Catch::Contains("different values"));
  std::vector<char> held = free;
  held[1]                = 1;
  CHECK(resolve({{0, 1, {1}, {1.}}, {0, 1, {2}, {1.}}}, held, 2).empty());
  const auto chain =
      resolve({{0, 0, {1, 2}, {.5, .5}}, {1, 0, {2, 3}, {.25, .75}}, {0, 0, {2, 3}, {.625, .375}}}, free, 2);
  REQUIRE(chain.size() == 2);
  CHECK(chain[0].masters == std::vector{2, 3});
  CHECK(chain[0].factors == std::vector{.625, .375});
}

TEST_CASE("Every rank applies ties to its local control points alone")
{
  const Environment env(MPI_COMM_WORLD);
  auto              surface = shapes::plate<2, 3>({1., 1.}, {6, 6});
  refine_along(surface, {"left", "bottom"}, 3, .5, 4);
  const ShellSpace<2, 3> space(env, surface);
  Supports               supports;
  supports.symmetry("left", Component::x);
  supports.symmetry("bottom", Component::y);
  const auto  all   = ties(supports, surface);
  const auto  local = local_ties(supports, space);
  const auto &d     = space.distribution();

  // Values by surface number, before and after the ties.
  std::mt19937    random(8);
  Eigen::MatrixXd before(surface.n_control_points(), 4);
  for (int i = 0; i < before.rows(); ++i)
    for (int f = 0; f < 4; ++f)
      before(i, f) = test::symmetric(random);
  Eigen::MatrixXd after = before;
  for (const auto &tie : all)
    {
      after(tie.point, tie.field) = 0.;
      for (std::size_t k = 0; k < tie.masters.size(); ++k)
        after(tie.point, tie.field) += tie.factors[k] * before(tie.masters[k], tie.field);
    }

  const auto [first, size] = GENERATE(std::pair(0, 4), std::pair(0, 3), std::pair(3, 1));
  std::vector<double> values((d.owned.size() + d.ghosts.size()) * size), expected = values;
  for (int i = 0; i < surface.n_control_points(); ++i)
    for (int c = 0; c < size; ++c)
      if (d.local[i] >= 0)
        {
          values[d.local[i] * size + c]   = before(i, first + c);
          expected[d.local[i] * size + c] = after(i, first + c);
        }
  local.apply(values, size, first);
  CHECK(values == expected);

  int owned = 0;
  for (const auto &tie : local.list())
    owned += tie.point < static_cast<int>(d.owned.size()) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPI_INT, MPI_SUM, env.comm());
  CHECK(owned == static_cast<int>(all.size()));
}
