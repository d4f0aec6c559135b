#include <catch2/catch.hpp>

#include <chrono>
#include <numbers>

#include <sherd/output/crack_tracker.h>

#include "prescribed_cracks.h"

using namespace sherd;
using test::Cracks;
using test::Vector;

namespace
{

constexpr double     l0 = 0.025, c_R = 2., sample = l0 / 8.;
constexpr int        n_elements = 160;
const CrackOptions   options{l0, c_R, l0 / 2.};
const Surface<2, 2> &unit_plate()
{
  static const auto plate = shapes::plate<2, 2>({1., 1.}, {n_elements, n_elements});
  return plate;
}

CrackTracker tracker_of(const std::function<double(Vector)> &phase)
{
  CrackTracker tracker(unit_plate(), options);
  tracker.update(unit_plate(), test::control_values(unit_plate(), phase), 0.);
  return tracker;
}

Vector polar(double r, double degrees)
{
  const double a = degrees * std::numbers::pi / 180.;
  return {r * std::cos(a), r * std::sin(a)};
}

double distance_to_tip(const CrackTracker &tracker, const Vector &p)
{
  double d = 1e300;
  for (const auto &tip : tracker.tree().tips())
    if (tip.active)
      d = std::min(d, (tip.X.head<2>() - p).norm());
  return d;
}

} // namespace

TEST_CASE("CrackTracker: a straight line at any angle has its length within a sample an end", "[output][crack]")
{
  const double angle = GENERATE(0., 7., 22.5, 30., 45., 61., 80., 90.);
  const Vector centre(0.503, 0.497), arm = polar(0.3, angle);
  const Cracks cracks{l0, {{centre - arm, centre + arm}}};

  const auto tracker = tracker_of(cracks);

  const double w = cracks.half_width();
  INFO("angle " << angle << " length error in samples " << (tracker.length() - 0.6 - 2. * w) / sample);
  CHECK(tracker.tree().n_active() == 2);
  CHECK(std::abs(tracker.length() - 0.6 - 2. * w) < 2. * sample);
  CHECK(distance_to_tip(tracker, centre + arm + w * arm.normalized()) < sample);
  CHECK(distance_to_tip(tracker, centre - arm - w * arm.normalized()) < sample);
  for (const auto &tip : tracker.tree().tips())
    {
      CHECK(tip.parent == -1);
      CHECK(tip.length == Approx(0.5 * tracker.length()).epsilon(1e-9)); // measured from the middle
    }
  for (const auto &X : tracker.cracks().arms.at(0).points)
    CHECK(test::distance_to_segment(X.head<2>(), centre - 2. * arm, centre + 2. * arm) < 0.5 * sample);
}

TEST_CASE("CrackTracker: a notch from the edge reaches from the edge to its only tip", "[output][crack]")
{
  const Cracks cracks{l0, {{{-0.2, 0.5}, {0.3, 0.5}}}};

  const auto tracker = tracker_of(cracks);

  REQUIRE(tracker.tree().n_active() == 1);
  CHECK(std::abs(tracker.length() - 0.3 - cracks.half_width()) < sample);
  CHECK(tracker.tree().tips()[0].length == Approx(tracker.length()).epsilon(1e-9));
}

TEST_CASE("CrackTracker: a Y has three arms that meet in its fork", "[output][crack]")
{
  const double half_angle = GENERATE(20., 30., 45., 60.);
  const Vector fork(0.5, 0.48), up = polar(0.3, half_angle), down = polar(0.3, -half_angle);
  const Cracks cracks{l0, {{{-0.2, 0.48}, fork}, {fork, fork + up}, {fork, fork + down}}};

  const auto tracker = tracker_of(cracks);

  const double w = cracks.half_width();
  INFO("half angle " << half_angle << " length error in samples " << (tracker.length() - 1.1 - 2. * w) / sample);
  CHECK(tracker.tree().n_active() == 2);
  CHECK(tracker.cracks().arms.size() == 3);
  CHECK(std::abs(tracker.length() - 1.1 - 2. * w) < 3. * sample);
  CHECK(distance_to_tip(tracker, fork + up * (1. + w / 0.3)) < sample);
  CHECK(distance_to_tip(tracker, fork + down * (1. + w / 0.3)) < sample);
  int branch_points = 0;
  for (const auto &node : tracker.cracks().nodes)
    if (node.degree == 3)
      {
        ++branch_points;
        INFO("fork found at " << node.point.X.transpose());
        CHECK((node.point.X.head<2>() - fork).norm() < 2. * sample);
      }
  CHECK(branch_points == 1);
}

