#include <sherd/output/join_cracks.h>

#include <algorithm>
#include <tuple>

namespace sherd
{
namespace
{

using Eigen::Vector3d;

/// Graph whose arms carry their patches while they are joined; arms and nodes that are gone stay as gaps until the end.
class Joiner
{
public:
  Joiner(CrackGraph &graph, const std::vector<int> &patch_of_arm)
      : graph_(graph),
        node_gone_(graph.nodes.size(), 0),
        arm_gone_(graph.arms.size(), 0),
        is_whole_(graph.arms.size(), 1)
  {
    for (const int patch : patch_of_arm)
      patches_.push_back({patch});
  }

  const Vector3d &X(int node) const { return graph_.nodes[node].point.X; }

  int arm_of(int end) const
  {
    for (std::size_t a = 0; a < graph_.arms.size(); ++a)
      if (!arm_gone_[a] && (graph_.arms[a].nodes[0] == end || graph_.arms[a].nodes[1] == end))
        return static_cast<int>(a);
    return -1;
  }

  /// Makes one arm of those that end in @p i and @p j.
  void join(int i, int j, double trim)
  {
    const int a = arm_of(i), b = arm_of(j);
    node_gone_[i] = node_gone_[j] = 1;
    turn(a, [&](const auto &nodes) { return nodes[1] == i; });
    auto &first = graph_.arms[a];
    if (a == b)
      {
        const double length = std::min(trim, .25 * first.length);
        cut_back(first, length);
        std::reverse(first.points.begin(), first.points.end());
        cut_back(first, length);
        first.points.push_back(first.points.front());
        first.nodes = {-1, -1};
      }
    else
      {
        turn(b, [&](const auto &nodes) { return nodes[1] == j; });
        auto &second = graph_.arms[b];
        cut_back(first, std::min(trim, .5 * first.length));
        cut_back(second, std::min(trim, .5 * second.length));
        turn(b, [&](const auto &nodes) { return nodes[0] == j; });
        first.points.insert(first.points.end(), second.points.begin(), second.points.end());
        first.nodes[1] = second.nodes[1];
        is_whole_[a]   = 0;
        patches_[a].insert(patches_[a].end(), patches_[b].begin(), patches_[b].end());
        arm_gone_[b] = 1;
      }
    measure(first);
  }

  /// A place on an arm: on the line to its point number `point`, which is not the first.
  struct Place
  {
    int         arm   = -1; ///< none
    std::size_t point = 0;
    double      distance;
    Vector3d    X;
  };

  /// The place within @p radius of end @p i that is closest to it, on another arm that is not of its patch alone.
  Place closest_elsewhere(int i, int patch, double radius) const
  {
    const int own = arm_of(i);
    Place     best{.distance = radius};
    for (std::size_t a = 0; a < graph_.arms.size(); ++a)
      {
        const bool elsewhere =
            std::any_of(patches_[a].begin(), patches_[a].end(), [&](int other) { return other != patch; });
        if (arm_gone_[a] || static_cast<int>(a) == own || !elsewhere)
          continue;
        const auto &points = graph_.arms[a].points;
        for (std::size_t k = 1; k < points.size(); ++k)
          {
            const Vector3d edge   = points[k] - points[k - 1];
            const double   square = edge.squaredNorm();
            const double   t      = square > 0. ? std::clamp((X(i) - points[k - 1]).dot(edge) / square, 0., 1.) : 0.;
            const Vector3d place  = points[k - 1] + t * edge;
            if (const double distance = (X(i) - place).norm(); distance < best.distance)
              best = {static_cast<int>(a), k, distance, place};
          }
      }
    return best;
  }

  /// Lets the arm of end @p i start from a place on another.
  void branch(int i, const Place &place)
  {
    const int         own        = arm_of(i);
    const int         best_arm   = place.arm;
    const std::size_t best_point = place.point;
    const Vector3d    best_X     = place.X;
    is_whole_[own] = is_whole_[best_arm] = 0;

    // The end becomes the branch point; the arm it meets is cut there.
    turn(own, [&](const auto &nodes) { return nodes[1] == i; });
    graph_.arms[own].points.push_back(best_X);
    measure(graph_.arms[own]);
    graph_.nodes[i].point.X = best_X;
    graph_.nodes[i].degree  = 3;
    CrackGraph::Arm rest    = graph_.arms[best_arm];
    rest.points.erase(rest.points.begin(), rest.points.begin() + static_cast<std::ptrdiff_t>(best_point));
    rest.points.insert(rest.points.begin(), best_X);
    auto &start = graph_.arms[best_arm];
    start.points.resize(best_point);
    start.points.push_back(best_X);
    if (start.nodes[0] < 0)
      {
        // A loop: one arm from the branch point around to it.
        start.points.insert(start.points.begin(), rest.points.begin(), rest.points.end() - 1);
        start.nodes = {i, i};
        measure(start);
        return;
      }
    start.nodes[1] = i;
    rest.nodes[0]  = i;
    measure(start);
    measure(rest);
    graph_.arms.push_back(std::move(rest));
    arm_gone_.push_back(0);
    patches_.push_back(patches_[best_arm]);
    is_whole_.push_back(0);
  }

