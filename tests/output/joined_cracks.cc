// label: unit
#include <catch2/catch.hpp>

#include <map>
#include <numbers>

#include <geometry/joined_surfaces.h>
#include <sherd/geometry/shapes/sphere.h>
#include <sherd/output/crack_tracker.h>

#include "prescribed_cracks.h"

using namespace sherd;
using ::test::Cracks;
using ::test::Vector;

namespace
{

constexpr double   l0 = .05, sample = l0 / 8.;
const CrackOptions options{l0, 2., l0 / 2.};

/// The unit square cut in two by x = x_cut; the parameters of both parts run in several ways.
const Surface<2, 2> &cut_plate(int way)
{
  static std::map<int, Surface<2, 2>> plates;
  if (const auto found = plates.find(way); found != plates.end())
    return found->second;
  const double cut  = .5;
  const auto   part = [](double from, double to) {
    return sherd::test::bilinear<2, 2>({Point<2>(from, 0.), Point<2>(to, 0.), Point<2>(from, 1.), Point<2>(to, 1.)},
                                       sherd::test::equal_knots<2>(40, 0., 40.),
                                       sherd::test::equal_knots<2>(80, 0., 80.));
  };
  std::vector<Patch<2, 2>> patches{sherd::test::reoriented(part(0., cut), way),
                                   sherd::test::reoriented(part(cut, 1.), (3 * way) % 8)};
  return plates.emplace(way, Surface<2, 2>(patches, {}, find_interfaces(patches))).first->second;
}

CrackTracker tracker_of(const std::function<double(Vector)> &phase, int way = 0)
{
  const auto  &plate = cut_plate(way);
  CrackTracker tracker(plate, options);
  tracker.update(plate, ::test::control_values(plate, phase), 0.);
  return tracker;
}

} // namespace

TEST_CASE("CrackTracker: a crack that crosses an interface is one crack", "[output][crack]")
{
  const int    way   = GENERATE(0, 5, 6);
  const double angle = GENERATE(0., 20., 45., -60.) * std::numbers::pi / 180.;
  const Vector centre(.47, .52), arm = .3 * Vector(std::cos(angle), std::sin(angle));
  const Cracks cracks{l0, {{centre - arm, centre + arm}}};

  const auto tracker = tracker_of(cracks, way);

  const double w = cracks.half_width();
  INFO("way " << way << ", angle " << angle << ", length error in samples "
              << (tracker.length() - .6 - 2. * w) / sample);
  CHECK(tracker.tree().n_active() == 2);
  REQUIRE(tracker.cracks().arms.size() == 1);
  CHECK(tracker.cracks().nodes.size() == 2);
  CHECK(std::abs(tracker.length() - .6 - 2. * w) < 3. * sample);
  for (const auto &tip : tracker.tree().tips())
    CHECK(std::min((tip.X.head<2>() - centre - arm * (1. + w / .3)).norm(),
                   (tip.X.head<2>() - centre + arm * (1. + w / .3)).norm()) < sample);
}

TEST_CASE("CrackTracker: a notch goes on behind an interface, a tip at it stays a tip", "[output][crack]")
{
  for (const double end : {.44, .49, .5, .51, .56})
    {
      const Cracks cracks{l0, {{{-.2, .5}, {end, .5}}}};
      const auto   tracker = tracker_of(cracks, 3);
      INFO("ends at x = " << end);
      REQUIRE(tracker.tree().n_active() == 1);
      CHECK(std::abs(tracker.length() - end - cracks.half_width()) < 3. * sample);
      CHECK(tracker.tree().tips()[0].length == Approx(tracker.length()).epsilon(1e-9));
    }
}

TEST_CASE("CrackTracker: a loop across an interface has its circumference and no tip", "[output][crack]")
{
  const double radius  = .25;
  const auto   tracker = tracker_of(
      [=](const Vector &p) {
        const double s = std::abs((p - Vector(.45, .5)).norm() - radius) / l0;
        return 1. - (1. + s) * std::exp(-s);
      },
      1);
  CHECK(tracker.tree().n_active() == 0);
  CHECK(tracker.cracks().nodes.empty());
  REQUIRE(tracker.cracks().arms.size() == 1);
  CHECK(std::abs(tracker.length() - 2. * std::numbers::pi * radius) < 4. * sample);
}

