#include <catch2/catch.hpp>

#include <cmath>

#include <sherd/base/exceptions.h>
#include <sherd/spline/extraction.h>
#include <sherd/spline/independence.h>

#include "spline_tools.h"

using namespace sherd;

namespace
{

template <int degree>
LRBasis<degree> uneven_basis()
{
  return {test::open_knots(degree, {0., 1., 1.5, 3., 3., 4.}), test::open_knots(degree, {-1., 0., 0.7, 2.})};
}

/// What every LR basis must satisfy, found by brute force.
template <int degree>
void check_basis(const LRBasis<degree> &basis)
{
  LRMesh mesh(basis.initial_knots()[0], basis.initial_knots()[1]);
  mesh.add(basis.mesh_lines());

  // Elements: the lines cover all edges, none crosses from edge to edge, and together they are the domain.
  double area = 0.;
  for (int e = 0; e < basis.n_elements(); ++e)
    {
      const auto &box = basis.element(e);
      area += box.area();
      REQUIRE(basis.element_at(box.centre()[0], box.centre()[1]) == e);
      for (int d = 0; d < 2; ++d)
        {
          const auto direction = static_cast<Direction>(d);
          REQUIRE(mesh.multiplicity(direction, box.min[d], box.min[1 - d], box.max[1 - d]) > 0);
          REQUIRE(mesh.multiplicity(direction, box.max[d], box.min[1 - d], box.max[1 - d]) > 0);
          for (const auto &line : mesh.between(direction, box.min[d], box.max[d]))
            REQUIRE(line.multiplicity(box.min[1 - d], box.max[1 - d]) == 0);
        }
    }
  CHECK(area == Approx(basis.domain().area()).epsilon(1e-13));

  // Adjacency: element inside support, both ways, ascending.
  for (int e = 0; e < basis.n_elements(); ++e)
    {
      std::vector<int> functions;
      for (int i = 0; i < basis.n_functions(); ++i)
        if (contains(basis.function(i).support(), basis.element(e)))
          functions.push_back(i);
      const auto stored = basis.functions_of(e);
      REQUIRE(std::vector<int>(stored.begin(), stored.end()) == functions);
    }
  for (int i = 0; i < basis.n_functions(); ++i)
    {
      std::vector<int> elements;
      for (int e = 0; e < basis.n_elements(); ++e)
        if (contains(basis.function(i).support(), basis.element(e)))
          elements.push_back(e);
      const auto stored = basis.elements_of(i);
      REQUIRE(std::vector<int>(stored.begin(), stored.end()) == elements);
    }

  // Functions: all different, of minimal support, each knot on lines across the support.
  const auto functions = test::sorted_functions(basis);
  for (std::size_t i = 0; i < functions.size(); ++i)
    {
      REQUIRE((i == 0 || functions[i - 1].knots != functions[i].knots));
      REQUIRE(functions[i].gamma > 0.);
      REQUIRE(functions[i].gamma <= 1. + 1e-14);
      for (int d = 0; d < 2; ++d)
        {
          const auto &knots = functions[i].knots[d], &other = functions[i].knots[1 - d];
          const auto  direction = static_cast<Direction>(d);
          for (const auto &line : mesh.between(direction, knots.front(), knots.back()))
            REQUIRE(std::count(knots.begin(), knots.end(), line.value) ==
                    line.multiplicity(other.front(), other.back()));
          for (const double knot : knots)
            REQUIRE(mesh.multiplicity(direction, knot, other.front(), other.back()) >=
                    std::count(knots.begin(), knots.end(), knot));
        }
    }
}

template <int degree>
void check_partition_of_unity(const LRBasis<degree> &basis, std::mt19937 &generator)
{
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(basis.n_functions(), 1);
  for (int e = 0; e < basis.n_elements(); ++e)
    {
      const auto point = test::point_inside(basis.element(e), generator);
      const auto sum   = test::field(basis, ones, e, point[0], point[1]);
      CHECK(std::abs(sum(0, 0) - 1.) < 4e-15); // sums of at most some dozens of positive terms
    }
}

/// The refinement carries fields, their derivatives, the numbering and the weights from old to refined.
template <int degree>
void check_refinement(const LRBasis<degree> &old, const LRBasis<degree> &refined, const Refinement &refinement,
                      std::mt19937 &generator)
{
  const auto &transfer = refinement.transfer;
  REQUIRE(transfer.n_rows() == refined.n_functions());
  for (int i = 0; i < transfer.n_rows(); ++i)
    {
      const auto columns = transfer.row_columns(i);
      const auto values  = transfer.row_values(i);
      REQUIRE(std::is_sorted(columns.begin(), columns.end()));
      REQUIRE(std::adjacent_find(columns.begin(), columns.end()) == columns.end());
      double sum = 0.;
      for (const double value : values)
        {
          REQUIRE(value > 0.);
          sum += value;
        }
      CHECK(std::abs(sum - 1.) < 1e-14);
    }

  const auto control = test::random_control(old.n_functions(), 2, generator), carried = transfer.apply(control);
  REQUIRE(static_cast<int>(refinement.parent.size()) == refined.n_elements());
  for (int e = 0; e < refined.n_elements(); ++e)
    {
      const int parent = refinement.parent[e];
      REQUIRE(contains(old.element(parent), refined.element(e)));
      const auto point  = test::point_inside(refined.element(e), generator);
      const auto before = test::field(old, control, parent, point[0], point[1]);
      const auto after  = test::field(refined, carried, e, point[0], point[1]);
      // Control data are below 1 and so is the field; each derivative is larger by 2 degree / size.
      const auto   size      = refined.element(e).size();
      const double tolerance = 2e-14, in_u = 2 * degree / size[0], in_v = 2 * degree / size[1];
      const double scale[6] = {1., in_u, in_v, in_u * in_u, in_v * in_v, in_u * in_v};
      for (int r = 0; r < 6; ++r)
        CHECK((after - before).row(r).cwiseAbs().maxCoeff() < tolerance * scale[r]);
    }
}

} // namespace