TEST_CASE("CrackTracker: an X has one crossing of four arms", "[output][crack]")
{
  const double angle = GENERATE(30., 55., 90.);
  const Vector centre(0.5, 0.5), a = polar(0.35, 10.), b = polar(0.35, 10. + angle);
  const Cracks cracks{l0, {{centre - a, centre + a}, {centre - b, centre + b}}};

  const auto tracker = tracker_of(cracks);

  INFO("angle " << angle << " length error in samples "
                << (tracker.length() - 1.4 - 4. * cracks.half_width()) / sample);
  CHECK(tracker.tree().n_active() == 4);
  CHECK(tracker.cracks().arms.size() == 4);
  CHECK(std::abs(tracker.length() - 1.4 - 4. * cracks.half_width()) < 4. * sample);
  for (const auto &node : tracker.cracks().nodes)
    if (node.degree > 1)
      {
        CHECK(node.degree == 4);
        CHECK((node.point.X.head<2>() - centre).norm() < sample);
      }
}

TEST_CASE("CrackTracker: a closed loop has its circumference and no tip", "[output][crack]")
{
  const double radius = 0.25;

  const auto tracker = tracker_of([=](const Vector &p) {
    const double s = std::abs((p - Vector(0.5, 0.5)).norm() - radius) / l0;
    return 1. - (1. + s) * std::exp(-s);
  });

  INFO("length error in samples " << (tracker.length() - 2. * std::numbers::pi * radius) / sample);
  CHECK(tracker.tree().n_active() == 0);
  CHECK(tracker.cracks().nodes.empty());
  CHECK(std::abs(tracker.length() - 2. * std::numbers::pi * radius) < 2. * sample);
}

TEST_CASE("CrackTracker: arms shorter than 4 l0 are noise, longer ones count", "[output][crack]")
{
  const auto with_arm = [](double length) {
    return tracker_of(Cracks{l0, {{{-0.2, 0.5}, {0.7, 0.5}}, {{0.35, 0.5}, {0.35, 0.5 + length}}}});
  };

  const auto noise  = with_arm(2.5 * l0);
  const auto branch = with_arm(5. * l0);

  CHECK(noise.tree().n_active() == 1);
  CHECK(noise.cracks().arms.size() == 1);
  CHECK(std::abs(noise.length() - 0.7 - Cracks{l0, {}}.half_width()) < 2. * sample);
  CHECK(branch.tree().n_active() == 2);
  CHECK(branch.cracks().arms.size() == 3);
}

TEST_CASE("CrackTracker: a hole in the band is no loop", "[output][crack]")
{
  const Cracks cracks{l0, {{{0.2, 0.5}, {0.8, 0.5}}}};

  const auto tracker = tracker_of([&](const Vector &p) {
    return cracks(p) + 0.3 * std::exp(-(p - Vector(0.5, 0.5)).squaredNorm() / (0.06 * l0 * l0));
  });

  CHECK(tracker.tree().n_active() == 2);
  CHECK(tracker.cracks().arms.size() == 1);
  CHECK(std::abs(tracker.length() - 0.6 - 2. * cracks.half_width()) < 4. * sample);
}

TEST_CASE("CrackTracker: a spot without a line of its own is a short crack", "[output][crack]")
{
  const Cracks cracks{l0, {{{0.49, 0.5}, {0.51, 0.5}}}};

  const auto tracker = tracker_of(cracks);

  CHECK(tracker.tree().n_active() == 2);
  CHECK(std::abs(tracker.length() - 0.02 - 2. * cracks.half_width()) < 2. * sample);
}

