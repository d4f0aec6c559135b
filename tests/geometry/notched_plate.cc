// label: unit
#include <set>

#include <catch2/catch.hpp>

#include <geometry/area.h>
#include <geometry/sample_surfaces.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/geometry/split.h>

using namespace sherd;
using sherd::test::area;

namespace
{

/// Control points whose function does not vanish on a side.
template <int degree, int spacedim>
std::set<int> points_of(const Surface<degree, spacedim> &surface, const std::string &name)
{
  std::set<int> result;
  for (const auto &edge : surface.edge(name))
    for (const int point : points_along(surface, edge))
      result.insert(point);
  return result;
}

/// The one control point that both faces share, and no other.
template <int degree, int spacedim>
int check_faces(const Surface<degree, spacedim> &surface, const Point<spacedim> &tip)
{
  const auto       lower = points_of(surface, "lower_face"), upper = points_of(surface, "upper_face");
  std::vector<int> shared;
  std::set_intersection(lower.begin(), lower.end(), upper.begin(), upper.end(), std::back_inserter(shared));
  REQUIRE(shared.size() == 1);
  const Point<spacedim> X = surface.control_points().row(shared.front()).transpose();
  CHECK((X - tip).norm() < 1e-14);
  return shared.front();
}

template <int degree, int spacedim>
void check_plate()
{
  const auto      plate = shapes::notched_plate<degree, spacedim>({3., 2.}, {1., .5}, {9, 8});
  Point<spacedim> tip   = Point<spacedim>::Zero();
  tip[0]                = 1.;
  tip[1]                = .5;
  REQUIRE(plate.n_patches() == 4);
  CHECK(plate.n_elements() == 72);
  CHECK(plate.interfaces().size() == 3);
  CHECK(area(plate) == Approx(6.).epsilon(1e-13));
  const int end = check_faces(plate, tip);
  CHECK(plate.locations_of(end).size() == 4);
  for (int e = 0; e < plate.n_elements(); ++e)
    CHECK(shortest_edge(element_geometry(plate, e)) == Approx(.25).epsilon(1e-12)); // 1/3 x 1/4

  // Outer edges lie where their names say, both halves of each.
  const auto X     = plate.control_points();
  const auto along = [&](const std::string &name, int d, double value) {
    REQUIRE(plate.edge(name).size() == 2);
    for (const int i : points_of(plate, name))
      CHECK(X(i, d) == Approx(value).margin(1e-14));
  };
  along("left", 0, 0.);
  along("right", 0, 3.);
  along("bottom", 1, 0.);
  along("top", 1, 2.);
}

} // namespace

TEST_CASE("Four patches of a notched plate meet at its tip, and the faces of the slit share nothing else")
{
  check_plate<2, 2>();
  check_plate<3, 2>();
  check_plate<2, 3>();
}

TEST_CASE("Elements of a notched plate are shared out by the place of the tip, one at least")
{
  const auto plate = shapes::notched_plate<2, 2>({1., 1.}, {.01, .5}, {4, 5});
  CHECK(plate.patch(0).basis.n_elements() == 1 * 3);
  CHECK(plate.patch(3).basis.n_elements() == 3 * 2);
  CHECK(area(plate) == Approx(1.).epsilon(1e-13));
}

