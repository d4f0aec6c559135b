#include <sherd/output/crack_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <sherd/base/exceptions.h>

namespace sherd
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The arm that ends at node @p end, a node of degree 1.
int arm_of_end(const CrackGraph &graph, int end)
{
  for (std::size_t a = 0; a < graph.arms.size(); ++a)
    if (graph.arms[a].nodes[0] == end || graph.arms[a].nodes[1] == end)
      return static_cast<int>(a);
  return -1;
}

/// A place on an arm: arc length from its first point.
struct Place
{
  int    arm = -1;
  double s   = 0.;
};

/// The place of the graph that is closest to @p X.
Place closest_place(const CrackGraph &graph, const Eigen::Vector3d &X)
{
  Place  best;
  double best_distance = infinity;
  for (std::size_t a = 0; a < graph.arms.size(); ++a)
    {
      const auto &points = graph.arms[a].points;
      double      s      = 0.;
      for (std::size_t k = 1; k < points.size(); ++k)
        {
          const Eigen::Vector3d edge   = points[k] - points[k - 1];
          const double          length = edge.norm();
          const double t = length > 0. ? std::clamp((X - points[k - 1]).dot(edge) / (length * length), 0., 1.) : 0.;
          const double distance = (X - points[k - 1] - t * edge).norm();
          if (distance < best_distance)
            {
              best_distance = distance;
              best          = {static_cast<int>(a), s + t * length};
            }
          s += length;
        }
    }
  return best;
}

/// Arc length from the start of @p paths to a place; infinite without a way.
double distance_to(const CrackGraph &graph, const ShortestPaths &paths, const Place &place)
{
  if (place.arm < 0 || graph.arms[place.arm].nodes[0] < 0)
    return infinity;
  const auto &arm = graph.arms[place.arm];
  return std::min(paths.distance[arm.nodes[0]] + place.s, paths.distance[arm.nodes[1]] + arm.length - place.s);
}

/// The point half way from @p start to @p end.
Eigen::Vector3d middle_of_path(const CrackGraph &graph, const ShortestPaths &paths, int start, int end)
{
  const double half = 0.5 * paths.distance[end];
  int          node = end;
  while (node != start)
    {
      const auto &arm      = graph.arms[paths.arm[node]];
      const int   previous = arm.nodes[0] == node ? arm.nodes[1] : arm.nodes[0];
      if (paths.distance[previous] <= half)
        {
          double s = arm.nodes[0] == previous ? half - paths.distance[previous] : paths.distance[node] - half;
          for (std::size_t k = 1; k < arm.points.size(); ++k)
            {
              const double length = (arm.points[k] - arm.points[k - 1]).norm();
              if (s <= length && length > 0.)
                return arm.points[k - 1] + s / length * (arm.points[k] - arm.points[k - 1]);
              s -= length;
            }
          return arm.points.back();
        }
      node = previous;
    }
  return graph.nodes[start].point.X;
}

} // namespace

void validate(const CrackOptions &options)
{
  const std::pair<const char *, double> lengths[] = {{"length_scale", options.length_scale},
                                                     {"rayleigh_speed", options.rayleigh_speed},
                                                     {"target_size", options.target_size}};
  for (const auto &[name, value] : lengths)
    if (!(value > 0.) || !std::isfinite(value))
      throw InvalidParameter(std::string("crack tracker: ") + name + " = " + std::to_string(value) +
                             ", expected a finite value > 0");
  if (!(options.threshold > 0. && options.threshold < 1.))
    throw InvalidParameter("crack tracker: threshold = " + std::to_string(options.threshold) +
                           ", expected a phase value in (0, 1); 0.1 is usual");
}

CrackTree::CrackTree(const CrackOptions &options, State state) : options_(options), state_(std::move(state))
{
  validate(options);
}

int CrackTree::n_active() const
{
  return static_cast<int>(
      std::count_if(state_.tips.begin(), state_.tips.end(), [](const auto &tip) { return tip.active; }));
}

std::optional<CrackTip> CrackTree::fastest() const
{
  const CrackTip *best = nullptr;
  for (const auto &tip : state_.tips)
    if (tip.active && (!best || tip.speed > best->speed))
      best = &tip;
  return best ? std::optional(*best) : std::nullopt;
}