TEST_CASE("CrackTracker: mirrored cracks have mirrored tips and the same length", "[output][crack]")
{
  const auto forked = [](double sign) {
    const Vector fork(0.45, 0.5 + sign * 0.031);
    return Cracks{l0,
                  {{{-0.2, fork[1]}, fork}, {fork, {0.8, fork[1] + sign * 0.2}}, {fork, {0.7, fork[1] - sign * 0.11}}}};
  };

  const auto up = tracker_of(forked(1.)), down = tracker_of(forked(-1.));

  // The thinning breaks ties towards one side; centring removes that up to a small part of a sample.
  CHECK(up.length() == Approx(down.length()).margin(0.2 * sample));
  REQUIRE(up.tree().n_active() == down.tree().n_active());
  for (const auto &tip : up.tree().tips())
    CHECK(distance_to_tip(down, {tip.X[0], 1. - tip.X[1]}) < 0.2 * sample);
}

TEST_CASE("CrackTracker: a growing crack keeps its tip and has its speed", "[output][crack]")
{
  const double curvature = GENERATE(0., 3.);
  const double speed = 0.55 * c_R, dt = 0.25 * l0 / c_R, start = 0.2;
  const auto   path = [=](double s) -> Vector {
    const Vector along = polar(1., 20.), normal = polar(1., 110.);
    if (curvature == 0.)
      return Vector(0.02, 0.3) + s * along;
    return Vector(0.02, 0.3) + (std::sin(curvature * s) * along + (1. - std::cos(curvature * s)) * normal) / curvature;
  };
  CrackTracker tracker(unit_plate(), options);

  for (int step = 0; step <= 30; ++step)
    {
      const double length = start + speed * step * dt;
      Cracks       cracks{l0, {{path(0.) - polar(0.3, 20.), path(0.)}}};
      for (int k = 0; k < 12; ++k)
        cracks.segments.push_back({path(length * k / 12), path(length * (k + 1) / 12)});
      tracker.update(unit_plate(), test::control_values(unit_plate(), cracks), step * dt);
      REQUIRE(tracker.tree().tips().size() == 1);
      if (step >= 5)
        CHECK(tracker.tree().tips()[0].speed == Approx(speed).epsilon(0.03));
      const Vector end = path(length) + cracks.half_width() * (path(length) - path(length - 1e-6)).normalized();
      // The last part of the line is straight, about two band widths: it leaves a path of radius 1/3 by 1.3 samples.
      CHECK(distance_to_tip(tracker, end) < (curvature == 0. ? 1. : 2.) * sample);
    }

  CHECK(tracker.tree().fastest()->id == 0);
  // The origin is where the first step saw the crack leave the plate.
  CHECK(tracker.tree().tips()[0].length == Approx(tracker.length()).margin(0.1 * sample));
  CHECK(tracker.tree().branchings().empty());
}