TEST_CASE("CrackTracker: a fork at an interface keeps its three arms", "[output][crack]")
{
  // The fork lies behind the interface, so close that its stem is too short to count there.
  const double x = GENERATE(.46, .54, .58);
  const Vector fork(x, .5), up = .3 * Vector(std::cos(.7), std::sin(.7)), down(up[0], -up[1]);
  const Cracks cracks{l0, {{{-.2, .5}, fork}, {fork, fork + up}, {fork, fork + down}}};

  const auto tracker = tracker_of(cracks, 2);

  const double w = cracks.half_width();
  INFO("fork at x = " << x << ", length error in samples " << (tracker.length() - x - .6 - 2. * w) / sample);
  CHECK(tracker.tree().n_active() == 2);
  CHECK(tracker.cracks().arms.size() == 3);
  int n_forks = 0;
  for (const auto &node : tracker.cracks().nodes)
    n_forks += node.degree == 3;
  CHECK(n_forks == 1);
  CHECK(std::abs(tracker.length() - x - .6 - 2. * w) < 8. * sample);
}

TEST_CASE("CrackTracker: a crack along an interface is one crack, on it and next to it", "[output][crack]")
{
  const int    way    = GENERATE(0, 5, 6);
  const double offset = GENERATE(0., .2, -.45, .6) * l0;
  const Cracks cracks{l0, {{{.5 + offset, .25}, {.5 + offset, .75}}}};

  const auto tracker = tracker_of(cracks, way);

  const double w = cracks.half_width();
  INFO("way " << way << ", offset " << offset / l0 << " l0, length error in samples "
              << (tracker.length() - .5 - 2. * w) / sample);
  CHECK(tracker.tree().n_active() == 2);
  REQUIRE(tracker.cracks().arms.size() == 1);
  CHECK(std::abs(tracker.length() - .5 - 2. * w) < 2. * sample);
  for (const auto &X : tracker.cracks().arms[0].points)
    CHECK(std::abs(X[0] - .5 - offset) < sample);
}

TEST_CASE("CrackTracker: a crack that goes over to the other side at a small angle is one crack", "[output][crack]")
{
  const int    way   = GENERATE(0, 3);
  const double angle = GENERATE(3., 8., 14., 25.) * std::numbers::pi / 180.;
  const Vector arm   = .35 * Vector(std::sin(angle), std::cos(angle)), centre(.49, .5);
  const Cracks cracks{l0, {{centre - arm, centre + arm}}};

  const auto tracker = tracker_of(cracks, way);

  const double w = cracks.half_width();
  INFO("way " << way << ", angle " << angle << ", length error in samples "
              << (tracker.length() - .7 - 2. * w) / sample);
  CHECK(tracker.tree().n_active() == 2);
  REQUIRE(tracker.cracks().arms.size() == 1);
  CHECK(std::abs(tracker.length() - .7 - 2. * w) < 3. * sample);
}

TEST_CASE("CrackTracker: a crack joins an interface, runs along it and leaves it", "[output][crack]")
{
  const Vector from(.35, .2), first(.5, .35), second(.5, .65), to(GENERATE(.35, .65), .8);
  const Cracks cracks{l0, {{from, first}, {first, second}, {second, to}}};

  const auto tracker = tracker_of(cracks, 6);

  const double expected = .3 + 2. * (first - from).norm() + 2. * cracks.half_width();
  INFO("leaves to x = " << to[0] << ", length error in samples " << (tracker.length() - expected) / sample);
  CHECK(tracker.tree().n_active() == 2);
  REQUIRE(tracker.cracks().arms.size() == 1);
  CHECK(std::abs(tracker.length() - expected) < 5. * sample);
}

