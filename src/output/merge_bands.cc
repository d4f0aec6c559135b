#include <sherd/output/merge_bands.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Geometry>

namespace sherd
{
namespace
{

using Eigen::Vector3d;

constexpr double lengthwise = 3.5; ///< shortest run that counts as cut lengthwise, in l0
constexpr double beside     = 1.;  ///< largest distance of the lines on both sides from the run, in l0
constexpr int    stride     = 4;   ///< every so many points of a run give one of the merged line

double length_of(const std::vector<Vector3d> &points)
{
  double length = 0.;
  for (std::size_t k = 1; k < points.size(); ++k)
    length += (points[k] - points[k - 1]).norm();
  return length;
}

Vector3d closest_point(const Vector3d &X, const Vector3d &a, const Vector3d &b)
{
  const Vector3d edge   = b - a;
  const double   square = edge.squaredNorm();
  return a + (square > 0. ? std::clamp((X - a).dot(edge) / square, 0., 1.) : 0.) * edge;
}

/// Merged line along a part of a run.
struct MergedLine
{
  int              run;
  std::vector<int> places;   ///< in the run, ascending
  std::vector<int> vertices; ///< one for each place
};

/// Points and the edges between them: arms taken apart.
class PointGraph
{
public:
  int add(const Vector3d &X, int patch)
  {
    X_.push_back(X);
    patch_.push_back(patch);
    edges_.emplace_back();
    return static_cast<int>(X_.size()) - 1;
  }

  Vector3d &position(int point) { return X_[point]; }

  void connect(int a, int b)
  {
    ends_.push_back({a, b});
    edges_[a].push_back(static_cast<int>(ends_.size()) - 1);
    edges_[b].push_back(static_cast<int>(ends_.size()) - 1);
  }

  /// Arms between the points that have not two edges.
  PatchedCracks trace() const
  {
    PatchedCracks     result;
    std::vector<char> traced(ends_.size(), 0);
    std::vector<int>  node(X_.size(), -1);
    for (std::size_t v = 0; v < X_.size(); ++v)
      if (!edges_[v].empty() && edges_[v].size() != 2)
        {
          node[v] = static_cast<int>(result.graph.nodes.size());
          result.graph.nodes.push_back({{Eigen::Vector2d::Zero(), X_[v]}, static_cast<int>(edges_[v].size())});
          result.patch_of_node.push_back(patch_[v]);
        }
    const auto walk = [&](int v, int edge) {
      CrackGraph::Arm arm{{node[v], -1}, {X_[v]}, 0.};
      int             patch = patch_[v];
      for (const int start = v;;)
        {
          traced[edge] = 1;
          v            = ends_[edge][0] == v ? ends_[edge][1] : ends_[edge][0];
          arm.points.push_back(X_[v]);
          patch = patch == patch_[v] ? patch : -1;
          if (node[v] >= 0 || v == start)
            break;
          edge = edges_[v][0] == edge ? edges_[v][1] : edges_[v][0];
        }
      arm.nodes[1] = node[v];
      arm.length   = length_of(arm.points);
      result.graph.arms.push_back(std::move(arm));
      result.patch_of_arm.push_back(patch);
    };
    for (std::size_t v = 0; v < X_.size(); ++v)
      if (node[v] >= 0)
        for (const int edge : edges_[v])
          if (!traced[edge])
            walk(static_cast<int>(v), edge);
    for (std::size_t edge = 0; edge < ends_.size(); ++edge)
      if (!traced[edge])
        walk(ends_[edge][0], static_cast<int>(edge));
    return result;
  }

private:
  std::vector<Vector3d>           X_;
  std::vector<int>                patch_;
  std::vector<std::vector<int>>   edges_; ///< of each point
  std::vector<std::array<int, 2>> ends_;  ///< of each edge
};

class Merger
{
public:
  Merger(const PatchedCracks &cracks, const std::vector<BrokenRun> &runs, double l0)
      : cracks_(cracks), runs_(runs), l0_(l0)
  {
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (length_of(runs[r].points) > lengthwise * l0)
        add_lines(static_cast<int>(r));
  }

  bool empty() const { return lines_.empty(); }

