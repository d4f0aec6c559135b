#pragma once

#include <numeric>

#include <Eigen/Geometry>

#include <geometry/area.h>
#include <geometry/sample_surfaces.h>
#include <sherd/geometry/element_geometry.h>

/// What tests of surfaces of many patches look at.
namespace sherd::test
{

/// Unit normal A_1 x A_2 / |A_1 x A_2| at the parameters (u, v) of a patch.
template <int degree>
Eigen::Vector3d normal_at(const Patch<degree, 3> &patch, double u, double v)
{
  const int       element   = patch.basis.element_at(u, v);
  const auto      functions = patch.basis.functions_of(element);
  const auto      values    = evaluate(patch.basis, element, u, v);
  Eigen::Vector4d H = Eigen::Vector4d::Zero(), H_u = H, H_v = H; // (w X, w) and its derivatives
  for (std::size_t k = 0; k < functions.size(); ++k)
    {
      const Eigen::Vector3d X = patch.control_points.row(functions[k]);
      const Eigen::Vector4d c = patch.weights[functions[k]] * X.homogeneous();
      H += values[k].value * c;
      H_u += values[k].first[0] * c;
      H_v += values[k].first[1] * c;
    }
  const Eigen::Vector3d X   = H.hnormalized();
  const Eigen::Vector3d A_1 = (H_u.head<3>() - H_u[3] * X) / H[3], A_2 = (H_v.head<3>() - H_v[3] * X) / H[3];
  return A_1.cross(A_2).normalized();
}

/// Parameters of the point at the share @p s in [0, 1] of a side.
template <int degree, int spacedim>
std::array<double, 2> on_side(const Patch<degree, spacedim> &patch, Side side, double s)
{
  const auto &domain = patch.basis.domain();
  const auto  size   = domain.size();
  switch (side)
    {
    case Side::u_min:
      return {domain.min[0], domain.min[1] + s * size[1]};
    case Side::u_max:
      return {domain.max[0], domain.min[1] + s * size[1]};
    case Side::v_min:
      return {domain.min[0] + s * size[0], domain.min[1]};
    default:
      return {domain.min[0] + s * size[0], domain.max[1]};
    }
}

/// Calls f(patch, place, patch, place) of both sides at 41 points of each interface.
template <int degree, int spacedim, class Function>
void along_interfaces(const Surface<degree, spacedim> &surface, const Function &f)
{
  for (const auto &joined : surface.interfaces())
    for (int k = 0; k <= 40; ++k)
      {
        const auto  &a = surface.patch(joined.first.patch), &b = surface.patch(joined.second.patch);
        const double s = k / 40.;
        f(a, on_side(a, joined.first.side, s), b, on_side(b, joined.second.side, joined.reversed ? 1. - s : s));
      }
}

/// Largest distance between both sides of an interface.
template <int degree, int spacedim>
double largest_gap(const Surface<degree, spacedim> &surface)
{
  double gap = 0.;
  along_interfaces(surface, [&](const auto &a, const auto &at, const auto &b, const auto &bt) {
    gap = std::max(gap, (position_at(a, at[0], at[1]) - position_at(b, bt[0], bt[1])).norm());
  });
  return gap;
}

/// Smallest and largest angle [rad] between the normals on both sides of all interfaces.
template <int degree>
std::array<double, 2> kinks(const Surface<degree, 3> &surface)
{
  std::array<double, 2> range{M_PI, 0.};
  along_interfaces(surface, [&](const auto &a, const auto &at, const auto &b, const auto &bt) {
    const auto   n = normal_at(a, at[0], at[1]), m = normal_at(b, bt[0], bt[1]);
    const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
    range              = {std::min(range[0], angle), std::max(range[1], angle)};
  });
  return range;
}

/// Sides of all patches that are part of no interface.
template <int degree, int spacedim>
int n_free_sides(const Surface<degree, spacedim> &surface)
{
  return 4 * surface.n_patches() - 2 * static_cast<int>(surface.interfaces().size());
}

/// Whether both surfaces have the same knots, points, weights, edges and interfaces, bit by bit.
template <int degree, int spacedim>
bool identical(const Surface<degree, spacedim> &a, const Surface<degree, spacedim> &b)
{
  const auto same_edge = [](const Edge &x, const Edge &y) { return x.patch == y.patch && x.side == y.side; };
  if (a.n_patches() != b.n_patches() || a.interfaces().size() != b.interfaces().size() ||
      a.edges().size() != b.edges().size())
    return false;
  for (int p = 0; p < a.n_patches(); ++p)
    if (a.patch(p).basis.initial_knots() != b.patch(p).basis.initial_knots() ||
        a.patch(p).control_points != b.patch(p).control_points || a.patch(p).weights != b.patch(p).weights)
      return false;
  for (std::size_t i = 0; i < a.interfaces().size(); ++i)
    {
      const auto &x = a.interfaces()[i], &y = b.interfaces()[i];
      if (!same_edge(x.first, y.first) || !same_edge(x.second, y.second) || x.reversed != y.reversed)
        return false;
    }
  return std::equal(a.edges().begin(), a.edges().end(), b.edges().begin(), [&](const auto &x, const auto &y) {
    return x.first == y.first &&
           std::equal(x.second.begin(), x.second.end(), y.second.begin(), y.second.end(), same_edge);
  });
}

} // namespace sherd::test