void CrackTree::advance(const CrackGraph &graph, const std::vector<int> &ends, double time)
{
  std::vector<int> tip_of(graph.nodes.size(), -1);
  match(graph, ends, time, tip_of);
  const auto matched = tip_of;
  for (const int end : ends)
    if (tip_of[end] < 0)
      {
        add(graph, ends, end, matched);
        tip_of[end] = state_.tips.back().id;
        if (const auto &tip = state_.tips.back(); tip.parent >= 0)
          {
            const auto &arm = graph.arms[arm_of_end(graph, end)];
            state_.branchings.push_back(
                {time, graph.nodes[arm.nodes[0] == end ? arm.nodes[1] : arm.nodes[0]].point.X, tip.parent, tip.id});
          }
      }
  for (const int end : ends)
    {
      auto &tip = state_.tips[tip_of[end]];
      tip.X     = graph.nodes[end].point.X;
      // Without a way to its anchor (a crack that has healed in between) a tip keeps its length.
      if (const double d = distance_to(graph, shortest_paths(graph, end), closest_place(graph, tip.anchor));
          std::isfinite(d))
        tip.length = d;
      update_speed(tip, time);
    }
  state_.time = time;
}

void CrackTree::match(const CrackGraph &graph, const std::vector<int> &ends, double time, std::vector<int> &tip_of)
{
  const double limit = 8. * options_.length_scale + options_.rayleigh_speed * (state_.time ? time - *state_.time : 0.);
  std::vector<std::tuple<double, int, int>> pairs;
  for (const auto &tip : state_.tips)
    if (tip.active)
      for (const int end : ends)
        if (const double d = (graph.nodes[end].point.X - tip.X).norm(); d <= limit)
          pairs.emplace_back(d, tip.id, end);
  std::sort(pairs.begin(), pairs.end());
  std::vector<char> found(state_.tips.size(), false);
  for (const auto &[distance, id, end] : pairs)
    if (!found[id] && tip_of[end] < 0)
      {
        found[id]   = true;
        tip_of[end] = id;
      }
  for (auto &tip : state_.tips)
    tip.active = found[tip.id];
}

void CrackTree::add(const CrackGraph &graph, const std::vector<int> &ends, int end, const std::vector<int> &tip_of)
{
  CrackTip tip{
      static_cast<int>(state_.tips.size()), -1, true, graph.nodes[end].point.X, graph.nodes[end].point.X, 0., 0., {}};
  const auto paths = shortest_paths(graph, end);
  const auto nodes = static_cast<int>(graph.nodes.size());
  int        next = -1, edge_end = -1, farthest = -1;
  for (int n = 0; n < nodes; ++n)
    if (n != end && std::isfinite(paths.distance[n]))
      {
        if (tip_of[n] >= 0 && (next < 0 || paths.distance[n] < paths.distance[next]))
          next = n;
        if (farthest < 0 || paths.distance[n] > paths.distance[farthest])
          farthest = n;
      }
  const auto &arm  = graph.arms[arm_of_end(graph, end)];
  const int   foot = arm.nodes[0] == end ? arm.nodes[1] : arm.nodes[0];
  if (next >= 0 && graph.nodes[foot].degree > 2)
    {
      tip.parent = tip_of[next];
      tip.anchor = state_.tips[tip.parent].anchor;
    }
  else
    {
      for (int n = 0; n < nodes; ++n)
        if (graph.nodes[n].degree == 1 && std::isfinite(paths.distance[n]) &&
            std::find(ends.begin(), ends.end(), n) == ends.end() &&
            (edge_end < 0 || paths.distance[n] < paths.distance[edge_end]))
          edge_end = n;
      if (edge_end >= 0)
        tip.anchor = graph.nodes[edge_end].point.X;
      else if (farthest >= 0)
        tip.anchor = middle_of_path(graph, paths, end, farthest);
    }
  state_.tips.push_back(std::move(tip));
}

void CrackTree::update_speed(CrackTip &tip, double time) const
{
  constexpr std::size_t n_steps = 5;
  const double          window  = 2. * options_.length_scale / (0.6 * options_.rayleigh_speed);
  tip.recent.push_back({time, tip.length});
  while (tip.recent.size() > n_steps + 1 && tip.recent[1].time <= time - window)
    tip.recent.erase(tip.recent.begin());

  // A new arm shows up at once with its whole length; its first steps say nothing of its speed.
  if (tip.recent.size() <= n_steps)
    {
      tip.speed = 0.;
      return;
    }
  double mean_time = 0., mean_length = 0.;
  for (const auto &r : tip.recent)
    {
      mean_time += r.time / tip.recent.size();
      mean_length += r.length / tip.recent.size();
    }
  double covariance = 0., variance = 0.;
  for (const auto &r : tip.recent)
    {
      covariance += (r.time - mean_time) * (r.length - mean_length);
      variance += (r.time - mean_time) * (r.time - mean_time);
    }
  tip.speed = covariance / variance;
}

} // namespace sherd