  PatchedCracks run()
  {
    std::vector<int>              vertex_of_node;
    std::set<std::pair<int, int>> links;
    const auto                   &graph = cracks_.graph;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
      {
        vertex_of_node.push_back(vertex(graph.nodes[n].point.X, cracks_.patch_of_node[n]));
        if (graph.nodes[n].degree == 1)
          extend(vertex_of_node.back(), graph.nodes[n].point.X);
      }
    for (std::size_t a = 0; a < graph.arms.size(); ++a)
      {
        const auto      &arm     = graph.arms[a];
        const bool       is_loop = arm.nodes[0] < 0;
        std::vector<int> path;
        if (!is_loop)
          path.push_back(vertex_of_node[arm.nodes[0]]);
        for (std::size_t k = is_loop ? 0 : 1; k + 1 < arm.points.size(); ++k)
          path.push_back(vertex(arm.points[k], cracks_.patch_of_arm[a]));
        path.push_back(is_loop ? path.front() : vertex_of_node[arm.nodes[1]]);
        for (std::size_t k = 1; k < path.size(); ++k)
          {
            const int from = path[k - 1], to = path[k];
            if (from == to || connected_by_line(from, to))
              continue;
            const bool link = place_.count(from) && place_.count(to);
            if (!link || links.insert(std::minmax(from, to)).second)
              points_.connect(from, to);
          }
      }
    return points_.trace();
  }

private:
  bool is_on_side(const BrokenRun &run, int side, const Vector3d &offset) const
  {
    return run.patches[0] != run.patches[1] || (offset.dot(run.across) > 0.) == (side == 1);
  }

  /// From place @p k of a run to the closest centre line on one of its sides, without the part along the run.
  std::optional<Vector3d> offset(const BrokenRun &run, std::size_t k, int side) const
  {
    const Vector3d         &Y        = run.points[k];
    double                  distance = beside * l0_;
    std::optional<Vector3d> nearest;
    for (std::size_t a = 0; a < cracks_.graph.arms.size(); ++a)
      if (cracks_.patch_of_arm[a] == run.patches[side])
        {
          const auto &points = cracks_.graph.arms[a].points;
          for (std::size_t i = 1; i < points.size(); ++i)
            if ((points[i] - Y).squaredNorm() < 16. * l0_ * l0_ || (points[i - 1] - Y).squaredNorm() < 16. * l0_ * l0_)
              {
                const Vector3d X = closest_point(Y, points[i - 1], points[i]);
                if (const double d = (X - Y).norm(); d < distance && is_on_side(run, side, X - Y))
                  {
                    distance = d;
                    nearest  = X;
                  }
              }
        }
    if (!nearest)
      return {};
    const Vector3d along =
        (run.points[std::min(k + 1, run.points.size() - 1)] - run.points[k > 0 ? k - 1 : 0]).normalized();
    return Vector3d(*nearest - Y - (*nearest - Y).dot(along) * along);
  }

  void add_lines(int r)
  {
    const auto                          &run = runs_[r];
    std::vector<std::optional<Vector3d>> middle;
    for (std::size_t k = 0; k < run.points.size(); ++k)
      {
        auto &X = middle.emplace_back();
        if (const auto first = offset(run, k, 0))
          if (const auto second = offset(run, k, 1))
            {
              const double c1 = first->norm(), c2 = second->norm(), larger = std::max(c1, c2);
              X = run.points[k];
              if (larger > 0.)
                *X += std::abs(c1 - c2) / larger * (c1 > c2 ? *first : *second);
            }
      }
    for (std::size_t begin = 0; begin < middle.size();)
      {
        std::size_t end = begin;
        while (end < middle.size() && middle[end])
          ++end;
        if (end - begin > 2 * stride)
          add_line(r, static_cast<int>(begin), static_cast<int>(end), middle);
        begin = end + 1;
      }
  }

  void add_line(int r, int begin, int end, const std::vector<std::optional<Vector3d>> &middle)
  {
    MergedLine line{r, {}, {}};
    for (int k = begin; k < end; ++k)
      if (k == begin || k == end - 1 || ((k - begin) % stride == 0 && k + stride <= end - 1))
        {
          line.places.push_back(k);
          line.vertices.push_back(points_.add(*middle[k], -1));
          place_[line.vertices.back()] = {static_cast<int>(lines_.size()), static_cast<int>(line.places.size()) - 1};
          if (line.vertices.size() > 1)
            points_.connect(line.vertices[line.vertices.size() - 2], line.vertices.back());
        }
    lines_.push_back(std::move(line));
  }

