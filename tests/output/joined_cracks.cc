// label: unit
#include <catch2/catch.hpp>

#include <map>
#include <numbers>

#include <geometry/joined_surfaces.h>
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
