// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/edge_geometry.h>

using namespace sherd;

namespace
{

/// Two plates one above the other, the second with other numbers of elements.
Surface<2, 2> two_patches()
{
  auto lower = shapes::plate<2, 2>({1., 1.}, {2, 3}).patch(0);
  auto upper = shapes::plate<2, 2>({1., 1.}, {4, 2}).patch(0);
  upper.control_points.col(1).array() += 1.;
  return {{std::move(lower), std::move(upper)},
          {{"sides", {{0, Side::u_min}, {0, Side::u_max}, {1, Side::u_min}, {1, Side::u_max}}},
           {"top", {{1, Side::v_max}}}}};
}

/// A field's value at the parameters of a patch.
double field_at(const Surface<2, 2> &surface, int p, const Eigen::VectorXd &values, double u, double v)
{
  Patch<2, 1> patch{surface.patch(p).basis, values.segment(surface.point(p, 0), surface.patch(p).basis.n_functions()),
                    surface.patch(p).weights};
  return test::position_at(patch, u, v)[0];
}

} // namespace

TEST_CASE("Patches are numbered one after the other")
{
  const auto surface = two_patches();
  REQUIRE(surface.n_patches() == 2);
  CHECK(surface.n_control_points() == 4 * 5 + 6 * 4);
  CHECK(surface.n_elements() == 6 + 8);
  CHECK(surface.point(1, 0) == 20);
  CHECK(surface.element_offset(1) == 6);
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto at = surface.locate_element(e);
      CHECK(at.patch == (e < 6 ? 0 : 1));
      CHECK(surface.element_offset(at.patch) + at.local == e);
    }
  for (const int i : {0, 19, 20, 43})
    {
      const auto at = surface.locate_point(i);
      CHECK(at.patch == (i < 20 ? 0 : 1));
      CHECK(surface.control_points().row(i) == surface.patch(at.patch).control_points.row(at.local));
      CHECK(surface.weights()[i] == 1.);
    }
  CHECK(surface.edge("sides").size() == 4);
}

TEST_CASE("Refinement changes neither surface nor fields")
{
  const bool rational = GENERATE(false, true);
  auto       surface =
      rational ? test::quarter_annulus<2, 2>(1., 2.) : test::distorted(shapes::plate<2, 2>({1., 1.}, {4, 4}), .05);
  const double end = rational ? 1. : 4.;
  if (rational)
    test::refine_everywhere(surface, 2);
  const auto      before = surface;
  Eigen::VectorXd field(surface.n_control_points());
  std::mt19937    random(11);
  for (auto &value : field)
    value = test::symmetric(random);
  Eigen::VectorXd  refined = field;
  std::vector<int> ancestor(before.n_elements());
  std::iota(ancestor.begin(), ancestor.end(), 0);
  for (const double target : {end / 8., end / 16., end / 32.})
    {
      std::vector<int> marked;
      for (int k = 0; k < 3; ++k)
        marked.push_back(static_cast<int>(random() % surface.n_control_points()));
      const auto refinement = surface.refine(marked, {{target, target}});
      refined               = refinement.transfer.apply(refined);
      REQUIRE(static_cast<int>(refinement.parent.size()) == surface.n_elements());
      std::vector<int> next;
      for (const int parent : refinement.parent)
        next.push_back(ancestor[parent]);
      ancestor = next;
    }
  REQUIRE(surface.n_elements() > before.n_elements() + 30);

  double moved = 0., changed = 0.;
  for (int k = 0; k < 200; ++k)
    {
      const double u = .5 * end * (1. + test::symmetric(random)), v = .5 * end * (1. + test::symmetric(random));
      moved   = std::max(moved,
                         (test::position_at(surface.patch(0), u, v) - test::position_at(before.patch(0), u, v)).norm());
      changed = std::max(changed, std::abs(field_at(surface, 0, refined, u, v) - field_at(before, 0, field, u, v)));
      const int now = surface.patch(0).basis.element_at(u, v);
      CHECK(ancestor[now] == before.patch(0).basis.element_at(u, v));
    }
  CHECK(moved < 1e-14);
  CHECK(changed < 1e-14);
  if (rational)
    CHECK((surface.weights().array() > 0.).all());
  else
    CHECK((surface.weights().array() == 1.).all()); // not rational by rounding
}

TEST_CASE("Refining one patch leaves the other, and moves its numbers")
{
  auto            surface = two_patches();
  const auto      before  = surface;
  Eigen::VectorXd field   = before.control_points().col(1);
  const auto      result  = surface.refine({3}, {{.5, .5}});
  const auto      carried = result.transfer.apply(field);

  REQUIRE(surface.n_control_points() > before.n_control_points());
  CHECK(surface.patch(1).control_points == before.patch(1).control_points);
  CHECK(surface.n_control_points() - surface.point(1, 0) == 24);
  CHECK(carried.tail(24) == field.tail(24));
  for (int e = surface.element_offset(1); e < surface.n_elements(); ++e)
    CHECK(result.parent[e] == e - surface.element_offset(1) + before.element_offset(1));
  for (int e = 0; e < surface.element_offset(1); ++e)
    CHECK(result.parent[e] < before.element_offset(1));
}