  /// The point of a merged line that takes the place of @p X, or one of its own.
  int vertex(const Vector3d &X, int patch)
  {
    double distance = beside * l0_;
    int    found    = -1;
    for (const auto &line : lines_)
      {
        const auto &run = runs_[line.run];
        if (run.patches[0] != patch && run.patches[1] != patch)
          continue;
        for (int k = line.places.front(); k <= line.places.back(); ++k)
          if (const double d = (run.points[k] - X).norm(); d < distance)
            {
              distance         = d;
              const auto after = std::lower_bound(line.places.begin(), line.places.end(), k);
              const auto i     = after - line.places.begin();
              found            = i > 0 && *after - k > k - line.places[i - 1] ? line.vertices[i - 1] : line.vertices[i];
            }
      }
    return found >= 0 ? found : points_.add(X, patch);
  }

  /// Lets a merged line that ends in a point go on to where the end of a line at @p X is ahead of it: next to the
  /// middle of its round end, a band is shorter.
  void extend(int vertex, const Vector3d &X)
  {
    const auto found = place_.find(vertex);
    if (found == place_.end())
      return;
    const auto &line   = lines_[found->second.first];
    const auto &points = runs_[line.run].points;
    for (const auto &[end, next] : {std::pair(line.places.front(), line.places.front() + 1),
                                    std::pair(line.places.back(), line.places.back() - 1)})
      if (line.places[found->second.second] == end)
        {
          const Vector3d ahead = (points[end] - points[next]).normalized();
          Vector3d      &tip   = points_.position(vertex);
          tip += std::max((X - tip).dot(ahead), 0.) * ahead;
        }
  }

  /// Whether two points are close to each other on one merged line.
  bool connected_by_line(int a, int b) const
  {
    const auto first = place_.find(a), second = place_.find(b);
    return first != place_.end() && second != place_.end() && first->second.first == second->second.first &&
           std::abs(first->second.second - second->second.second) <= 8;
  }

  const PatchedCracks               &cracks_;
  const std::vector<BrokenRun>      &runs_;
  double                             l0_;
  std::vector<MergedLine>            lines_;
  std::map<int, std::pair<int, int>> place_; ///< line and place of each of its points
  PointGraph                         points_;
};

/// Removes what is too short to count of the arms that start from merged lines.
class MergedPruner
{
public:
  MergedPruner(PatchedCracks &cracks, const Pruning &pruning) : cracks_(cracks), pruning_(pruning) {}

  void run()
  {
    while (remove_shortest() || contract_shortest())
      ;
  }

private:
  CrackGraph &graph() { return cracks_.graph; }
  int         degree(int node) const { return cracks_.graph.nodes[node].degree; }

  bool is_branch(int node) const { return node >= 0 && degree(node) > 2; }
  bool is_merged_branch(int node) const { return is_branch(node) && cracks_.patch_of_node[node] < 0; }

  double limit(int node) const
  {
    for (const auto &known : pruning_.known_branch_points)
      if ((known - cracks_.graph.nodes[node].point.X).norm() < pruning_.known_radius)
        return pruning_.known_limit;
    return pruning_.limit;
  }

  template <class Candidate>
  int shortest(const Candidate &candidate) const
  {
    int         best = -1;
    const auto &arms = cracks_.graph.arms;
    for (int a = 0; a < static_cast<int>(arms.size()); ++a)
      if ((best < 0 || arms[a].length < arms[best].length) && candidate(arms[a]))
        best = a;
    return best;
  }

