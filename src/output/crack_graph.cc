#include <sherd/output/crack_graph.h>

#include "raw_cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>

namespace sherd
{
namespace
{

using Eigen::Vector2d;

struct Line
{
  Vector2d base, direction;
};

/// Least-squares line through points; its direction points from the first to the last.
Line fit(std::span<const CrackPoint> points)
{
  Vector2d mean = Vector2d::Zero();
  for (const auto &p : points)
    mean += p.lattice / points.size();
  double xx = 0., yy = 0., xy = 0.;
  for (const auto &p : points)
    {
      const Vector2d d = p.lattice - mean;
      xx += d[0] * d[0];
      yy += d[1] * d[1];
      xy += d[0] * d[1];
    }
  const double angle = 0.5 * std::atan2(2. * xy, xx - yy); // of the principal axis
  Vector2d     direction(std::cos(angle), std::sin(angle));
  if (direction.dot(points.back().lattice - points.front().lattice) < 0.)
    direction = -direction;
  return {mean, direction};
}

double median_half_width(const RawCracks::Arm &arm)
{
  std::vector<double> widths;
  for (const auto &p : arm.points)
    widths.push_back(p.half_width);
  if (widths.empty())
    return 1.;
  const auto middle = widths.begin() + widths.size() / 2;
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

double lattice_length(std::span<const CrackPoint> line)
{
  double length = 0.;
  for (std::size_t k = 1; k < line.size(); ++k)
    length += (line[k].lattice - line[k - 1].lattice).norm();
  return length;
}

/// Turns raw cracks into the final graph: step 4 of crack_graph().
class Finisher
{
public:
  Finisher(const RawCracks &raw, const SampleGrid &grid, const LatticeField &field)
      : raw_(raw), grid_(grid), field_(field)
  {
    for (const auto &arm : raw.arms)
      {
        half_width_.push_back(median_half_width(arm));
        kept_.push_back(keep(arm, half_width_.back()));
      }
  }

  CrackGraph run()
  {
    for (std::size_t n = 0; n < raw_.nodes.size(); ++n)
      {
        number_.push_back(static_cast<int>(result_.nodes.size()));
        const auto &node = raw_.nodes[n];
        if (node.in_use && node.degree > 0)
          result_.nodes.push_back({node.degree > 2 ? branch_point(static_cast<int>(n)) : node.point, node.degree});
        else if (node.in_use)
          add_spot(node.point);
      }
    for (std::size_t a = 0; a < raw_.arms.size(); ++a)
      add_arm(static_cast<int>(a));
    return std::move(result_);
  }

private:
  const RawCracks::Node &node(int n) const { return raw_.nodes[n]; }
  bool                   is_end(int n) const { return n >= 0 && node(n).degree == 1; }

  /// The points of an arm that neither the rounded end of the band nor the other arms at a branch point disturb.
  std::vector<CrackPoint> keep(const RawCracks::Arm &arm, double half_width) const
  {
    std::vector<CrackPoint> kept;
    const auto              line = raw_.path(arm);
    if (arm.is_loop())
      return line;
    const double total = lattice_length(line);
    const auto   drop  = [&](int n) {
      return is_end(n) && !is_at_side(node(n).point.lattice, half_width + 2.) ? 5. : 2. * half_width + 2.;
    };
    double s = 0.;
    for (std::size_t k = 1; k + 1 < line.size(); ++k)
      {
        s += (line[k].lattice - line[k - 1].lattice).norm();
        if (s >= drop(arm.nodes[0]) && total - s >= drop(arm.nodes[1]))
          kept.push_back(line[k]);
      }
    return kept;
  }

  /// True next to a side of the patch, where a band has corners and its skeleton may end in one of them.
  bool is_at_side(const Vector2d &p, double margin) const
  {
    return std::min(p[0], p[1]) < margin || p[0] > grid_.n_i() - 1 - margin || p[1] > grid_.n_j() - 1 - margin;
  }

  /// Line through the kept points of an arm next to one of its ends, pointing towards that end.
  /// @pre there is a kept point
  Line line_at(int a, bool at_second) const
  {
    std::vector<CrackPoint> near = kept_[a];
    if (!at_second)
      std::reverse(near.begin(), near.end());
    const double reach = 2. * half_width_[a] + 6.;
    std::size_t  first = near.size() - 1;
    while (first > 0 && (near[first - 1].lattice - near.back().lattice).norm() <= reach)
      --first;
    if (near.size() - first < 2)
      {
        const auto &end = node(raw_.arms[a].nodes[at_second]).point.lattice;
        return {near.back().lattice, (end - near.back().lattice).normalized()};
      }
    return fit(std::span(near).subspan(first));
  }

  /// The point closest to the lines of all arms of the node, in the sense of least squares.
  CrackPoint branch_point(int n) const
  {
    constexpr double pull   = 0.02; // towards the node of the skeleton, in case the lines are parallel
    const Vector2d   start  = node(n).point.lattice;
    Eigen::Matrix2d  matrix = pull * Eigen::Matrix2d::Identity();
    Vector2d         rhs    = pull * start;
    double           reach  = 2.;
    for (std::size_t a = 0; a < raw_.arms.size(); ++a)
      for (int side = 0; side < 2; ++side)
        if (raw_.arms[a].nodes[side] == n && !kept_[a].empty())
          {
            const Line            line      = line_at(static_cast<int>(a), side == 1);
            const Eigen::Matrix2d projector = Eigen::Matrix2d::Identity() - line.direction * line.direction.transpose();
            matrix += projector;
            rhs += projector * line.base;
            reach = std::max(reach, 4. * half_width_[a] + 2.);
          }
    const Vector2d p = matrix.inverse() * rhs;
    return (p - start).norm() > reach ? node(n).point : CrackPoint{p, field_.position(p)};
  }

  /// Where phi reaches the threshold, or the patch ends, on the ray.
  std::optional<double> contour(const Vector2d &base, const Vector2d &direction) const
  {
    const auto broken = [&](double t) { return field_.phase(base + t * direction) < field_.threshold; };
    if (!broken(0.))
      return std::nullopt;
    double inside = 0., outside = 0.5;
    while (broken(outside))
      {
        inside = outside;
        outside += 0.5;
      }
    for (int k = 0; k < 20; ++k)
      {
        const double middle                 = 0.5 * (inside + outside);
        (broken(middle) ? inside : outside) = middle;
      }
    return inside;
  }

  /// The end of arm @p a, which leaves from the kept points or, without those, from @p start.
  CrackPoint end_point(int a, bool at_second, const Vector2d &start) const
  {
    const Vector2d skeleton_end = node(raw_.arms[a].nodes[at_second]).point.lattice;
    Vector2d       base         = start;
    Vector2d       direction    = skeleton_end - start;
    if (!kept_[a].empty())
      {
        base      = (at_second ? kept_[a].back() : kept_[a].front()).lattice;
        direction = line_at(a, at_second).direction;
      }
    const double to_skeleton_end = (skeleton_end - base).norm();
    auto         t               = contour(base, direction.normalized());
    // A crack that turns sharply within the last band width leaves the ray before its end.
    if ((!t || *t < to_skeleton_end - 1.) && to_skeleton_end > 0.)
      {
        direction = skeleton_end - base;
        t         = contour(base, direction.normalized());
      }
    if (!t || *t < to_skeleton_end - 1.)
      return node(raw_.arms[a].nodes[at_second]).point;
    const Vector2d end = base + *t * direction.normalized();
    return {end, field_.position(end)};
  }

  void add_arm(int a)
  {
    const auto     &arm = raw_.arms[a];
    CrackGraph::Arm out;
    if (!arm.is_loop())
      {
        const auto [first, second] = arm.nodes;
        if (is_end(first) && is_end(second) && kept_[a].size() < 2)
          {
            add_spot(arm.points.empty() ? node(first).point : arm.points[arm.points.size() / 2].point,
                     {number_[first], number_[second]});
            return;
          }
        out.nodes = {number_[first], number_[second]};
        for (int side = 0; side < 2; ++side)
          if (is_end(arm.nodes[side]))
            {
              const Vector2d start                 = is_end(arm.nodes[1 - side]) ? kept_[a].front().lattice
                                                                                 : result_.nodes[out.nodes[1 - side]].point.lattice;
              result_.nodes[out.nodes[side]].point = end_point(a, side == 1, start);
            }
        out.points.push_back(result_.nodes[out.nodes[0]].point.X);
      }
    else
      out.nodes = {-1, -1};
    for (const auto &p : kept_[a])
      out.points.push_back(p.X);
    if (!arm.is_loop())
      out.points.push_back(result_.nodes[out.nodes[1]].point.X);
    add(std::move(out));
  }

  void add(CrackGraph::Arm arm)
  {
    arm.length = 0.;
    for (std::size_t k = 1; k < arm.points.size(); ++k)
      arm.length += (arm.points[k] - arm.points[k - 1]).norm();
    result_.arms.push_back(std::move(arm));
  }

  void add_spot(const CrackPoint &seed)
  {
    const int first = static_cast<int>(result_.nodes.size());
    result_.nodes.resize(first + 2, {seed, 1});
    add_spot(seed, {first, first + 1});
  }

  /// The principal axis of the connected broken samples around @p seed, from contour to contour.
  void add_spot(const CrackPoint &seed, std::array<int, 2> nodes)
  {
    const auto     samples = connected_samples(seed.lattice);
    const Line     axis    = samples.size() < 2 ? Line{seed.lattice, {1., 0.}} : fit(samples);
    const Vector2d base    = contour(axis.base, axis.direction) ? axis.base : seed.lattice;
    for (int side = 0; side < 2; ++side)
      {
        const Vector2d direction         = side == 0 ? Vector2d(-axis.direction) : axis.direction;
        const Vector2d end               = base + contour(base, direction).value_or(0.) * direction;
        result_.nodes[nodes[side]].point = {end, field_.position(end)};
      }
    add({nodes, {result_.nodes[nodes[0]].point.X, field_.position(base), result_.nodes[nodes[1]].point.X}, 0.});
  }

  std::vector<CrackPoint> connected_samples(const Vector2d &seed) const
  {
    const Sample start{static_cast<int>(std::lround(seed[0])), static_cast<int>(std::lround(seed[1]))};
    if (grid_.depth_or_zero(start) == 0)
      return {};
    std::vector<CrackPoint> result;
    SampleGrid              rest  = grid_;
    std::vector<Sample>     queue = {start};
    rest.erase(start);
    for (std::size_t k = 0; k < queue.size(); ++k)
      {
        result.push_back({Vector2d(queue[k].i, queue[k].j), Eigen::Vector3d::Zero()});
        for (const auto &d : sample_neighbours)
          if (const Sample s{queue[k].i + d.i, queue[k].j + d.j}; rest.depth(s) != 0)
            {
              rest.erase(s);
              queue.push_back(s);
            }
      }
    std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
      return std::pair(a.lattice[0], a.lattice[1]) < std::pair(b.lattice[0], b.lattice[1]);
    });
    return result;
  }