  /// Removes side arms that are too short, the shortest first, and contracts short bridges, among those that interfaces
  /// have cut.
  void prune(const Pruning &pruning)
  {
    while (remove_shortest_side_arm(pruning) || contract_shortest_bridge(pruning))
      ;
  }

  /// Removes what is gone.
  void finish()
  {
    std::vector<int>              number;
    std::vector<CrackGraph::Node> nodes;
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
      {
        number.push_back(static_cast<int>(nodes.size()));
        if (!node_gone_[n])
          nodes.push_back(graph_.nodes[n]);
      }
    std::vector<CrackGraph::Arm> arms;
    for (std::size_t a = 0; a < graph_.arms.size(); ++a)
      if (!arm_gone_[a])
        {
          arms.push_back(std::move(graph_.arms[a]));
          for (int &node : arms.back().nodes)
            node = node < 0 ? node : number[node];
        }
    graph_.nodes = std::move(nodes);
    graph_.arms  = std::move(arms);
  }

private:
  int &degree(int node) { return graph_.nodes[node].degree; }

  /// The shortest arm that is there, no loop, and a candidate; -1: none.
  template <class Candidate>
  int shortest(const Candidate &candidate)
  {
    int best = -1;
    for (int a = 0; a < static_cast<int>(graph_.arms.size()); ++a)
      {
        const auto &arm = graph_.arms[a];
        if (!arm_gone_[a] && arm.nodes[0] >= 0 && arm.nodes[0] != arm.nodes[1] &&
            (best < 0 || arm.length < graph_.arms[best].length) && candidate(a, arm))
          best = a;
      }
    return best;
  }

  bool remove_shortest_side_arm(const Pruning &pruning)
  {
    const int a = shortest([&](int b, const CrackGraph::Arm &arm) {
      const bool first_is_end = degree(arm.nodes[0]) == 1;
      const int  end = arm.nodes[first_is_end ? 0 : 1], foot = arm.nodes[first_is_end ? 1 : 0];
      return degree(end) == 1 && degree(foot) > 2 && (!is_whole_[b] || pruning.is_cut(X(end))) &&
             arm.length < pruning.side_arm_limit(X(foot));
    });
    if (a < 0)
      return false;
    arm_gone_[a] = 1;
    for (const int node : graph_.arms[a].nodes)
      if (--degree(node) == 0)
        node_gone_[node] = 1;
      else if (degree(node) == 2)
        join_arms_of(node);
    return true;
  }

  bool contract_shortest_bridge(const Pruning &pruning)
  {
    const int a = shortest([&](int b, const CrackGraph::Arm &arm) {
      return !is_whole_[b] && degree(arm.nodes[0]) > 2 && degree(arm.nodes[1]) > 2 && arm.length < pruning.limit;
    });
    if (a < 0)
      return false;
    const auto [kept, gone] = graph_.arms[a].nodes;
    const Vector3d middle   = .5 * (X(kept) + X(gone));
    arm_gone_[a] = node_gone_[gone] = 1;
    degree(kept) += degree(gone) - 2;
    graph_.nodes[kept].point.X = middle;
    for (auto &arm : graph_.arms)
      for (int end = 0; end < 2; ++end)
        if (arm.nodes[end] == kept || arm.nodes[end] == gone)
          {
            arm.nodes[end]                                      = kept;
            (end == 0 ? arm.points.front() : arm.points.back()) = middle;
            measure(arm);
          }
    return true;
  }

  /// Makes one arm of the two that meet at a node.
  void join_arms_of(int node)
  {
    node_gone_[node] = 1;
    std::vector<int> arms;
    for (int a = 0; a < static_cast<int>(graph_.arms.size()); ++a)
      if (!arm_gone_[a] && (graph_.arms[a].nodes[0] == node || graph_.arms[a].nodes[1] == node))
        arms.push_back(a);
    auto &first = graph_.arms[arms[0]];
    if (arms.size() == 1)
      {
        first.nodes = {-1, -1};
        return;
      }
    turn(arms[0], [&](const auto &nodes) { return nodes[1] == node; });
    turn(arms[1], [&](const auto &nodes) { return nodes[0] == node; });
    const auto &second = graph_.arms[arms[1]];
    first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
    first.nodes[1] = second.nodes[1];
    patches_[arms[0]].insert(patches_[arms[0]].end(), patches_[arms[1]].begin(), patches_[arms[1]].end());
    is_whole_[arms[0]] = 0;
    arm_gone_[arms[1]] = 1;
    measure(first);
  }

