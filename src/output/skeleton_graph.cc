#include <sherd/output/skeleton_graph.h>

#include <algorithm>

namespace sherd
{
namespace
{

/// Traces arms from node to node through samples of degree 2.
class Tracer
{
public:
  explicit Tracer(std::span<const Sample> skeleton)
      : skeleton_(skeleton), node_(skeleton.size(), -1), traced_(skeleton.size(), false)
  {
    for (std::size_t s = 0; s < skeleton.size(); ++s)
      neighbours_.push_back(find_neighbours(skeleton[s]));
  }

  SkeletonGraph run() &&
  {
    for (int s = 0; s < n(); ++s)
      if (neighbours_[s].size() != 2 && node_[s] < 0)
        add_node(s);
    for (int s = 0; s < n(); ++s)
      if (node_[s] >= 0)
        for (const int first : neighbours_[s])
          trace(s, first);
    for (int s = 0; s < n(); ++s)
      if (node_[s] < 0 && !traced_[s])
        trace_loop(s);
    return std::move(graph_);
  }

private:
  int n() const { return static_cast<int>(skeleton_.size()); }

  std::vector<int> find_neighbours(Sample s) const
  {
    std::vector<int> result;
    for (const auto &d : sample_neighbours)
      {
        const Sample other{s.i + d.i, s.j + d.j};
        const auto   found = std::lower_bound(skeleton_.begin(), skeleton_.end(), other);
        if (found != skeleton_.end() && *found == other)
          result.push_back(static_cast<int>(found - skeleton_.begin()));
      }
    return result;
  }

  void add_node(int seed)
  {
    const int        id = static_cast<int>(graph_.nodes.size());
    std::vector<int> cluster{seed};
    node_[seed] = id;
    if (neighbours_[seed].size() > 2)
      for (std::size_t k = 0; k < cluster.size(); ++k)
        for (const int other : neighbours_[cluster[k]])
          if (node_[other] < 0 && neighbours_[other].size() > 2)
            {
              node_[other] = id;
              cluster.push_back(other);
            }
    graph_.nodes.emplace_back();
    for (const int s : cluster)
      graph_.nodes.back().push_back(skeleton_[s]);
  }

  void trace(int start, int first)
  {
    if (node_[first] >= 0)
      {
        // Two nodes that touch, met from both sides: keep the one seen from the lower number.
        if (node_[first] > node_[start])
          graph_.arms.push_back({{node_[start], node_[first]}, {}});
        return;
      }
    if (traced_[first])
      return;
    SkeletonGraph::Arm arm{{node_[start], -1}, {}};
    int                previous = start, current = first;
    while (node_[current] < 0)
      {
        traced_[current] = true;
        arm.samples.push_back(skeleton_[current]);
        const int step = neighbours_[current][0] == previous ? neighbours_[current][1] : neighbours_[current][0];
        previous       = current;
        current        = step;
      }
    arm.nodes[1] = node_[current];
    graph_.arms.push_back(std::move(arm));
  }

  void trace_loop(int start)
  {
    SkeletonGraph::Arm arm{{-1, -1}, {}};
    for (int current = start; current >= 0;)
      {
        traced_[current] = true;
        arm.samples.push_back(skeleton_[current]);
        int next = -1;
        for (const int other : neighbours_[current])
          if (!traced_[other] && next < 0)
            next = other;
        current = next;
      }
    graph_.arms.push_back(std::move(arm));
  }

  std::span<const Sample>       skeleton_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<int>              node_;
  std::vector<char>             traced_;
  SkeletonGraph                 graph_;
};

} // namespace

SkeletonGraph skeleton_graph(std::span<const Sample> skeleton)
{
  return Tracer(skeleton).run();
}

} // namespace sherd
