#include "raw_cracks.h"

#include <algorithm>
#include <cmath>

namespace sherd
{
namespace
{

constexpr int    stride           = 4;  ///< every so many samples of the skeleton give a point
constexpr int    direction_reach  = 6;  ///< samples to both sides that give the direction of the skeleton
constexpr double strip_half_width = 4.; ///< along the skeleton, of the strip whose samples give one centre

Eigen::Vector2d to_vector(Sample s)
{
  return {double(s.i), double(s.j)};
}

bool is_broken(const SampleGrid &grid, const Eigen::Vector2d &p)
{
  return grid.depth_or_zero({static_cast<int>(std::floor(p[0] + 0.5)), static_cast<int>(std::floor(p[1] + 0.5))}) != 0;
}

/// Distance from @p p along @p direction to the first sample that is not broken.
double reach(const SampleGrid &grid, const Eigen::Vector2d &p, const Eigen::Vector2d &direction)
{
  double t = 0.5;
  while (is_broken(grid, p + t * direction))
    t += 0.5;
  return t - 0.25;
}

/// Distance to the side of the band in the direction of @p normal. Where another crack leaves along the normal, the
/// ways at 45 degrees to it give the width.
double side(const SampleGrid &grid, const Eigen::Vector2d &p, const Eigen::Vector2d &normal)
{
  const Eigen::Vector2d tangent(-normal[1], normal[0]);
  const double          c = std::sqrt(0.5);
  return std::min(
      {reach(grid, p, normal), c * reach(grid, p, c * (normal + tangent)), c * reach(grid, p, c * (normal - tangent))});
}

RawCracks::CentrePoint centre(const SampleGrid &grid, const LatticeField &field, const Eigen::Vector2d &at,
                              const Eigen::Vector2d &direction)
{
  const Eigen::Vector2d normal(-direction[1], direction[0]);
  const double          above = side(grid, at, normal), below = side(grid, at, -normal);
  const double          half_width = 0.5 * (above + below), middle = 0.5 * (above - below);

  const int extent = static_cast<int>(std::ceil(std::hypot(strip_half_width, half_width + std::abs(middle) + 1.5)));
  double    weight = 0., moment = 0.;
  for (int j = -extent; j <= extent; ++j)
    for (int i = -extent; i <= extent; ++i)
      {
        const Eigen::Vector2d offset(i, j);
        const double          s = offset.dot(direction), n = offset.dot(normal);
        if (std::abs(s) >= strip_half_width || std::abs(n - middle) > half_width + 1.5)
          continue;
        const double depth = grid.depth_or_zero({static_cast<int>(at[0]) + i, static_cast<int>(at[1]) + j});
        const double w     = depth * (1. - s * s / (strip_half_width * strip_half_width));
        weight += w;
        moment += w * n;
      }
  const Eigen::Vector2d point = at + (weight > 0. ? moment / weight : 0.) * normal;
  return {{point, field.position(point)}, half_width};
}

std::vector<RawCracks::CentrePoint> centre_points(const SkeletonGraph::Arm &arm, const SampleGrid &grid,
                                                  const LatticeField &field)
{
  std::vector<RawCracks::CentrePoint> result;
  const int                           n    = static_cast<int>(arm.samples.size());
  const bool                          loop = arm.nodes[0] < 0;
  for (int k = n > 0 ? (n - 1) % stride / 2 : 0; k < n; k += stride)
    {
      const int       before = loop ? (k - direction_reach % n + n) % n : std::max(k - direction_reach, 0);
      const int       after  = loop ? (k + direction_reach) % n : std::min(k + direction_reach, n - 1);
      Eigen::Vector2d along  = to_vector(arm.samples[after]) - to_vector(arm.samples[before]);
      if (along.norm() == 0.)
        along = {1., 0.};
      result.push_back(centre(grid, field, to_vector(arm.samples[k]), along.normalized()));
    }
  return result;
}

/// Removal and merging of arms until every one left counts.
class Pruner
{
public:
  Pruner(RawCracks &cracks, const LatticeField &field, const Pruning &pruning)
      : cracks_(cracks), field_(field), pruning_(pruning)
  {
    for (const auto &arm : cracks.arms)
      length_.push_back(cracks.length(arm));
  }

  void run()
  {
    while (remove_shortest_side_arm() || remove_shortest_loop() || contract_shortest_bridge())
      ;
  }

private:
  int  degree(int node) const { return cracks_.nodes[node].degree; }
  bool is_side_arm(const RawCracks::Arm &arm) const
  {
    return !arm.is_loop() && std::min(degree(arm.nodes[0]), degree(arm.nodes[1])) == 1 &&
           std::max(degree(arm.nodes[0]), degree(arm.nodes[1])) > 2;
  }

  double limit(const RawCracks::Arm &arm) const
  {
    const bool first_is_foot = degree(arm.nodes[0]) > 2;
    const int  foot          = arm.nodes[first_is_foot ? 0 : 1];
    const auto end           = cracks_.nodes[arm.other(foot)].point.X;
    return pruning_.is_cut(end) ? pruning_.known_limit : pruning_.side_arm_limit(cracks_.nodes[foot].point.X);
  }

