#pragma once

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/interpolate.h>

/// Surfaces of several patches that tests of several rooms share.
namespace sherd::test
{

/// Open knot vector of n equal spans on [start, end].
template <int degree>
std::vector<double> equal_knots(int n, double start, double end)
{
  std::vector<double> knots(degree, start);
  for (int i = 0; i <= n; ++i)
    knots.push_back(i == n ? end : start + i * (end - start) / n);
  knots.insert(knots.end(), degree, end);
  return knots;
}

/// One of the eight ways to run over the same patch: bit 0 turns the first direction around, bit 1 the second, bit 2
/// swaps them. The patch must not have been refined.
template <int degree, int spacedim>
Patch<degree, spacedim> reoriented(const Patch<degree, spacedim> &patch, int way)
{
  auto      knots = patch.basis.initial_knots();
  const int n_u = static_cast<int>(knots[0].size()) - degree - 1, n_v = static_cast<int>(knots[1].size()) - degree - 1;
  for (int d = 0; d < 2; ++d)
    if (way >> d & 1)
      {
        const double sum = knots[d].front() + knots[d].back();
        std::reverse(knots[d].begin(), knots[d].end());
        for (double &knot : knots[d])
          knot = sum - knot;
      }
  const bool              swapped = way >> 2 & 1;
  Patch<degree, spacedim> result{LRBasis<degree>(knots[swapped ? 1 : 0], knots[swapped ? 0 : 1]), patch.control_points,
                                 patch.weights};
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i)
      {
        const int a = way & 1 ? n_u - 1 - i : i, b = way >> 1 & 1 ? n_v - 1 - j : j;
        const int to                  = swapped ? a * n_v + b : b * n_u + a;
        result.control_points.row(to) = patch.control_points.row(j * n_u + i);
        result.weights[to]            = patch.weights[j * n_u + i];
      }
  return result;
}

/// Bilinear patch between four corners, in the order (u, v) = (0, 0), (1, 0), (0, 1), (1, 1) of the ends of its knots.
template <int degree, int spacedim>
Patch<degree, spacedim> bilinear(const std::array<Point<spacedim>, 4> &corner, const std::vector<double> &knots_u,
                                 const std::vector<double> &knots_v)
{
  const auto place = [](const std::vector<double> &knots, double x) {
    return (x - knots.front()) / (knots.back() - knots.front());
  };
  const auto map = [&](double u, double v) -> Point<spacedim> {
    const double s = place(knots_u, u), t = place(knots_v, v);
    return (1. - t) * ((1. - s) * corner[0] + s * corner[1]) + t * ((1. - s) * corner[2] + s * corner[3]);
  };
  return interpolate<degree, spacedim>(knots_u, knots_v, map).patch(0);
}

/// @p n flat patches around one common corner, n x n elements each, with parameters that run in random ways over random
/// ranges. Two patches share a side, three and more go all the way around.
template <int degree, int spacedim>
std::vector<Patch<degree, spacedim>> star(int n, int n_elements, std::mt19937 &random)
{
  const auto at = [](double angle, double radius) {
    Point<spacedim> X = Point<spacedim>::Zero();
    X[0]              = radius * std::cos(angle);
    X[1]              = radius * std::sin(angle);
    return X;
  };
  const double                         turn = 2. * M_PI / std::max(n, 4);
  std::vector<Patch<degree, spacedim>> patches;
  for (int p = 0; p < n; ++p)
    {
      const auto knots = [&] {
        const double start = symmetric(random), length = 2. + symmetric(random);
        return equal_knots<degree>(n_elements, start, start + length);
      };
      const double angle  = n == 3 ? 2. * M_PI / 3. * p : turn * p;
      const double across = n == 3 ? 2. * M_PI / 3. : turn;
      const auto   u = knots(), v = knots();
      const auto   patch = bilinear<degree, spacedim>(
          {at(0., 0.), at(angle, 1.), at(angle + across, 1.), at(angle + .5 * across, 1.5)}, u, v);
      patches.push_back(reoriented(patch, static_cast<int>(random() % 8)));
    }
  return patches;
}