TEMPLATE_TEST_CASE_SIG("refine(): random structured refinement keeps all properties", "[spline][lr]",
                       ((int degree), degree), 2, 3, 4)
{
  const int seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  std::mt19937 generator(seed);
  auto         basis = uneven_basis<degree>();

  for (int level = 0; level < 4; ++level)
    {
      const auto       old    = basis;
      const auto       marked = test::random_functions(basis, 0.06, generator);
      const SpanTarget target{{0.1 + 0.5 * test::uniform(generator), 0.1 + 0.5 * test::uniform(generator)}};
      const auto       refinement = basis.refine(marked, target);

      check_basis(basis);
      check_partition_of_unity(basis, generator);
      check_refinement(old, basis, refinement, generator);
      CHECK(check_independence(basis).independent());
    }
  CHECK(basis.n_functions() > 1.5 * uneven_basis<degree>().n_functions());
}

TEMPLATE_TEST_CASE_SIG("insert(): random lines, loose ends and multiplicities keep all properties", "[spline][lr]",
                       ((int degree), degree), 2, 3, 4)
{
  const int seed = GENERATE(4, 5, 6);
  CAPTURE(seed);
  std::mt19937          generator(seed);
  auto                  basis = uneven_basis<degree>();
  std::vector<MeshLine> all;

  for (int round = 0; round < 4; ++round)
    {
      const auto            old = basis;
      std::vector<MeshLine> lines;
      for (int k = 0; k < 4; ++k)
        lines.push_back(test::random_line(basis, 2, generator));
      all.insert(all.end(), lines.begin(), lines.end());
      const auto refinement = basis.insert(lines);

      check_basis(basis);
      check_partition_of_unity(basis, generator);
      check_refinement(old, basis, refinement, generator);
    }

  SECTION("in any order, one by one or at once")
  {
    std::vector<MeshLine> reversed(all.rbegin(), all.rend());
    auto                  at_once = uneven_basis<degree>(), one_by_one = uneven_basis<degree>();
    at_once.insert(all);
    for (const auto &line : reversed)
      one_by_one.insert(std::array{line});

    // Weights are sums of products of up to a dozen factors each.
    CHECK(test::difference(basis, at_once) < 4e-15);
    CHECK(test::difference(basis, one_by_one) < 4e-15);
  }
}

TEST_CASE("refine(): halves only the spans longer than the target, direction by direction", "[spline][lr]")
{
  LRBasis<2> basis(test::open_knots(2, {0., 1., 3., 4., 5.}), test::integer_knots(2, 4));
  int        marked = -1;
  for (int i = 0; i < basis.n_functions(); ++i)
    if (basis.function(i).knots[0] == LocalKnots<2>{0., 1., 3., 4.} &&
        basis.function(i).knots[1] == LocalKnots<2>{0., 1., 2., 3.})
      marked = i;
  REQUIRE(marked >= 0);

  CHECK(structured_mesh_lines(basis, std::array{marked}, {{1., 1.}}) ==
        std::vector<MeshLine>{{Direction::u, 2., 0., 3.}});
  CHECK(structured_mesh_lines(basis, std::array{marked}, {{2., 0.5}}) ==
        std::vector<MeshLine>{{Direction::v, 0.5, 0., 4.}, {Direction::v, 1.5, 0., 4.}, {Direction::v, 2.5, 0., 4.}});
  CHECK(structured_mesh_lines(basis, std::array{marked}, {{2., 1.}}).empty());

  // Ends after as many levels as the longest span needs.
  int n_rounds = 0;
  for (;;)
    {
      std::vector<int> all(basis.n_functions());
      for (int i = 0; i < basis.n_functions(); ++i)
        all[i] = i;
      const int n_before = basis.n_functions();
      basis.refine(all, {{0.25, 0.25}});
      if (basis.n_functions() == n_before)
        break;
      ++n_rounds;
    }
  CHECK(n_rounds == 3);
  CHECK(basis.n_elements() == 20 * 16);
}

