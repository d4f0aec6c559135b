// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/state/transfer.h>

using namespace sherd;

namespace
{

/// Reference coordinates of a quadrature point of a box.
std::array<double, 2> point_of(const Box &box, int q)
{
  const auto &p = BernsteinTable<2>::get().points[q];
  return {box.min[0] + p[0] * box.size()[0], box.min[1] + p[1] * box.size()[1]};
}

GlobalState<2, 2> random_state(const Surface<2, 2> &surface, unsigned seed)
{
  std::mt19937      random(seed);
  GlobalState<2, 2> state;
  const int         n    = surface.n_control_points();
  const auto        fill = [&](auto &values, int rows, int columns) {
    values.resize(rows, columns);
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values.data()[i] = test::symmetric(random);
  };
  fill(state.position, n, 2);
  fill(state.velocity, n, 2);
  fill(state.acceleration, n, 2);
  fill(state.phase, n, 1);
  fill(state.previous_phase, n, 1);
  fill(state.history, surface.n_elements(), 9);
  state.time = 3.;
  state.step = 8;
  return state;
}

/// Value of a field with control values in one column.
double at(const Patch<2, 2> &patch, const Eigen::VectorXd &values, double u, double v)
{
  return test::position_at(Patch<2, 1>{patch.basis, values, patch.weights}, u, v)[0];
}

} // namespace

TEST_CASE("Control values of all fields are carried exactly")
{
  const bool rational = GENERATE(false, true);
  auto       surface  = rational ? test::quarter_annulus<2, 2>(1., 2.) : shapes::plate<2, 2>({1., 1.}, {4, 4});
  const auto old      = random_state(surface, 3);
  const auto before   = surface.patch(0);
  const auto boxes    = element_boxes(surface);
  const auto refined  = rational ? test::refine_everywhere(surface, 1) : surface.refine({7, 8, 20}, {{.5, .5}});
  const auto now      = transfer(old, boxes, refined, surface);

  REQUIRE(now.phase.size() == surface.n_control_points());
  REQUIRE(now.history.rows() == surface.n_elements());
  CHECK(now.time == old.time);
  CHECK(now.step == old.step);
  std::mt19937 random(5);
  const double end     = rational ? 1. : 4.;
  double       largest = 0.;
  for (int k = 0; k < 60; ++k)
    {
      const double u = .5 * end * (1. + test::symmetric(random)), v = .5 * end * (1. + test::symmetric(random));
      const auto   compare = [&](const Eigen::VectorXd &a, const Eigen::VectorXd &b) {
        largest = std::max(largest, std::abs(at(before, a, u, v) - at(surface.patch(0), b, u, v)));
      };
      for (int d = 0; d < 2; ++d)
        {
          compare(old.position.col(d), now.position.col(d));
          compare(old.velocity.col(d), now.velocity.col(d));
          compare(old.acceleration.col(d), now.acceleration.col(d));
        }
      compare(old.phase, now.phase);
      compare(old.previous_phase, now.previous_phase);
    }
  CHECK(largest < 1e-14);
}

TEST_CASE("Each new quadrature point takes the history of a nearest one of its parent")
{
  auto surface = shapes::plate<2, 2>({1., 1.}, {4, 4});
  test::refine_at_random(surface, 1, 2, 6);
  const auto old   = random_state(surface, 4);
  const auto boxes = element_boxes(surface);
  // Elements of two sizes come apart.
  const auto refined  = surface.refine({5, 17, 30}, {{.25, .25}});
  const auto now      = transfer(old, boxes, refined, surface);
  const auto children = element_boxes(surface);
  REQUIRE(children.size() > boxes.size() + 10);

  for (std::size_t e = 0; e < children.size(); ++e)
    {
      const int   parent = refined.parent[e];
      const auto &box    = boxes[parent];
      for (int q = 0; q < 9; ++q)
        {
          const auto x        = point_of(children[e], q);
          const auto distance = [&](int k) {
            const auto y = point_of(box, k);
            // The nearest in the coordinates of the parent, where its points are known.
            return std::hypot((x[0] - y[0]) / box.size()[0], (x[1] - y[1]) / box.size()[1]);
          };
          double nearest = 1e300;
          for (int k = 0; k < 9; ++k)
            nearest = std::min(nearest, distance(k));
          bool found = false;
          for (int k = 0; k < 9; ++k)
            found = found || (now.history(e, q) == old.history(parent, k) && distance(k) < nearest + 1e-12);
          CHECK(found);
          CHECK(now.history(e, q) >= old.history.row(parent).minCoeff());
          CHECK(now.history(e, q) <= old.history.row(parent).maxCoeff());
        }
    }
}

