// label: unit
#include <catch2/catch.hpp>

#include <numbers>

#include <sherd/geometry/shapes.h>
#include <sherd/output/crack_tracker.h>

#include "prescribed_cracks.h"

using namespace sherd;
using Eigen::Vector3d;

namespace
{

constexpr double   l0 = .12, sample = l0 / 8., c_R = 2., pi = std::numbers::pi;
const CrackOptions options{l0, c_R, l0 / 2.};
const double       half_width = ::test::Cracks{l0, {}}.half_width();

/// Optimal profile of the fourth-order density by the distance from the crack.
double profile(double distance)
{
  const double s = distance / l0;
  return 1. - (1. + s) * std::exp(-s);
}

/// Unit sphere of six patches.
const Surface<2, 3> &sphere()
{
  static const auto surface = shapes::sphere<2>(1., 40, shapes::Fit::smooth);
  return surface;
}

/// Cylinder of radius 1/2 and length 2 about the x axis, three patches joined along straight lines.
const Surface<2, 3> &cylinder()
{
  static const auto surface = shapes::closed_cylinder<2>(.5, 2., 3, {50, 26}, shapes::Fit::smooth);
  return surface;
}

/// Control values: the field at the points of the surface closest to the control points, of second order.
template <class Project, class Field>
Eigen::VectorXd control_values(const Surface<2, 3> &surface, const Project &project, const Field &field)
{
  const auto      X = surface.control_points();
  Eigen::VectorXd values(X.rows());
  for (int i = 0; i < X.rows(); ++i)
    values[i] = field(project(Vector3d(X.row(i).transpose())));
  return values;
}

/// Arcs of great circles.
struct Arcs
{
  std::vector<std::pair<Vector3d, Vector3d>> arcs; ///< between unit vectors less than pi apart

  double operator()(const Vector3d &X) const
  {
    double distance = 10.;
    for (const auto &[a, b] : arcs)
      {
        const Vector3d n      = a.cross(b).normalized();
        const bool     inside = n.cross(a).dot(X) >= 0. && b.cross(n).dot(X) >= 0.;
        const auto     angle  = [&](const Vector3d &Y) { return std::acos(std::clamp(X.dot(Y), -1., 1.)); };
        distance = std::min({distance, inside ? std::asin(std::min(1., std::abs(X.dot(n)))) : 10., angle(a), angle(b)});
      }
    return profile(distance);
  }
};

Eigen::VectorXd on_sphere(const std::function<double(Vector3d)> &field)
{
  return control_values(
      sphere(), [](const Vector3d &X) -> Vector3d { return X.normalized(); }, field);
}

/// A field of (x, arc length from the top) on the unrolled cylinder, periodic.
Eigen::VectorXd on_cylinder(const ::test::Cracks &cracks)
{
  return control_values(
      cylinder(), [](const Vector3d &X) { return X; },
      [&](const Vector3d &X) {
        const double s = .5 * std::atan2(X[1], X[2]);
        return std::min({cracks({X[0], s - pi}), cracks({X[0], s}), cracks({X[0], s + pi})});
      });
}

CrackTracker tracker_on_sphere(const std::function<double(Vector3d)> &field)
{
  CrackTracker tracker(sphere(), options);
  tracker.update(sphere(), on_sphere(field), 0.);
  return tracker;
}

/// The point at an angle from @p a towards @p b.
Vector3d along(const Vector3d &a, const Vector3d &b, double angle)
{
  const Vector3d normal = (b - a.dot(b) * a).normalized();
  return std::cos(angle) * a + std::sin(angle) * normal;
}

double distance_to_tip(const CrackTracker &tracker, const Vector3d &X)
{
  double distance = 10.;
  for (const auto &tip : tracker.tree().tips())
    if (tip.active)
      distance = std::min(distance, (tip.X - X).norm());
  return distance;
}

} // namespace

TEST_CASE("CrackTracker: an arc on a sphere crosses patches and has its length", "[output][crack]")
{
  // From the face +z over +x to -y, obliquely through both interfaces.
  const Vector3d a = Vector3d(.25, .3, 1.).normalized(), through = Vector3d(1., .1, .15).normalized();
  const double   length = GENERATE(.6, .9, 1.3, 2.2, 2.6);

  const auto tracker = tracker_on_sphere(Arcs{{{a, along(a, through, length)}}});

  INFO("length " << length << ", error in samples " << (tracker.length() - length - 2. * half_width) / sample);
  CHECK(tracker.tree().n_active() == 2);
  CHECK(tracker.cracks().arms.size() == 1);
  CHECK(std::abs(tracker.length() - length - 2. * half_width) < 4. * sample);
  // A tip that is less than 2 l0 behind an interface: its arm is too short there to have a direction of its own.
  const bool close = length == .6 || length == 2.2;
  CHECK(distance_to_tip(tracker, along(a, through, length + half_width)) < (close ? l0 : 2. * sample));
  CHECK(distance_to_tip(tracker, along(a, through, -half_width)) < 2. * sample);
}

TEST_CASE("CrackTracker: a loop around a sphere has its circumference and no tip", "[output][crack]")
{
  const double z = .3, radius = std::sqrt(1. - z * z);

  const auto tracker =
      tracker_on_sphere([=](const Vector3d &X) { return profile(std::abs(std::asin(X[2]) - std::asin(z))); });

  INFO("error in samples " << (tracker.length() - 2. * pi * radius) / sample);
  CHECK(tracker.tree().n_active() == 0);
  CHECK(tracker.cracks().nodes.empty());
  CHECK(std::abs(tracker.length() - 2. * pi * radius) < 4. * sample);
}