TEST_CASE("refine(): a target that equals a bisected length up to rounding is met by it", "[spline][lr]")
{
  LRBasis<2>       basis(test::open_knots(2, {0., 0.1, 0.2, 0.30000000000000004}), test::open_knots(2, {0., 1.}));
  std::vector<int> all(basis.n_functions());
  for (int i = 0; i < basis.n_functions(); ++i)
    all[i] = i;

  const auto refinement = basis.refine(all, {{0.1 * (1. - 1e-12), 1.}});

  CHECK(basis.n_elements() == 3);
  CHECK(refinement.transfer.apply(Eigen::VectorXd::LinSpaced(5 * 3, 0., 1.)) == Eigen::VectorXd::LinSpaced(15, 0., 1.));
}

TEST_CASE("refine(): invalid targets and functions are refused", "[spline][lr]")
{
  LRBasis<2> basis(test::integer_knots(2, 2), test::integer_knots(2, 2));

  CHECK_THROWS_AS(basis.refine(std::array{0}, {{0., 1.}}), InvalidParameter);
  CHECK_THROWS_AS(basis.refine(std::array{0}, {{1., std::nan("")}}), InvalidParameter);
  CHECK_THROWS_AS(basis.refine(std::array{-1}, {{1., 1.}}), InvalidParameter);
  CHECK_THROWS_AS(basis.refine(std::array{basis.n_functions()}, {{1., 1.}}), InvalidParameter);
}

TEST_CASE("compose(): two refinements act as one", "[spline][lr]")
{
  std::mt19937 generator(7);
  auto         basis = uneven_basis<2>();
  const auto   old   = basis;

  const auto first    = basis.refine(test::random_functions(basis, 0.1, generator), {{0.2, 0.2}});
  const auto second   = basis.refine(test::random_functions(basis, 0.1, generator), {{0.2, 0.2}});
  const auto together = compose(second, first);

  check_refinement(old, basis, together, generator);
}

TEST_CASE("Rational geometry: refinement leaves a quarter annulus unchanged", "[spline][lr]")
{
  // Radius 1..2 along u (linear, degree raised), quarter circle along v with weights 1, 1/sqrt(2), 1.
  LRBasis<2>                  basis(test::integer_knots(2, 1), test::integer_knots(2, 1));
  const double                weight[3] = {1., std::sqrt(0.5), 1.};
  const std::array<double, 2> arc[3]    = {{1., 0.}, {1., 1.}, {0., 1.}};
  Eigen::Matrix<double, 9, 3> initial;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      initial.row(3 * j + i) << weight[j] * (1. + 0.5 * i) * arc[j][0], weight[j] * (1. + 0.5 * i) * arc[j][1],
          weight[j];
  const auto      coarse      = basis;
  Eigen::MatrixXd homogeneous = initial;

  std::mt19937 generator(8);
  for (int level = 0; level < 4; ++level)
    homogeneous =
        basis.refine(test::random_functions(basis, 0.3, generator), {{0.07, 0.07}}).transfer.apply(homogeneous);
  REQUIRE(basis.n_functions() > 60);

  for (int e = 0; e < basis.n_elements(); ++e)
    {
      const auto            p      = test::point_inside(basis.element(e), generator);
      const Eigen::MatrixXd before = test::field(coarse, initial, 0, p[0], p[1]);
      const Eigen::MatrixXd after  = test::field(basis, homogeneous, e, p[0], p[1]);
      const Eigen::Vector2d x(after(0, 0) / after(0, 2), after(0, 1) / after(0, 2));
      CHECK(std::abs(x.norm() - (1. + p[0])) < 1e-14);
      CHECK(std::abs(x[0] - before(0, 0) / before(0, 2)) < 1e-13);
      CHECK(std::abs(x[1] - before(0, 1) / before(0, 2)) < 1e-13);
    }
  CHECK((homogeneous.col(2).array() > 0.7).all());
}