TEST_CASE("CrackTracker: tips keep their identity through branching and arrival", "[output][crack]")
{
  const double dt = 0.5 * l0 / c_R, step_length = 0.25 * l0;
  const Vector fork(0.3, 0.5);
  CrackTracker tracker(unit_plate(), options);
  double       branched_at = -1.;
  int          step        = 0;
  const auto   feed        = [&](const Cracks &cracks) {
    tracker.update(unit_plate(), test::control_values(unit_plate(), cracks), step++ * dt);
    if (branched_at < 0. && !tracker.tree().branchings().empty())
      branched_at = tracker.tree().branchings()[0].time;
  };

  for (double x = 0.2; x < fork[0] - 1e-9; x += step_length)
    feed({l0, {{{-0.2, 0.5}, {x, 0.5}}}});
  const int grown_to_fork = step;
  // The upper branch is the faster one; it leaves the plate at the top.
  double upper = 0., lower = 0.;
  for (; fork[1] + upper * std::sin(0.7) < 1.1; upper += 2. * step_length, lower += step_length)
    feed({l0,
          {{{-0.2, 0.5}, fork},
           {fork, fork + polar(upper + 1e-9, 0.7 * 180. / std::numbers::pi)},
           {fork, fork + polar(lower + 1e-9, -25.)}}});

  const auto &tree = tracker.tree();
  REQUIRE(tree.tips().size() == 2);
  REQUIRE(tree.branchings().size() == 1);
  CHECK((tree.branchings()[0].X.head<2>() - fork).norm() < 3. * sample);
  CHECK(tree.branchings()[0].parent == 0);
  CHECK(tree.branchings()[0].child == 1);
  CHECK(tree.tips()[1].parent == 0);
  // The lower arm, with half the band width at its end, exceeds 4 l0 after about 4 l0 / step_length steps.
  CHECK(branched_at / dt - grown_to_fork == Approx(4. * l0 / step_length).margin(4.));
  CHECK_FALSE(tree.tips()[0].active);
  CHECK(tree.tips()[1].active);
  CHECK(tree.tips()[0].X[1] > 1. - 2.6 * l0);
  const double w = Cracks{l0, {}}.half_width();
  CHECK(tree.tips()[1].length == Approx(fork[0] + lower - step_length + w).margin(3. * sample));
}

TEST_CASE("CrackTracker: refinement of the mesh changes nothing", "[output][crack]")
{
  auto            plate = shapes::plate<2, 2>({1., 1.}, {40, 40});
  const Cracks    cracks{2. * l0, {{{-0.2, 0.5}, {0.6, 0.53}}}};
  Eigen::VectorXd phase = test::control_values(plate, cracks);
  CrackTracker    tracker(plate, options);
  tracker.update(plate, phase, 0.);
  const double     before = tracker.length();
  std::vector<int> marked;
  for (int i = 0; i < phase.size(); ++i)
    if (phase[i] < 0.5)
      marked.push_back(i);

  const auto refinement = plate.refine(marked, SpanTarget{0.5, 0.5});
  tracker.update(plate, refinement.transfer.apply(phase), 1.);

  CHECK(tracker.length() == Approx(before).epsilon(1e-10));
  CHECK(tracker.tree().tips().size() == 1);
}

TEST_CASE("CrackTracker: a copy and a restored tracker go on as the original would", "[output][crack]")
{
  const auto phase = [](double length) {
    return test::control_values(unit_plate(), Cracks{l0, {{{-0.2, 0.5}, {length, 0.51}}}});
  };
  CrackTracker tracker(unit_plate(), options);
  for (int step = 0; step < 4; ++step)
    tracker.update(unit_plate(), phase(0.3 + 0.01 * step), 0.01 * step);
  CrackTracker       restored(unit_plate(), options);
  const CrackTracker before = tracker;
  restored.restore(tracker.tree().state());

  tracker.update(unit_plate(), phase(0.35), 0.05);
  restored.update(unit_plate(), phase(0.35), 0.05);

  CHECK(before.tree().tips()[0].recent.size() == 4);
  CHECK(tracker.tree().tips()[0].recent.size() == 5);
  CHECK(restored.tree().tips()[0].speed == tracker.tree().tips()[0].speed);
  CHECK(restored.tree().tips()[0].id == tracker.tree().tips()[0].id);
  CHECK(restored.length() == tracker.length());
}

TEST_CASE("CrackTracker: unusable options are refused", "[output][crack]")
{
  CHECK_THROWS_AS(CrackTracker(unit_plate(), {0., c_R, l0}), InvalidParameter);
  CHECK_THROWS_AS(CrackTracker(unit_plate(), {l0, -1., l0}), InvalidParameter);
  CHECK_THROWS_AS(CrackTracker(unit_plate(), {l0, c_R, l0, 1.5}), InvalidParameter);
  CrackTracker tracker(unit_plate(), options);
  CHECK_THROWS_AS(tracker.update(unit_plate(), Eigen::VectorXd::Ones(3), 0.), DimensionMismatch);
}