TEST_CASE("CrackTracker: an X on a sphere has four arms, across interfaces too", "[output][crack]")
{
  const Vector3d centre = GENERATE(Vector3d(.2, .1, 1.), Vector3d(.7, .1, 1.)).normalized();
  const Vector3d e = Vector3d(0., 1., .2).cross(centre).normalized(), f = centre.cross(e);
  const auto     end = [&](double degrees, double length) {
    const double t = degrees * pi / 180.;
    return along(centre, centre + std::cos(t) * e + std::sin(t) * f, length);
  };

  const auto tracker = tracker_on_sphere(Arcs{{{end(10., .8), end(190., .8)}, {end(80., .8), end(260., .8)}}});

  INFO("error in samples " << (tracker.length() - 3.2 - 4. * half_width) / sample);
  CHECK(tracker.tree().n_active() == 4);
  CHECK(tracker.cracks().arms.size() == 4);
  CHECK(std::abs(tracker.length() - 3.2 - 4. * half_width) < 6. * sample);
  for (const double degrees : {10., 80., 190., 260.})
    CHECK(distance_to_tip(tracker, end(degrees, .8 + half_width)) < 3. * sample);
}

TEST_CASE("CrackTracker: a crack that branches on a sphere keeps its tips and their tree across interfaces",
          "[output][crack]")
{
  const double   speed = .5 * c_R, dt = .3 * l0 / c_R, stem = .6, opening = 35. * pi / 180.;
  const Vector3d a = Vector3d(-.6, .1, 1.).normalized(), ahead = along(a, Vector3d::UnitX(), stem + .5);
  const Vector3d fork = along(a, ahead, stem), side = a.cross(ahead).normalized();
  const Vector3d forward = side.cross(fork).normalized();
  const auto     branch  = [&](double angle, double length) {
    return along(fork, fork + std::cos(angle) * forward + std::sin(angle) * side, length);
  };
  CrackTracker tracker(sphere(), options);

  // The arms leave the face +z at x = z, when they are more than 4 l0 long.
  for (int step = 0; step * dt * speed < 1.9; ++step)
    {
      const double grown = .3 + step * dt * speed;
      Arcs         cracks{{{a, along(a, ahead, std::min(grown, stem))}}};
      if (grown > stem)
        for (const double angle : {opening, -opening})
          cracks.arcs.push_back({fork, branch(angle, grown - stem)});
      tracker.update(sphere(), on_sphere(cracks), step * dt);
    }

  const auto &tree = tracker.tree();
  for (const auto &tip : tree.tips())
    UNSCOPED_INFO("tip " << tip.id << " from " << tip.parent << " at " << tip.X.transpose() << ", length " << tip.length
                         << (tip.active ? "" : ", gone"));
  REQUIRE(tree.tips().size() == 3); // both ends of the first crack, and the branch
  CHECK(tree.n_active() == 3);
  REQUIRE(tree.branchings().size() == 1);
  CHECK((tree.branchings()[0].X - fork).norm() < 3. * sample);
  CHECK(tree.branchings()[0].child == 2);
  CHECK(tree.tips()[2].parent == tree.branchings()[0].parent);
  const auto &parent = tree.tips()[tree.branchings()[0].parent];
  CHECK(tree.tips()[2].X[0] > tree.tips()[2].X[2]); // on the face +x by now
  CHECK(parent.X[0] > parent.X[2]);
  CHECK(tree.tips()[2].speed == Approx(speed).epsilon(.05));
  CHECK(parent.speed == Approx(speed).epsilon(.05));
}

TEST_CASE("CrackTracker: a helix on a cylinder has its speed, across interfaces too", "[output][crack]")
{
  // From the edge x = 0 around and along the cylinder; the interfaces are met at 50 degrees.
  const double         angle = 50. * pi / 180., speed = .55 * c_R, dt = .25 * l0 / c_R;
  const ::test::Vector start(-.3, .35), direction(std::cos(angle), std::sin(angle));
  const double         hidden = .3 / direction[0]; // before the edge
  CrackTracker         tracker(cylinder(), options);
  double               largest = 0., smallest = 10.;
  for (int step = 0; step < 80; ++step)
    {
      const double length = .6 + speed * step * dt;
      tracker.update(cylinder(), on_cylinder({l0, {{start, start + (hidden + length) * direction}}}), step * dt);
      INFO("step " << step);
      REQUIRE(tracker.tree().tips().size() == 1);
      CHECK(tracker.tree().n_active() == 1);
      // The edge of the body cuts the band obliquely: where it begins there is known to l0, and that does not change.
      CHECK(std::abs(tracker.length() - length - half_width) < l0);
      CHECK(tracker.tree().tips()[0].length == Approx(tracker.length()).margin(sample));
      if (step > 8)
        {
          largest  = std::max(largest, tracker.tree().tips()[0].speed);
          smallest = std::min(smallest, tracker.tree().tips()[0].speed);
        }
    }
  INFO("speeds over the true one: " << smallest / speed << " to " << largest / speed);
  CHECK(largest < 1.15 * speed);
  CHECK(smallest > .85 * speed);
}
