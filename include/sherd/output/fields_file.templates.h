#pragma once

#include <sherd/output/fields_file.h>

namespace sherd
{

/// The arrays of one patch.
template <int degree, int spacedim>
PatchArrays patch_arrays(const Surface<degree, spacedim> &surface, int p)
{
  const auto &patch  = surface.patch(p);
  const auto  points = surface.points_of_patch(p);
  PatchArrays arrays;
  arrays.points.assign(points.begin(), points.end());
  for (int i = 0; i < patch.basis.n_functions(); ++i)
    {
      const auto &function = patch.basis.function(i);
      for (const auto &knots : function.knots)
        arrays.knots.insert(arrays.knots.end(), knots.begin(), knots.end());
      arrays.gamma.push_back(function.gamma);
      arrays.weights.push_back(patch.weights[i]);
      for (int d = 0; d < spacedim; ++d)
        arrays.control_points.push_back(patch.control_points(i, d));
    }
  for (int e = 0; e < patch.basis.n_elements(); ++e)
    {
      const auto &box = patch.basis.element(e);
      arrays.elements.insert(arrays.elements.end(), {box.min[0], box.min[1], box.max[0], box.max[1]});
    }
  return arrays;
}

template <int degree, int spacedim>
void FieldsFile::write(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot)
{
  check(degree, spacedim, surface.n_control_points(), snapshot.position.size(), snapshot.velocity.size(),
        snapshot.phase.size());
  std::vector<PatchArrays> patches;
  for (int p = 0; p < surface.n_patches(); ++p)
    patches.push_back(patch_arrays(surface, p));
  const auto values = [](const auto &matrix) {
    return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
  };
  append(patches, snapshot.time, values(snapshot.position), values(snapshot.velocity), values(snapshot.phase));
}

} // namespace sherd