TEST_CASE("An element that is not divided keeps its history")
{
  auto       surface = shapes::plate<2, 2>({1., 1.}, {4, 4});
  const auto old     = random_state(surface, 4);
  const auto boxes   = element_boxes(surface);
  const auto refined = surface.refine({0}, {{.5, .5}});
  const auto now     = transfer(old, boxes, refined, surface);
  int        n_kept  = 0;
  for (int e = 0; e < surface.n_elements(); ++e)
    if (surface.patch(0).basis.element(e) == boxes[refined.parent[e]])
      {
        ++n_kept;
        CHECK(now.history.row(e) == old.history.row(refined.parent[e]));
      }
  CHECK(n_kept == 15); // the corner function acts on one element
}

TEST_CASE("Mirrored histories stay mirrored")
{
  // The history is symmetric about the middle lines of the plate; refinement is, too.
  const auto reflected = [](int q, int d) { return d == 0 ? q / 3 * 3 + 2 - q % 3 : (2 - q / 3) * 3 + q % 3; };
  auto       surface   = shapes::plate<2, 2>({1., 1.}, {4, 4});
  auto       state     = random_state(surface, 4);
  const auto partner   = [](const Surface<2, 2> &s, int e, int d) {
    auto centre = s.patch(0).basis.element(e).centre();
    centre[d]   = 4. - centre[d];
    return s.patch(0).basis.element_at(centre[0], centre[1]);
  };
  for (int d = 0; d < 2; ++d)
    for (int e = 0; e < surface.n_elements(); ++e)
      for (int q = 0; q < 9; ++q)
        state.history(partner(surface, e, d), reflected(q, d)) = state.history(e, q);
  for (const double length : {.5, .25})
    {
      const auto boxes   = element_boxes(surface);
      const auto refined = test::refine_everywhere(surface, length == .5 ? 1 : 2);
      state              = transfer(state, boxes, refined, surface);
    }
  double largest = 0.;
  for (int d = 0; d < 2; ++d)
    for (int e = 0; e < surface.n_elements(); ++e)
      for (int q = 0; q < 9; ++q)
        largest =
            std::max(largest, std::abs(state.history(partner(surface, e, d), reflected(q, d)) - state.history(e, q)));
  CHECK(largest == 0.);
}

TEST_CASE("Ties go to the point further from the centre of the parent")
{
  // Quadrature points 1/2 -+ .3873 and 1/2. A child whose middle point lies half-way between two of them: 0.3064.
  const double half = .25 * (1. - std::sqrt(.6)) + .25;
  for (const double width : {.3, .5})
    {
      const auto left  = nearest_quadrature_points<2>(0., 1., half - .5 * width, half + .5 * width);
      const auto right = nearest_quadrature_points<2>(0., 1., 1. - half - .5 * width, 1. - half + .5 * width);
      CHECK(left[1] == 0);
      CHECK(right[1] == 2);
      for (int i = 0; i < 3; ++i)
        CHECK(left[i] == 2 - right[2 - i]);
    }
  // The same element, anywhere.
  CHECK(nearest_quadrature_points<2>(3., 7., 3., 7.) == std::array<int, 3>{0, 1, 2});
  CHECK(nearest_quadrature_points<3>(-1., 1., -1., 1.) == std::array<int, 4>{0, 1, 2, 3});
  // Halves: .056 .25 .444 in the left one.
  CHECK(nearest_quadrature_points<2>(0., 1., 0., .5) == std::array<int, 3>{0, 0, 1});
  CHECK(nearest_quadrature_points<2>(0., 1., .5, 1.) == std::array<int, 3>{1, 2, 2});
}
