#pragma once

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <sherd/geometry/shapes.h>
#include <sherd/spline/evaluation.h>

/// Surfaces that tests of several rooms share.
namespace sherd::test
{

/// Uniform number in [-1, 1) that does not depend on the standard library.
inline double symmetric(std::mt19937 &random)
{
  return random() / 2147483648. - 1.;
}

/// The same plate with the control points that act on no edge moved by up to @p amount in each direction: curved inner
/// parameter lines, straight outer edges.
template <int degree, int spacedim>
Surface<degree, spacedim> distorted(const Surface<degree, spacedim> &plate, double amount, unsigned seed = 7)
{
  auto              patch = plate.patch(0);
  std::vector<char> outer(plate.n_control_points(), 0);
  for (const auto &[name, sides] : plate.edges())
    for (const auto &side : sides)
      for (const int i : points_along(plate, side))
        outer[i] = 1;
  std::mt19937 random(seed);
  for (int i = 0; i < plate.n_control_points(); ++i)
    for (int d = 0; d < spacedim; ++d)
      {
        const double shift = amount * symmetric(random);
        if (!outer[i])
          patch.control_points(i, d) += shift;
      }
  return {{std::move(patch)}, plate.edges()};
}

/// Refines around @p per_level random functions, @p levels times, halving parameter spans of 1. Scattered marks make
/// hanging lines and elements of many functions.
template <int degree, int spacedim>
void refine_at_random(Surface<degree, spacedim> &surface, int levels, int per_level, unsigned seed)
{
  std::mt19937 random(seed);
  for (int level = 0; level < levels; ++level)
    {
      std::vector<int> marked;
      for (int k = 0; k < per_level; ++k)
        marked.push_back(static_cast<int>(random() % surface.n_control_points()));
      const double length = std::ldexp(.5, -level);
      surface.refine(marked, {{length, length}});
    }
}

/// Halves all elements, down to the length 2^-level of parameter spans of 1.
template <int degree, int spacedim>
SurfaceRefinement refine_everywhere(Surface<degree, spacedim> &surface, int level)
{
  std::vector<int> all(surface.n_control_points());
  std::iota(all.begin(), all.end(), 0);
  const double length = std::ldexp(1., -level);
  return surface.refine(all, {{length, length}});
}

/// Element with the most functions.
template <int degree, int spacedim>
int most_loaded_element(const Surface<degree, spacedim> &surface)
{
  const auto &basis = surface.patch(0).basis;
  int         best  = 0;
  for (int e = 1; e < basis.n_elements(); ++e)
    if (basis.functions_of(e).size() > basis.functions_of(best).size())
      best = e;
  return best;
}

/// Bernstein coefficients of a curve in the next higher degree.
template <class Coefficient>
std::vector<Coefficient> elevate(const std::vector<Coefficient> &c)
{
  const int                n = static_cast<int>(c.size());
  std::vector<Coefficient> result{c.front()};
  for (int i = 1; i < n; ++i)
    result.push_back(c[i - 1] * (double(i) / n) + c[i] * (double(n - i) / n));
  result.push_back(c.back());
  return result;
}

/// Part of a circular arc of a quarter turn about the z axis, exact, swept along a straight line: u in [0, 1] goes from
/// the point (start_r, start_z) of the (r, z) plane to (end_r, end_z), v in [0, 1] along the arc from the x axis to the
/// y axis. Edges "inner" and "outer" (u = 0, 1), "start" and "end" (v = 0, 1).
template <int degree, int spacedim>
Surface<degree, spacedim> quarter_turn(double start_r, double start_z, double end_r, double end_z)
{
  const double                 w = std::sqrt(.5);
  std::vector<Eigen::Vector3d> arc{{1., 0., 1.}, {w, w, w}, {0., 1., 1.}}; // (w x, w y, w)
  std::vector<Eigen::Vector2d> line{{start_r, start_z}, {end_r, end_z}};
  while (static_cast<int>(arc.size()) <= degree)
    arc = elevate(arc);
  while (static_cast<int>(line.size()) <= degree)
    line = elevate(line);
  Patch<degree, spacedim> patch{LRBasis<degree>(shapes::uniform_knots<degree>(1), shapes::uniform_knots<degree>(1)),
                                ControlValues<spacedim>((degree + 1) * (degree + 1), spacedim),
                                Eigen::VectorXd((degree + 1) * (degree + 1))};
  for (int j = 0, k = 0; j <= degree; ++j)
    for (int i = 0; i <= degree; ++i, ++k)
      {
        const Eigen::Vector3d X(line[i][0] * arc[j][0] / arc[j][2], line[i][0] * arc[j][1] / arc[j][2], line[i][1]);
        patch.control_points.row(k) = X.template head<spacedim>().transpose();
        patch.weights[k]            = arc[j][2];
      }
  return {{std::move(patch)},
          {{"inner", {{0, Side::u_min}}},
           {"outer", {{0, Side::u_max}}},
           {"start", {{0, Side::v_min}}},
           {"end", {{0, Side::v_max}}}}};
}

/// Quarter of a flat annulus.
template <int degree, int spacedim>
Surface<degree, spacedim> quarter_annulus(double inner_radius, double outer_radius)
{
  return quarter_turn<degree, spacedim>(inner_radius, 0., outer_radius, 0.);
}

/// X at the parameters (u, v) of a patch, by the recurrence of Cox and de Boor.
template <int degree, int spacedim>
Point<spacedim> position_at(const Patch<degree, spacedim> &patch, double u, double v)
{
  const int       element   = patch.basis.element_at(u, v);
  const auto      functions = patch.basis.functions_of(element);
  const auto      values    = evaluate(patch.basis, element, u, v);
  Point<spacedim> X         = Point<spacedim>::Zero();
  double          W         = 0.;
  for (std::size_t k = 0; k < functions.size(); ++k)
    {
      const double value = patch.weights[functions[k]] * values[k].value;
      X += value * patch.control_points.row(functions[k]).transpose();
      W += value;
    }
  return X / W;
}

} // namespace sherd::test