TEST_CASE("Elements and control points along an edge")
{
  auto surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  test::refine_at_random(surface, 3, 4, 12);
  const auto &basis = surface.patch(0).basis;
  for (const auto &[name, sides] : surface.edges())
    {
      const auto &edge = sides.front();
      const int   d    = name == "left" || name == "right" ? 1 : 0; // along the edge
      const auto  at   = name == "right" || name == "top" ? 4. : 0.;

      // The elements tile the edge from end to end.
      double reached = 0.;
      for (const int e : elements_along(surface, edge))
        {
          const auto &box = basis.element(e);
          CHECK(box.min[d] == reached);
          CHECK((at == 0. ? box.min[1 - d] : box.max[1 - d]) == at);
          reached = box.max[d];
        }
      CHECK(reached == 4.);

      // The control points are those whose functions do not vanish on it. Splines are not negative, and positive
      // inside their support.
      std::vector<double> on_edge(surface.n_control_points(), 0.);
      for (const auto &piece : edge_geometry(surface, edge))
        for (const auto &q : piece.quadrature)
          for (std::size_t k = 0; k < piece.points.size(); ++k)
            on_edge[piece.points[k]] += q.value[k];
      auto   points   = points_along(surface, edge);
      double previous = -1.;
      for (const int i : points)
        {
          const double X = surface.control_points()(i, d);
          CHECK(X >= previous);
          previous = X;
        }
      std::sort(points.begin(), points.end());
      std::vector<int> expected;
      for (int i = 0; i < surface.n_control_points(); ++i)
        if (on_edge[i] > 1e-12)
          expected.push_back(i);
      CHECK(points == expected);
    }
}

TEST_CASE("The second row along an edge has a slope but no value there")
{
  // A double inner line makes functions whose knots repeat a value that is not the border's.
  const auto     plate = shapes::plate<2, 2>({4., 4.}, {4, 4});
  auto           patch = plate.patch(0);
  const MeshLine line{Direction::u, 2., 0., 4., 2};
  patch.control_points = patch.basis.insert(std::span(&line, 1)).transfer.apply(patch.control_points);
  patch.weights.setOnes(patch.basis.n_functions());
  Surface<2, 2> surface({patch}, plate.edges());
  test::refine_at_random(surface, 3, 6, 5);
  for (const auto &[name, sides] : surface.edges())
    {
      const bool          u_side = name == "left" || name == "right";
      std::vector<int>    expected;
      std::vector<double> value(surface.n_control_points(), 0.), slope = value;
      for (const auto &piece : edge_geometry(surface, sides.front()))
        for (const auto &q : piece.quadrature)
          for (std::size_t k = 0; k < piece.points.size(); ++k)
            {
              value[piece.points[k]] += q.value[k];
              slope[piece.points[k]] += std::abs(u_side ? q.d1[k] : q.d2[k]);
            }
      for (int i = 0; i < surface.n_control_points(); ++i)
        if (value[i] < 1e-12 && slope[i] > 1e-12)
          expected.push_back(i);
      auto   points   = second_row_along(surface, sides.front());
      double previous = -1.;
      for (const int i : points)
        {
          const double X = surface.control_points()(i, u_side ? 1 : 0);
          CHECK(X >= previous);
          previous = X;
        }
      std::sort(points.begin(), points.end());
      CHECK(points == expected);
    }
}

TEST_CASE("Wrong surfaces are refused with a reason")
{
  const auto plate = shapes::plate<2, 2>({1., 1.}, {2, 2});
  SECTION("an edge that does not exist lists those that do")
  {
    CHECK_THROWS_AS(plate.edge("lid"), InvalidParameter);
    CHECK_THROWS_WITH(plate.edge("lid"), Catch::Contains("\"lid\"") && Catch::Contains("bottom, left, right, top"));
  }
  SECTION("arrays that do not fit the basis")
  {
    auto patch = plate.patch(0);
    patch.control_points.conservativeResize(3, 2);
    CHECK_THROWS_AS((Surface<2, 2>({patch}, {})), DimensionMismatch);
    patch         = plate.patch(0);
    patch.weights = Eigen::VectorXd::Ones(5);
    CHECK_THROWS_AS((Surface<2, 2>({patch}, {})), DimensionMismatch);
  }
  SECTION("weights that are not positive")
  {
    auto patch       = plate.patch(0);
    patch.weights[4] = GENERATE(0., -1., std::nan(""));
    CHECK_THROWS_AS((Surface<2, 2>({patch}, {})), InvalidParameter);
  }
  SECTION("an edge of a patch that does not exist")
  {
    CHECK_THROWS_WITH((Surface<2, 2>({plate.patch(0)}, {{"far", {{1, Side::u_min}}}})),
                      Catch::Contains("far") && Catch::Contains("patch 1"));
  }
  SECTION("marks and targets of a refinement")
  {
    auto surface = plate;
    CHECK_THROWS_AS(surface.refine({-1}, {{.5, .5}}), InvalidParameter);
    CHECK_THROWS_AS(surface.refine({plate.n_control_points()}, {{.5, .5}}), InvalidParameter);
    CHECK_THROWS_AS(surface.refine({0}, {{.5, 0.}}), InvalidParameter);
    CHECK(surface.n_elements() == plate.n_elements());
  }
}
