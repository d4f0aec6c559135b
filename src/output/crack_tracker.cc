#include <sherd/output/crack_tracker.h>

namespace sherd
{

std::vector<Eigen::Vector3d> CrackTracker::branch_points() const
{
  std::vector<Eigen::Vector3d> result;
  for (const auto &branching : tree_.branchings())
    result.push_back(branching.X);
  return result;
}

std::vector<int> CrackTracker::ends_inside() const
{
  const double     margin = 2. * options_.length_scale;
  std::vector<int> result;
  for (std::size_t n = 0; n < cracks_.nodes.size(); ++n)
    if (cracks_.nodes[n].degree == 1 && std::none_of(body_edge_.begin(), body_edge_.end(), [&](const auto &X) {
          return (X - cracks_.nodes[n].point.X).norm() <= margin;
        }))
      result.push_back(static_cast<int>(n));
  return result;
}

} // namespace sherd