  const RawCracks                     &raw_;
  const SampleGrid                    &grid_;
  const LatticeField                  &field_;
  std::vector<double>                  half_width_;
  std::vector<std::vector<CrackPoint>> kept_;
  std::vector<int>                     number_; ///< of raw nodes in the result
  CrackGraph                           result_;
};

} // namespace

double CrackGraph::length() const
{
  double sum = 0.;
  for (const auto &arm : arms)
    sum += arm.length;
  return sum;
}

void CrackGraph::append(CrackGraph other)
{
  const int offset = static_cast<int>(nodes.size());
  nodes.insert(nodes.end(), other.nodes.begin(), other.nodes.end());
  for (auto &arm : other.arms)
    {
      for (auto &n : arm.nodes)
        n += n < 0 ? 0 : offset;
      arms.push_back(std::move(arm));
    }
}

CrackGraph crack_graph(const SampleGrid &grid, const LatticeField &field, const Pruning &pruning)
{
  auto raw = raw_cracks(grid, field);
  prune(raw, field, pruning);
  return Finisher(raw, grid, field).run();
}

ShortestPaths shortest_paths(const CrackGraph &graph, int start)
{
  const auto        n = graph.nodes.size();
  ShortestPaths     result{std::vector<double>(n, std::numeric_limits<double>::infinity()), std::vector<int>(n, -1)};
  std::vector<char> done(n, false);
  result.distance[start] = 0.;
  for (;;)
    {
      int nearest = -1;
      for (std::size_t k = 0; k < n; ++k)
        if (!done[k] && std::isfinite(result.distance[k]) &&
            (nearest < 0 || result.distance[k] < result.distance[nearest]))
          nearest = static_cast<int>(k);
      if (nearest < 0)
        return result;
      done[nearest] = true;
      for (std::size_t a = 0; a < graph.arms.size(); ++a)
        for (int side = 0; side < 2; ++side)
          if (graph.arms[a].nodes[side] == nearest)
            {
              const int    to       = graph.arms[a].nodes[1 - side];
              const double distance = result.distance[nearest] + graph.arms[a].length;
              if (distance < result.distance[to])
                {
                  result.distance[to] = distance;
                  result.arm[to]      = static_cast<int>(a);
                }
            }
    }
}

} // namespace sherd
