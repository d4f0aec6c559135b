#include <sherd/geometry/tensor_product.h>

#include <sherd/base/instantiate.h>

#include <algorithm>
#include <map>

namespace sherd
{
namespace
{

/// Knots of the lines of one direction, ascending; nothing if one of them ends inside the domain.
std::optional<std::vector<double>> full_knots(const std::vector<MeshLine> &lines, const Box &domain,
                                              Direction direction, int boundary_multiplicity)
{
  const int             d = static_cast<int>(direction), other = 1 - d;
  std::map<double, int> multiplicity{{domain.min[d], boundary_multiplicity}, {domain.max[d], boundary_multiplicity}};
  std::optional<std::vector<double>> knots(std::in_place);
  for (const auto &line : lines)
    {
      if (line.direction != direction || line.value == domain.min[d] || line.value == domain.max[d])
        continue;
      if (line.start != domain.min[other] || line.end != domain.max[other])
        return std::nullopt;
      auto &m = multiplicity[line.value];
      m       = std::max(m, line.multiplicity);
    }
  for (const auto &[value, m] : multiplicity)
    knots->insert(knots->end(), m, value);
  return knots;
}

/// Number of each univariate function of open knots by its local knots.
template <int degree>
std::map<LocalKnots<degree>, int> function_numbers(const std::vector<double> &knots)
{
  std::map<LocalKnots<degree>, int> numbers;
  for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i)
    {
      LocalKnots<degree> local;
      std::copy_n(knots.begin() + i, degree + 2, local.begin());
      numbers[local] = static_cast<int>(i);
    }
  return numbers;
}

} // namespace

template <int degree, int spacedim>
std::optional<Patch<degree, spacedim>> tensor_product(const Patch<degree, spacedim> &patch)
{
  const auto &basis = patch.basis;
  const auto &lines = basis.mesh_lines();
  const auto  u     = full_knots(lines, basis.domain(), Direction::u, degree + 1);
  const auto  v     = full_knots(lines, basis.domain(), Direction::v, degree + 1);
  if (!u || !v)
    return std::nullopt;
  const auto number_u = function_numbers<degree>(*u), number_v = function_numbers<degree>(*v);
  const int  n = static_cast<int>(number_u.size() * number_v.size());
  if (basis.n_functions() != n)
    return std::nullopt;
  Patch<degree, spacedim> result{LRBasis<degree>(*u, *v), ControlValues<spacedim>(n, spacedim), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i)
    {
      const auto &knots = basis.function(i).knots;
      const auto  k_u = number_u.find(knots[0]), k_v = number_v.find(knots[1]);
      if (k_u == number_u.end() || k_v == number_v.end())
        return std::nullopt;
      const int k                  = k_v->second * static_cast<int>(number_u.size()) + k_u->second;
      result.control_points.row(k) = patch.control_points.row(i);
      result.weights[k]            = patch.weights[i];
    }
  return result;
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template std::optional<Patch<degree, spacedim>> tensor_product(const Patch<degree, spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
