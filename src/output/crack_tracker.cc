#include <sherd/output/crack_tracker.h>

#include <sherd/base/instantiate.h>
#include <sherd/output/crack_tracker.templates.h>

namespace sherd
{

namespace
{

bool is_near(const Eigen::Vector3d &X, const std::vector<Eigen::Vector3d> &points, double distance)
{
  return std::any_of(points.begin(), points.end(), [&](const auto &Y) { return (X - Y).norm() <= distance; });
}

} // namespace

std::vector<Eigen::Vector3d> CrackTracker::branch_points() const
{
  std::vector<Eigen::Vector3d> result;
  for (const auto &branching : tree_.branchings())
    result.push_back(branching.X);
  return result;
}

std::vector<int> CrackTracker::ends_inside() const
{
  std::vector<int> result;
  for (std::size_t n = 0; n < cracks_.nodes.size(); ++n)
    if (cracks_.nodes[n].degree == 1 && !is_near(cracks_.nodes[n].point.X, body_edge_, 2. * options_.length_scale))
      result.push_back(static_cast<int>(n));
  return result;
}

void CrackTracker::join(PatchedCracks cracks, const std::vector<char> &self_joined, const std::vector<BrokenRun> &runs,
                        const Pruning &pruning)
{
  const double l0 = options_.length_scale;
  merge_bands(cracks, runs, l0, pruning);
  cracks_            = std::move(cracks.graph);
  const auto &broken = pruning.cut_points;
  if (broken.empty())
    return;
  const auto          crossings = connected_parts({broken.begin(), broken.end()}, .5 * l0);
  std::vector<CutEnd> ends;
  for (const auto &arm : cracks_.arms)
    for (const int node : arm.nodes)
      if (node >= 0 && cracks_.nodes[node].degree == 1)
        {
          const auto &X        = cracks_.nodes[node].point.X;
          double      distance = l0;
          int         crossing = -1;
          for (std::size_t k = 0; k < broken.size(); ++k)
            if (const double d = (X - broken[k]).norm(); d < distance)
              {
                distance = d;
                crossing = crossings[k];
              }
          if (crossing >= 0)
            ends.push_back({node, cracks.patch_of_node[node], crossing});
        }
  join_cracks(cracks_, cracks.patch_of_arm, ends, self_joined, {4. * l0, 2. * l0}, pruning);
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template CrackTracker::CrackTracker(const Surface<degree, spacedim> &, const CrackOptions &);                        \
  template void CrackTracker::update(const Surface<degree, spacedim> &, const Eigen::VectorXd &, double);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