  /// Turns an arm around unless its nodes are as wanted.
  template <class Wanted>
  void turn(int a, const Wanted &wanted)
  {
    auto &arm = graph_.arms[a];
    if (wanted(arm.nodes))
      return;
    std::swap(arm.nodes[0], arm.nodes[1]);
    std::reverse(arm.points.begin(), arm.points.end());
  }

  /// Takes @p length away at the second end.
  static void cut_back(CrackGraph::Arm &arm, double length)
  {
    auto &points = arm.points;
    while (points.size() > 1)
      {
        const Vector3d step = points[points.size() - 2] - points.back();
        if (const double d = step.norm(); d > length)
          {
            points.back() += length / d * step;
            return;
          }
        else
          length -= d;
        points.pop_back();
      }
  }

  static void measure(CrackGraph::Arm &arm)
  {
    arm.length = 0.;
    for (std::size_t k = 1; k < arm.points.size(); ++k)
      arm.length += (arm.points[k] - arm.points[k - 1]).norm();
  }

  CrackGraph                   &graph_;
  std::vector<std::vector<int>> patches_;                         ///< of each arm
  std::vector<char>             node_gone_, arm_gone_, is_whole_; ///< no interface has cut the arm
};

} // namespace

std::vector<int> connected_parts(const std::vector<Eigen::Vector3d> &points, double distance)
{
  std::vector<int> part(points.size(), -1), queue;
  int              n_parts = 0;
  for (std::size_t start = 0; start < points.size(); ++start)
    {
      if (part[start] >= 0)
        continue;
      part[start] = n_parts++;
      queue       = {static_cast<int>(start)};
      for (std::size_t k = 0; k < queue.size(); ++k)
        for (std::size_t i = 0; i < points.size(); ++i)
          if (part[i] < 0 && (points[i] - points[queue[k]]).norm() <= distance)
            {
              part[i] = part[start];
              queue.push_back(static_cast<int>(i));
            }
    }
  return part;
}

void join_cracks(CrackGraph &graph, const std::vector<int> &patch_of_arm, const std::vector<CutEnd> &ends,
                 const std::vector<char> &self_joined, const JoinDistances &distances, const Pruning &pruning)
{
  Joiner joiner(graph, patch_of_arm);
  struct Pair
  {
    bool        same_patch;
    double      distance;
    std::size_t first, second;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size(); ++j)
      {
        const bool   same     = ends[i].patch == ends[j].patch;
        const bool   on_one   = ends[i].patch < 0 || ends[j].patch < 0; // an interface
        const bool   may_join = !same || on_one || self_joined[ends[i].patch];
        const double distance = (joiner.X(ends[i].node) - joiner.X(ends[j].node)).norm();
        if (ends[i].crossing == ends[j].crossing && distance <= distances.reach && may_join &&
            ((!same && !on_one) || joiner.arm_of(ends[i].node) != joiner.arm_of(ends[j].node)))
          pairs.push_back({same, distance, i, j});
      }
  std::sort(pairs.begin(), pairs.end(), [](const Pair &a, const Pair &b) {
    return std::tie(a.same_patch, a.distance, a.first, a.second) <
           std::tie(b.same_patch, b.distance, b.first, b.second);
  });
  std::vector<int> pieces; // the arm of each end, as long as it is alone
  for (const auto &end : ends)
    pieces.push_back(joiner.arm_of(end.node));
  std::vector<char> joined(ends.size(), 0);
  for (const auto &pair : pairs)
    if (!joined[pair.first] && !joined[pair.second])
      {
        joined[pair.first] = joined[pair.second] = 1;
        joiner.join(ends[pair.first].node, ends[pair.second].node, distances.trim);
      }

  // A piece goes over a crossing once; where it is joined there already, its other end close by is a tip.
  std::vector<std::pair<double, std::size_t>> left;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (!joined[i] && ends[i].patch >= 0)
      left.emplace_back(joiner.closest_elsewhere(ends[i].node, ends[i].patch, distances.reach).distance, i);
  std::sort(left.begin(), left.end());
  for (const auto &[distance, i] : left)
    {
      bool goes_over = false;
      for (std::size_t j = 0; j < ends.size(); ++j)
        goes_over |= joined[j] && pieces[j] == pieces[i] && ends[j].crossing == ends[i].crossing;
      if (goes_over)
        continue;
      if (const auto place = joiner.closest_elsewhere(ends[i].node, ends[i].patch, distances.reach); place.arm >= 0)
        {
          joined[i] = 1;
          joiner.branch(ends[i].node, place);
        }
    }
  joiner.prune(pruning);
  joiner.finish();
}

} // namespace sherd
