// label: unit
#include <set>

#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/space/ties.h>

using namespace sherd;

namespace
{

/// The rectangle [0, 2] x [0, 1] cut in two by x = 1; parameters run in several ways. Edges "bottom" (y = 0) and "left"
/// (x = 0) by where the sides are.
Surface<2, 2> cut_rectangle(int way)
{
  const auto part = [](double from, double to) {
    return test::bilinear<2, 2>({Point<2>(from, 0.), Point<2>(to, 0.), Point<2>(from, 1.), Point<2>(to, 1.)},
                                test::equal_knots<2>(4, 0., 4.), test::equal_knots<2>(4, 0., 2.));
  };
  std::vector<Patch<2, 2>> patches{test::reoriented(part(0., 1.), way), test::reoriented(part(1., 2.), (3 * way) % 8)};
  const auto               at_zero = [&](int d) {
    return test::sides_where(patches, [=](const Point<2> &X) { return std::abs(X[d]) < 1e-12; });
  };
  return Surface<2, 2>(patches, {{"left", at_zero(0)}, {"bottom", at_zero(1)}}, find_interfaces(patches));
}

} // namespace

TEST_CASE("A symmetric edge goes on behind an interface")
{
  const int    way     = GENERATE(0, 3, 4, 6);
  auto         surface = cut_rectangle(way);
  std::mt19937 random(way + 1);
  REQUIRE(surface.edge("bottom").size() == 2);
  REQUIRE(surface.edge("left").size() == 1);
  for (int level = 1; level <= GENERATE(0, 1, 3); ++level)
    {
      // Some points near the place where the interface meets the edge.
      std::vector<int> marked;
      const auto       X = surface.control_points();
      for (int i = 0; i < X.rows(); ++i)
        if ((X.row(i) - Eigen::RowVector2d(1., 0.)).norm() < .5 && random() % 3 == 0)
          marked.push_back(i);
      surface.refine_to(marked, test::halved(surface, level));
    }

  Supports supports;
  supports.symmetry("bottom", Component::y);
  supports.symmetry("left", Component::x);
  const auto all = ties(supports, surface);

  std::set<std::pair<int, int>> tied;
  for (const auto &tie : all)
    CHECK(tied.insert({tie.point, tie.field}).second);
  for (const auto &side : surface.edge("bottom"))
    for (const int point : points_along(surface, side))
      CHECK(tied.count({point, 2}) == 1);

  // Elements of a tied control point list its masters.
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto [p, local] = surface.locate_element(e);
      std::set<int> points;
      for (const int i : surface.patch(p).basis.functions_of(local))
        points.insert(surface.point(p, i));
      for (const auto &tie : all)
        if (points.count(tie.point))
          for (const int master : tie.masters)
            CHECK(points.count(master) == 1);
    }

  // A phase field that obeys the ties is level across both edges, on both patches.
  Eigen::VectorXd phase(surface.n_control_points());
  for (double &value : phase)
    value = test::symmetric(random);
  for (const auto &tie : all)
    if (tie.field == 2)
      {
        phase[tie.point] = 0.;
        for (std::size_t k = 0; k < tie.masters.size(); ++k)
          phase[tie.point] += tie.factors[k] * phase[tie.masters[k]];
      }
  double slope = 0.;
  for (const auto &name : {"bottom", "left"})
    for (const auto &side : surface.edge(name))
      for (const auto &piece : edge_geometry(surface, side))
        for (const auto &q : piece.quadrature)
          {
            double across = 0.;
            for (std::size_t k = 0; k < piece.points.size(); ++k)
              across += (piece.normal_direction == 0 ? q.d1 : q.d2)[k] * phase[piece.points[k]];
            slope = std::max(slope, std::abs(across));
          }
  CHECK(slope < 1e-12);
}

TEST_CASE("Named regions count shared control points once")
{
  const auto surface = cut_rectangle(5);
  Supports   supports;
  supports.fix("bottom");
  supports.fix(PatchRegion{1}, Component::x);
  const auto held = holders(supports, surface);
  int        n_x = 0, n_y = 0;
  for (int point = 0; point < surface.n_control_points(); ++point)
    {
      n_x += held[2 * point] >= 0;
      n_y += held[2 * point + 1] >= 0;
    }
  CHECK(n_y == 6 + 5);
  CHECK(n_x == 36 + 5);
  CHECK(points_of(WholeSurface(), surface).size() == 36 + 30);
  CHECK(points_of(Corner{"bottom", "left"}, surface).size() == 1);
}