TEST_CASE("CrackTracker: a crack along an interface forks to both sides, or to one", "[output][crack]")
{
  const Vector fork(.5, .5), left(.5 - .25 * std::sin(.8), .5 + .25 * std::cos(.8)), right(1. - left[0], left[1]);
  const auto   other = GENERATE(Vector(.5, .8), Vector(.5 - .25 * std::sin(.8), .5 + .25 * std::cos(.8)));
  const Cracks cracks{l0, {{{.5, -.1}, fork}, {fork, other}, {fork, right}}};

  const auto tracker = tracker_of(cracks, 0);

  const double expected = .5 + (other - fork).norm() + .25 + 2. * cracks.half_width();
  INFO("second arm to " << other.transpose() << ", length error in samples " << (tracker.length() - expected) / sample);
  CHECK(tracker.tree().n_active() == 2);
  CHECK(tracker.cracks().arms.size() == 3);
  CHECK(std::abs(tracker.length() - expected) < 8. * sample);
}

namespace
{

/// Distance on the unit sphere to an arc of a great circle between unit vectors.
double distance_to_arc(const Eigen::Vector3d &X, const Eigen::Vector3d &a, const Eigen::Vector3d &b)
{
  const Eigen::Vector3d normal = a.cross(b).normalized(), foot = (X - X.dot(normal) * normal).normalized();
  const auto            angle = [](const Eigen::Vector3d &u, const Eigen::Vector3d &v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  if (a.cross(foot).dot(normal) >= 0. && foot.cross(b).dot(normal) >= 0.)
    return angle(X, foot);
  return std::min(angle(X, a), angle(X, b));
}

/// Cracks along arcs on a sphere of six patches.
CrackTracker on_sphere(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> &arcs)
{
  static const auto sphere = shapes::sphere<2>(1., 64);
  const auto        X      = sphere.control_points();
  Eigen::VectorXd   phase(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    {
      double d = 1e300;
      for (const auto &[a, b] : arcs)
        d = std::min(d, distance_to_arc(X.row(i).transpose().normalized(), a, b));
      phase[i] = 1. - (1. + d / l0) * std::exp(-d / l0);
    }
  CrackTracker tracker(sphere, options);
  tracker.update(sphere, phase, 0.);
  return tracker;
}

} // namespace

TEST_CASE("CrackTracker: a Y on the interfaces of a three-patch corner", "[output][crack]")
{
  // The corners of the patches are those of a cube.
  const double                                             r = .6, c = std::sqrt(1. / 3.);
  const Eigen::Vector3d                                    corner = Eigen::Vector3d(c, c, c);
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> arcs;
  for (int k = 0; k < 3; ++k)
    {
      Eigen::Vector3d other       = corner;
      other[k]                    = -c;
      const Eigen::Vector3d along = (other - other.dot(corner) * corner).normalized();
      arcs.push_back({corner, std::cos(r) * corner + std::sin(r) * along});
    }

  const auto tracker = on_sphere(arcs);

  const double expected = 3. * (r + Cracks{l0, {}}.half_width());
  INFO("length error in samples " << (tracker.length() - expected) / sample);
  CHECK(tracker.tree().n_active() == 3);
  CHECK(tracker.cracks().arms.size() == 3);
  REQUIRE(tracker.cracks().nodes.size() == 4);
  for (const auto &node : tracker.cracks().nodes)
    if (node.degree == 3)
      CHECK((node.point.X - corner).norm() < 2. * sample);
  CHECK(std::abs(tracker.length() - expected) < 6. * sample);
}

TEST_CASE("CrackTracker: a crack around a patch, on its border, is a loop", "[output][crack]")
{
  const double                                             c = std::sqrt(1. / 3.);
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> arcs;
  const Eigen::Vector3d                                    corners[] = {{c, c, c}, {-c, c, c}, {-c, -c, c}, {c, -c, c}};
  for (int k = 0; k < 4; ++k)
    arcs.push_back({corners[k], corners[(k + 1) % 4]});

  const auto tracker = on_sphere(arcs);

  const double expected = 4. * std::acos(1. / 3.);
  INFO("length error in samples " << (tracker.length() - expected) / sample);
  CHECK(tracker.tree().n_active() == 0);
  CHECK(tracker.cracks().arms.size() == 1);
  CHECK(tracker.cracks().nodes.empty());
  CHECK(std::abs(tracker.length() - expected) < 12. * sample);
}