  template <class Candidate>
  int shortest(const Candidate &candidate) const
  {
    int best = -1;
    for (int a = 0; a < static_cast<int>(cracks_.arms.size()); ++a)
      if ((best < 0 || length_[a] < length_[best]) && candidate(cracks_.arms[a], length_[a]))
        best = a;
    return best;
  }

  bool remove_shortest_side_arm()
  {
    const int a = shortest([&](const auto &arm, double length) { return is_side_arm(arm) && length < limit(arm); });
    return a >= 0 && remove(a);
  }

  bool remove_shortest_loop()
  {
    const int a = shortest([&](const auto &arm, double length) {
      return !arm.is_loop() && arm.nodes[0] == arm.nodes[1] && degree(arm.nodes[0]) > 2 && length < pruning_.limit;
    });
    return a >= 0 && remove(a);
  }

  bool contract_shortest_bridge()
  {
    const int a = shortest([&](const auto &arm, double length) {
      return !arm.is_loop() && arm.nodes[0] != arm.nodes[1] && degree(arm.nodes[0]) > 2 && degree(arm.nodes[1]) > 2 &&
             length < pruning_.limit;
    });
    if (a < 0)
      return false;
    const auto [kept, gone] = cracks_.arms[a].nodes;
    auto &node              = cracks_.nodes[kept];
    node.point.lattice      = 0.5 * (node.point.lattice + cracks_.nodes[gone].point.lattice);
    node.point.X            = field_.position(node.point.lattice);
    node.degree += degree(gone) - 2;
    cracks_.nodes[gone].in_use = false;
    erase(a);
    for (auto &arm : cracks_.arms)
      for (auto &end : arm.nodes)
        if (end == gone)
          end = kept;
    return true;
  }

  bool remove(int a)
  {
    const auto ends = cracks_.arms[a].nodes;
    erase(a);
    for (const int node : ends)
      cracks_.nodes[node].in_use = --cracks_.nodes[node].degree > 0;
    for (const int node : ends)
      if (degree(node) == 2 && cracks_.nodes[node].in_use)
        join_arms_of(node);
    return true;
  }

  /// Makes one arm of the two that meet at @p node.
  void join_arms_of(int node)
  {
    std::vector<int> arms;
    for (int a = 0; a < static_cast<int>(cracks_.arms.size()); ++a)
      if (cracks_.arms[a].nodes[0] == node || cracks_.arms[a].nodes[1] == node)
        arms.push_back(a);
    cracks_.nodes[node].in_use = false;
    if (arms.size() == 1)
      {
        cracks_.arms[arms[0]].nodes = {-1, -1};
        return;
      }
    auto &first = cracks_.arms[arms[0]], &second = cracks_.arms[arms[1]];
    if (first.nodes[1] != node)
      reverse(first);
    if (second.nodes[0] != node)
      reverse(second);
    first.points.insert(first.points.end(), second.points.begin(), second.points.end());
    first.nodes[1]   = second.nodes[1];
    length_[arms[0]] = cracks_.length(first);
    erase(arms[1]);
  }

  static void reverse(RawCracks::Arm &arm)
  {
    std::reverse(arm.points.begin(), arm.points.end());
    std::swap(arm.nodes[0], arm.nodes[1]);
  }

  void erase(int a)
  {
    cracks_.arms.erase(cracks_.arms.begin() + a);
    length_.erase(length_.begin() + a);
  }

  RawCracks          &cracks_;
  const LatticeField &field_;
  const Pruning      &pruning_;
  std::vector<double> length_;
};

} // namespace

std::vector<CrackPoint> RawCracks::path(const Arm &arm) const
{
  std::vector<CrackPoint> result;
  if (!arm.is_loop())
    result.push_back(nodes[arm.nodes[0]].point);
  for (const auto &p : arm.points)
    result.push_back(p.point);
  result.push_back(arm.is_loop() ? arm.points.front().point : nodes[arm.nodes[1]].point);
  return result;
}

double RawCracks::length(const Arm &arm) const
{
  const auto line   = path(arm);
  double     length = 0., samples = 0., missing = 0.;
  for (std::size_t k = 1; k < line.size(); ++k)
    {
      length += (line[k].X - line[k - 1].X).norm();
      samples += (line[k].lattice - line[k - 1].lattice).norm();
    }
  if (!arm.is_loop() && !arm.points.empty())
    {
      missing += nodes[arm.nodes[0]].degree == 1 ? arm.points.front().half_width : 0.;
      missing += nodes[arm.nodes[1]].degree == 1 ? arm.points.back().half_width : 0.;
    }
  return samples > 0. ? length * (1. + missing / samples) : 0.;
}

RawCracks raw_cracks(const SampleGrid &grid, const LatticeField &field)
{
  const auto skeleton = thin(grid);
  const auto graph    = skeleton_graph(skeleton);
  RawCracks  result;
  for (const auto &samples : graph.nodes)
    {
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (const auto &s : samples)
        mean += to_vector(s) / samples.size();
      result.nodes.push_back({{mean, field.position(mean)}});
    }
  for (const auto &arm : graph.arms)
    {
      result.arms.push_back({arm.nodes, centre_points(arm, grid, field)});
      for (const int node : arm.nodes)
        if (node >= 0)
          ++result.nodes[node].degree;
    }
  return result;
}

void prune(RawCracks &cracks, const LatticeField &field, const Pruning &pruning)
{
  Pruner(cracks, field, pruning).run();
}

} // namespace sherd
