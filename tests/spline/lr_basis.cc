#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <sherd/base/exceptions.h>
#include <sherd/spline/lr_basis.h>

#include "spline_tools.h"

using namespace sherd;

TEMPLATE_TEST_CASE_SIG("LRBasis: the initial basis is the tensor product of B-splines", "[spline][lr]",
                       ((int degree), degree), 2, 3, 4)
{
  auto                  knots_u = test::open_knots(degree, {-1., -0.5, 0.25, 1., 1., 3.});
  auto                  knots_v = test::open_knots(degree, {0., 0.1, 0.7});
  const LRBasis<degree> basis(knots_u, knots_v);
  const int             n_u = static_cast<int>(knots_u.size()) - degree - 1, n_v = degree + 2;
  REQUIRE(basis.n_functions() == n_u * n_v);
  REQUIRE(basis.n_elements() == 4 * 2);

  std::mt19937 generator(1);
  for (int trial = 0; trial < 50; ++trial)
    {
      const double u = -1. + 4. * test::uniform(generator), v = 0.7 * test::uniform(generator);
      const int    e         = basis.element_at(u, v);
      const auto   functions = basis.functions_of(e);
      const auto   values    = evaluate(basis, e, u, v);
      REQUIRE(functions.size() == (degree + 1) * (degree + 1));
      for (std::size_t k = 0; k < functions.size(); ++k)
        {
          const int  i = functions[k] % n_u, j = functions[k] / n_u;
          const auto along = [&](int order_u, int order_v) {
            return test::cox_de_boor_derivative(&knots_u[i], degree, u, order_u) *
                   test::cox_de_boor_derivative(&knots_v[j], degree, v, order_v);
          };
          // Derivatives are larger by degree / h, with h = 0.5 and 0.1.
          const double tolerance = 1e-14, in_u = degree / 0.5, in_v = degree / 0.1;
          CHECK(std::abs(values[k].value - along(0, 0)) < tolerance);
          CHECK(std::abs(values[k].first[0] - along(1, 0)) < tolerance * in_u);
          CHECK(std::abs(values[k].first[1] - along(0, 1)) < tolerance * in_v);
          CHECK(std::abs(values[k].second[0] - along(2, 0)) < tolerance * in_u * in_u);
          CHECK(std::abs(values[k].second[1] - along(0, 2)) < tolerance * in_v * in_v);
          CHECK(std::abs(values[k].second[2] - along(1, 1)) < tolerance * in_u * in_v);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("LRBasis: full lines give the tensor product on the finer knots", "[spline][lr]",
                       ((int degree), degree), 2, 3, 4)
{
  LRBasis<degree> basis(test::integer_knots(degree, 3), test::integer_knots(degree, 2));

  basis.insert(std::array{MeshLine{Direction::u, 0.5, 0., 2.}, MeshLine{Direction::u, 2., 0., 2., 2},
                          MeshLine{Direction::v, 1.25, 0., 3.}});

  const LRBasis<degree> fine(test::open_knots(degree, {0., 0.5, 1., 2., 2., 3.}),
                             test::open_knots(degree, {0., 1., 1.25, 2.}));
  CHECK(test::difference(basis, fine) < 1e-15);
}

TEST_CASE("LRBasis: element_at is half-open and closed at the right end of the domain", "[spline][lr]")
{
  LRBasis<2> basis(test::integer_knots(2, 4), test::integer_knots(2, 4));
  basis.insert(std::array{MeshLine{Direction::u, 0.5, 0., 3.}, MeshLine{Direction::v, 0.5, 0., 3.}});

  CHECK(basis.element(basis.element_at(0., 0.)) == Box{{0., 0.}, {0.5, 0.5}});
  CHECK(basis.element(basis.element_at(0.5, 0.25)) == Box{{0.5, 0.}, {1., 0.5}});
  CHECK(basis.element(basis.element_at(0.25, 0.5)) == Box{{0., 0.5}, {0.5, 1.}});
  CHECK(basis.element(basis.element_at(1., 1.)) == Box{{1., 1.}, {2., 2.}});
  CHECK(basis.element(basis.element_at(4., 4.)) == Box{{3., 3.}, {4., 4.}});
  CHECK_THROWS_AS(basis.element_at(4.0001, 0.), InvalidParameter);
  CHECK_THROWS_AS(basis.element_at(0., -1e-9), InvalidParameter);
  CHECK_THROWS_AS(basis.element_at(std::nan(""), 0.), InvalidParameter);
}

TEST_CASE("LRBasis: a line that ends inside an element does not split it until another extends it", "[spline][lr]")
{
  LRBasis<2> basis(test::integer_knots(2, 5), test::integer_knots(2, 5));
  const int  n_functions = basis.n_functions();

  // Crosses elements [2,3] x [0,3] and half of [2,3] x [3,4].
  basis.insert(std::array{MeshLine{Direction::u, 2.5, 0., 3.5}});
  CHECK(basis.n_elements() == 25 + 3);
  CHECK(basis.element(basis.element_at(2.6, 3.2)) == Box{{2., 3.}, {3., 4.}});
  CHECK(basis.element(basis.element_at(2.6, 2.9)) == Box{{2.5, 2.}, {3., 3.}});
  // Only functions with support inside v in [0, 3.5] are split: along v those on 0001, 0012 and 0123.
  CHECK(basis.n_functions() == n_functions + 3);
  CHECK(basis.mesh_lines().at(3) == MeshLine{Direction::u, 2.5, 0., 3.5, 1});

  // A line across v = 3.5 meets the loose end, and the part below it is now crossed from edge to edge.
  basis.insert(std::array{MeshLine{Direction::v, 3.5, 1., 4.}});
  CHECK(basis.element(basis.element_at(2.6, 3.2)) == Box{{2.5, 3.}, {3., 3.5}});
  CHECK(basis.element(basis.element_at(2.6, 3.6)) == Box{{2., 3.5}, {3., 4.}});

  // An extension joins the line; the result is that of one long line.
  basis.insert(std::array{MeshLine{Direction::u, 2.5, 3.5, 5.}});
  LRBasis<2> other(test::integer_knots(2, 5), test::integer_knots(2, 5));
  other.insert(std::array{MeshLine{Direction::v, 3.5, 1., 4.}, MeshLine{Direction::u, 2.5, 0., 5.}});
  CHECK(test::difference(basis, other) < 1e-15);
}

TEST_CASE("LRBasis: a line shorter than any support changes no function", "[spline][lr]")
{
  LRBasis<3> basis(test::integer_knots(3, 8), test::integer_knots(3, 8));
  const auto before = test::sorted_functions(basis);

  const auto refinement = basis.insert(std::array{MeshLine{Direction::v, 4.5, 3., 6.}});

  const auto after = test::sorted_functions(basis);
  REQUIRE(after.size() == before.size());
  for (std::size_t i = 0; i < after.size(); ++i)
    CHECK(after[i].knots == before[i].knots);
  CHECK(basis.n_elements() == 64 + 3);
  CHECK(refinement.transfer.columns.size() == before.size());
}

TEST_CASE("LRBasis: functions that stay keep their order, parts take the place of their element", "[spline][lr]")
{
  LRBasis<2> basis(test::integer_knots(2, 6), test::integer_knots(2, 6));
  const auto coarse = basis;

  const auto refinement = basis.insert(std::array{MeshLine{Direction::u, 2.5, 0., 3.}});

  int last = -1, n_kept = 0;
  for (int i = 0; i < basis.n_functions(); ++i)
    for (int k = 0; k < coarse.n_functions(); ++k)
      if (coarse.function(k).knots == basis.function(i).knots)
        {
          CHECK(k > last);
          CHECK(i == n_kept);
          last = k;
          ++n_kept;
        }
  CHECK(n_kept > 40);
  REQUIRE(static_cast<int>(refinement.parent.size()) == basis.n_elements());
  CHECK(std::is_sorted(refinement.parent.begin(), refinement.parent.end()));
}

TEST_CASE("LRBasis: invalid knots are refused", "[spline][lr]")
{
  const auto good = test::integer_knots(2, 2);

  CHECK_THROWS_AS(LRBasis<2>({}, good), InvalidParameter);
  CHECK_THROWS_AS(LRBasis<2>({0., 0., 0.}, good), InvalidParameter);
  CHECK_THROWS_AS(LRBasis<2>({0., 0., 1., 1., 1.}, good), InvalidParameter);
  CHECK_THROWS_AS(LRBasis<2>(good, {0., 0., 0., 1., 1., 1., 2., 2., 2.}), InvalidParameter);
  CHECK_THROWS_AS(LRBasis<2>(good, {0., 0., 0., 2., 1., 3., 3., 3.}), InvalidParameter);
  CHECK_THROWS_AS(LRBasis<2>(good, {0., 0., 0., std::nan(""), 1., 1., 1.}), InvalidParameter);
  CHECK_THROWS_AS(LRBasis<3>(good, good), InvalidParameter);
  CHECK_NOTHROW(LRBasis<2>(good, {0., 0., 0., 1., 1., 2., 2., 2.}));
}

TEST_CASE("LRBasis: invalid lines are refused and nothing changes", "[spline][lr]")
{
  LRBasis<2>     basis(test::integer_knots(2, 4), test::integer_knots(2, 3));
  const auto     before = basis;
  const MeshLine good{Direction::u, 0.5, 0., 3.};
  const double   infinity = std::numeric_limits<double>::infinity();

  for (const auto &bad :
       {MeshLine{Direction::u, 0., 0., 3.}, MeshLine{Direction::u, 4., 0., 3.}, MeshLine{Direction::v, 3.5, 0., 4.},
        MeshLine{Direction::u, 0.5, 1., 1.}, MeshLine{Direction::u, 0.5, 2., 1.}, MeshLine{Direction::u, 0.5, 0., 3.5},
        MeshLine{Direction::v, 0.5, -1., 3.}, MeshLine{Direction::u, 0.5, 0., 3., 0},
        MeshLine{Direction::u, 0.5, 0., 3., 3}, MeshLine{Direction::u, infinity, 0., 3.}})
    CHECK_THROWS_AS(basis.insert(std::array{good, bad}), InvalidParameter);
  CHECK(test::difference(basis, before) == 0.);
}

TEST_CASE("LRBasis: zero and negative zero are the same knot", "[spline][lr]")
{
  const auto knots    = test::open_knots(2, {-2., -1., 0., 1., 2.});
  auto       negative = knots;
  std::replace(negative.begin(), negative.end(), 0., -0.);
  LRBasis<2> one(knots, knots), other(negative, negative);

  one.insert(std::array{MeshLine{Direction::u, 0.5, -2., 1.}, MeshLine{Direction::v, 0., -2., 2., 2}});
  other.insert(std::array{MeshLine{Direction::u, 0.5, -2., 1.}, MeshLine{Direction::v, -0., -2., 2., 2}});

  CHECK(test::difference(one, other) == 0.);
}