TEST_CASE("A field may jump across the slit: opening of quadratic shape")
{
  // ((1 - x / tip)^+)^2 above the slit near the left edge and 0 elsewhere: continuous but on the slit, and quadratic in
  // the only patch where it does not vanish.
  const double tip = .4;
  const auto   plate =
      shapes::notched_plate<2, 2>({1., 1.}, {tip, .5}, {5, 4}); // two elements by two in the upper left patch
  const auto     &patch = plate.patch(2);
  const auto      knots = patch.basis.initial_knots();
  Eigen::VectorXd field = Eigen::VectorXd::Zero(plate.n_control_points());
  const auto      shape = interpolate<2, 2>(knots[0], knots[1], [](double u, double) -> Point<2> {
    return {(1. - u / 2.) * (1. - u / 2.), 0.};
  });
  REQUIRE(shape.n_control_points() == static_cast<int>(plate.points_of_patch(2).size()));
  for (int i = 0; i < shape.n_control_points(); ++i)
    field[plate.points_of_patch(2)[i]] = shape.patch(0).control_points(i, 0);

  const auto value = [&](const Surface<2, 2> &surface, const Eigen::VectorXd &values, int p, double u, double v) {
    Patch<2, 2> carrier = surface.patch(p);
    for (int i = 0; i < carrier.basis.n_functions(); ++i)
      carrier.control_points.row(i) << values[surface.point(p, i)], 0.;
    return test::position_at(carrier, u, v)[0];
  };
  const auto check = [&](const Surface<2, 2> &surface, const Eigen::VectorXd &values) {
    for (const double u : {0., .3, 1.1, 1.7, 2.})
      {
        const double opening = (1. - u / 2.) * (1. - u / 2.);
        CHECK(value(surface, values, 2, u, 0.) == Approx(opening).margin(1e-14)); // upper face
        CHECK(value(surface, values, 0, u, 2.) == Approx(0.).margin(1e-14));      // lower face
        CHECK(value(surface, values, 2, 2., u) == Approx(0.).margin(1e-14));      // interface above the tip,
        CHECK(value(surface, values, 3, 0., u) == Approx(0.).margin(1e-14));      // from both sides
      }
  };
  check(plate, field);

  // It stays that field when the mesh is refined at the tip.
  auto       fine       = plate;
  const int  end        = check_faces(plate, Point<2>(tip, .5));
  const auto refinement = fine.refine({end}, {{.25, .25}});
  REQUIRE(fine.n_elements() > plate.n_elements());
  check(fine, refinement.transfer.apply(field));
}

TEST_CASE("Refinement at the tip conforms ahead of it and leaves the faces to themselves")
{
  const Point<2> tip(.5, .5);
  auto           plate = shapes::notched_plate<2, 2>({1., 1.}, {.5, .5}, {8, 8});
  for (const double length : {.5, .25, .125})
    plate.refine({check_faces(plate, tip)}, {{length, length}});
  check_faces(plate, tip);
  CHECK(area(plate) == Approx(1.).epsilon(1e-13));
  // A surface checks that the sides of all interfaces carry the same functions.
  std::vector<Patch<2, 2>> patches;
  for (int p = 0; p < 4; ++p)
    patches.push_back(plate.patch(p));
  CHECK_NOTHROW(Surface<2, 2>(patches, plate.edges(), plate.interfaces()));

  // Below the slit alone, far from the tip: nothing happens above it.
  auto       below    = shapes::notched_plate<2, 2>({1., 1.}, {.5, .5}, {16, 16});
  const auto faces    = points_along(below, below.edge("lower_face").front());
  const int  n_before = below.patch(2).basis.n_elements(), n_below = below.patch(0).basis.n_elements();
  below.refine({faces[1]}, {{.5, .5}});
  CHECK(below.patch(0).basis.n_elements() > n_below);
  CHECK(below.patch(2).basis.n_elements() == n_before);
  check_faces(below, tip);
}

TEST_CASE("A notched plate that is cut keeps its slit open")
{
  const auto plate = split_patches(shapes::notched_plate<2, 2>({1., 1.}, {.5, .5}, {8, 8}), {2, 2});
  CHECK(plate.n_patches() == 16);
  CHECK(plate.interfaces().size() == 24 - 2); // of a 4 x 4 grid, without two faces
  check_faces(plate, Point<2>(.5, .5));
}

TEST_CASE("A notched plate without a notch is refused")
{
  using shapes::notched_plate;
  const double bad = GENERATE(0., 1., -1., std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_WITH((notched_plate<2, 2>({1., 1.}, {bad, .5}, {4, 4})), Catch::Contains("tip[0]"));
  CHECK_THROWS_AS((notched_plate<2, 2>({1., 1.}, {.5, bad}, {4, 4})), InvalidParameter);
  CHECK_THROWS_WITH((notched_plate<2, 2>({1., -1.}, {.5, .5}, {4, 4})), Catch::Contains("size[1] = -1"));
  CHECK_THROWS_WITH((notched_plate<2, 2>({1., 1.}, {.5, .5}, {4, 1})), Catch::Contains("elements[1] = 1"));
}