  /// Side arms and loops.
  bool remove_shortest()
  {
    const int a = shortest([&](const CrackGraph::Arm &arm) {
      const auto [m, n] = arm.nodes;
      if (m < 0)
        return false;
      if (m == n)
        return is_merged_branch(m) && arm.length < pruning_.limit;
      const int foot = degree(m) == 1 ? n : m, tip = foot == m ? n : m;
      return degree(tip) == 1 && is_merged_branch(foot) && arm.length < limit(foot);
    });
    if (a < 0)
      return false;
    const auto nodes = graph().arms[a].nodes;
    erase(a);
    for (const int node : nodes)
      --graph().nodes[node].degree;
    if (degree(nodes[0]) == 2)
      join_arms_of(nodes[0]);
    if (nodes[1] != nodes[0] && degree(nodes[1]) == 2)
      join_arms_of(nodes[1]);
    return true;
  }

  bool contract_shortest()
  {
    const int a = shortest([&](const CrackGraph::Arm &arm) {
      const auto [m, n] = arm.nodes;
      return m != n && is_branch(m) && is_branch(n) && (is_merged_branch(m) || is_merged_branch(n)) &&
             arm.length < pruning_.limit;
    });
    if (a < 0)
      return false;
    const auto [kept, gone] = graph().arms[a].nodes;
    auto &node              = graph().nodes[kept];
    node.point.X            = .5 * (node.point.X + graph().nodes[gone].point.X);
    node.degree += degree(gone) - 2;
    cracks_.patch_of_node[kept] = -1;
    graph().nodes[gone].degree  = 0;
    erase(a);
    for (auto &arm : graph().arms)
      for (int end = 0; end < 2; ++end)
        if (arm.nodes[end] == kept || arm.nodes[end] == gone)
          {
            arm.nodes[end]                                      = kept;
            (end == 0 ? arm.points.front() : arm.points.back()) = node.point.X;
            arm.length                                          = length_of(arm.points);
          }
    return true;
  }

  void join_arms_of(int node)
  {
    std::vector<int> arms;
    for (int a = 0; a < static_cast<int>(graph().arms.size()); ++a)
      if (graph().arms[a].nodes[0] == node || graph().arms[a].nodes[1] == node)
        arms.push_back(a);
    graph().nodes[node].degree = 0;
    auto &first                = graph().arms[arms[0]];
    if (arms.size() == 1)
      {
        first.nodes = {-1, -1};
        return;
      }
    auto &second = graph().arms[arms[1]];
    if (first.nodes[1] != node)
      reverse(first);
    if (second.nodes[0] != node)
      reverse(second);
    first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
    first.nodes[1] = second.nodes[1];
    first.length += second.length;
    if (cracks_.patch_of_arm[arms[0]] != cracks_.patch_of_arm[arms[1]])
      cracks_.patch_of_arm[arms[0]] = -1;
    erase(arms[1]);
  }

  static void reverse(CrackGraph::Arm &arm)
  {
    std::swap(arm.nodes[0], arm.nodes[1]);
    std::reverse(arm.points.begin(), arm.points.end());
  }

  void erase(int a)
  {
    graph().arms.erase(graph().arms.begin() + a);
    cracks_.patch_of_arm.erase(cracks_.patch_of_arm.begin() + a);
  }

  PatchedCracks &cracks_;
  const Pruning &pruning_;
};

/// Removes nodes without arms.
void drop_unused_nodes(PatchedCracks &cracks)
{
  std::vector<int>              number, patches;
  std::vector<CrackGraph::Node> nodes;
  for (std::size_t n = 0; n < cracks.graph.nodes.size(); ++n)
    {
      number.push_back(static_cast<int>(nodes.size()));
      if (cracks.graph.nodes[n].degree > 0)
        {
          nodes.push_back(cracks.graph.nodes[n]);
          patches.push_back(cracks.patch_of_node[n]);
        }
    }
  for (auto &arm : cracks.graph.arms)
    for (int &node : arm.nodes)
      node = node < 0 ? node : number[node];
  cracks.graph.nodes   = std::move(nodes);
  cracks.patch_of_node = std::move(patches);
}

} // namespace

void merge_bands(PatchedCracks &cracks, const std::vector<BrokenRun> &runs, double length_scale, const Pruning &pruning)
{
  Merger merger(cracks, runs, length_scale);
  if (merger.empty())
    return;
  cracks = merger.run();
  MergedPruner(cracks, pruning).run();
  drop_unused_nodes(cracks);
}

} // namespace sherd