/// Six patches around the origin, the faces of a cube blown up: rational, about a sphere.
template <int degree>
std::vector<Patch<degree, 3>> ball(int n_elements, std::mt19937 &random)
{
  std::vector<Patch<degree, 3>> patches;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1., 1.})
      {
        const double start = symmetric(random);
        const auto   map   = [&](double u, double v) -> Eigen::Vector4d {
          Eigen::Vector3d X;
          X[axis]           = sign;
          X[(axis + 1) % 3] = 2. * (u - start) - 1.;
          X[(axis + 2) % 3] = 2. * (v - start) - 1.;
          const double    w = 1. + .2 * X.squaredNorm();
          Eigen::Vector4d result;
          result << w * X.normalized(), w;
          return result;
        };
        const auto knots = equal_knots<degree>(n_elements, start, start + 1.);
        patches.push_back(
            reoriented(interpolate<degree, 3>(knots, knots, map).patch(0), static_cast<int>(random() % 8)));
      }
  return patches;
}

/// One patch whose sides u_min and u_max are joined to each other: a ring, or with a half turn a Moebius strip; a torus
/// if v_min and v_max are joined too.
enum class Closed
{
  ring,
  moebius,
  torus
};
template <int degree>
Patch<degree, 3> closed_patch(Closed kind, int n_u, int n_v)
{
  const auto map = [&](double u, double v) -> Eigen::Vector3d {
    const double around = 2. * M_PI * u, tube = 2. * M_PI * v;
    const double twist = kind == Closed::moebius ? .5 * around : 0.;
    const double r     = kind == Closed::torus ? 2. + std::cos(tube) : 2. + (v - .5) * std::cos(twist);
    const double z     = kind == Closed::torus ? std::sin(tube) : kind == Closed::ring ? v : (v - .5) * std::sin(twist);
    return {r * std::cos(around), r * std::sin(around), z};
  };
  return interpolate<degree, 3>(equal_knots<degree>(n_u, 0., 1.), equal_knots<degree>(n_v, 0., 1.), map).patch(0);
}

/// Sides of patches all of whose control points are where a condition holds.
template <int degree, int spacedim, class Where>
std::vector<Edge> sides_where(const std::vector<Patch<degree, spacedim>> &patches, const Where &where)
{
  std::vector<Edge> sides;
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    for (const Side side : {Side::u_min, Side::u_max, Side::v_min, Side::v_max})
      {
        const auto on_side = internal::side_functions(patches[p].basis, side, false);
        if (std::all_of(on_side.begin(), on_side.end(), [&](const auto &f) {
              return where(Point<spacedim>(patches[p].control_points.row(f.index).transpose()));
            }))
          sides.push_back({p, side});
      }
  return sides;
}

/// Target of each patch: its initial spans, halved @p level times.
template <int degree, int spacedim>
std::vector<SpanTarget> halved(const Surface<degree, spacedim> &surface, int level)
{
  std::vector<SpanTarget> targets;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      SpanTarget target{};
      for (int d = 0; d < 2; ++d)
        {
          const auto &knots = surface.patch(p).basis.initial_knots()[d];
          target.length[d]  = std::ldexp(knots[degree + 1] - knots[degree], -level) * (1. + 1e-9);
        }
      targets.push_back(target);
    }
  return targets;
}

/// Value at (u, v) of patch p of a field with one value a control point.
template <int degree, int spacedim>
double field_at(const Surface<degree, spacedim> &surface, int p, const Eigen::VectorXd &values, double u, double v)
{
  const auto       points = surface.points_of_patch(p);
  Patch<degree, 1> patch{surface.patch(p).basis, Eigen::VectorXd(points.size()), surface.patch(p).weights};
  for (std::size_t i = 0; i < points.size(); ++i)
    patch.control_points[i] = values[points[i]];
  return position_at(patch, u, v)[0];
}

} // namespace sherd::test
