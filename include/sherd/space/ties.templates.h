#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <sherd/base/print.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/space/first_row.h>
#include <sherd/space/ties.h>

namespace sherd
{

template <int degree, int spacedim>
std::vector<Tie> level_ties(const Surface<degree, spacedim> &surface, const Edge &edge, int field)
{
  using Key          = typename internal::FirstRow<degree>::Key;
  const auto &patch  = surface.patch(edge.patch);
  const int   normal = internal::normal_direction(edge.side);
  // The knot that ends the first span of a function with m knots on the side.
  const auto span_end = [&](int function, int m) {
    return patch.basis.function(function).knots[normal][internal::at_maximum(edge.side) ? degree + 1 - m : m];
  };
  const auto along  = [&](int function) { return patch.basis.function(function).knots[1 - normal]; };
  const auto weight = [&](int function) { return patch.weights[function] * patch.basis.function(function).gamma; };

  const internal::FirstRow<degree> row(patch.basis, edge.side);
  const auto                       slaves = internal::functions_of_multiplicity(patch.basis, edge.side, degree + 1);
  std::map<Key, std::size_t>       slave_of;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    slave_of[{row.depth(span_end(slaves[i], degree + 1)), along(slaves[i])}] = i;

  std::vector<std::map<int, double>> slopes(slaves.size()); // of the masters' parts, w_j gamma_j beta_ij / a_j
  for (const int master : internal::functions_of_multiplicity(patch.basis, edge.side, degree))
    {
      const double a = row.depth(span_end(master, degree));
      for (const auto &[key, beta] : row.split({a, along(master)}))
        {
          const auto slave = slave_of.find(key);
          if (slave == slave_of.end())
            throw Error("ties: on a side of patch " + std::to_string(edge.patch) + " the second row at control point " +
                        std::to_string(surface.point(edge.patch, master)) +
                        " is no sum of first-row functions; refine the edge evenly");
          slopes[slave->second][master] += weight(master) * beta / a;
        }
    }

  std::vector<Tie> result;
  double           least = std::numeric_limits<double>::infinity(), greatest = -least, scale = 0.;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    {
      double sum = 0.;
      for (const auto &[master, slope] : slopes[i])
        sum += slope;
      const double own   = 1. / row.depth(span_end(slaves[i], degree + 1));
      const double kappa = sum / weight(slaves[i]) - own;
      least              = std::min(least, kappa);
      greatest           = std::max(greatest, kappa);
      scale              = std::max(scale, own);
      std::map<int, double> factors; // by control points, ascending
      for (const auto &[master, slope] : slopes[i])
        factors[surface.point(edge.patch, master)] += slope / sum;
      Tie tie{surface.point(edge.patch, slaves[i]), field, {}, {}};
      for (const auto &[master, factor] : factors)
        {
          tie.masters.push_back(master);
          tie.factors.push_back(factor);
        }
      result.push_back(std::move(tie));
    }
  if (greatest - least > 1e-10 * scale)
    throw Error("ties: on a side of patch " + std::to_string(edge.patch) +
                " the derivative across it cannot vanish everywhere: the slope of the rational denominator over itself "
                "runs from " +
                print(degree * least) + " to " + print(degree * greatest) +
                ", expected a constant; choose weights that are a product of one factor along and one across the edge, "
                "or impose the symmetry weakly");
  return result;
}

namespace internal
{

/// Sine of the angle by which parameter lines may miss the right angle at a symmetric edge: an approximated geometry
/// does, by its error.
inline constexpr double oblique = .05;

/// Throws unless a symmetric edge is crossed at right angles, by the parameter lines and by its plane of symmetry.
template <int degree, int spacedim>
void check_crossing(const Supports::Symmetry &symmetry, const Surface<degree, spacedim> &surface, const Edge &edge)
{
  for (const auto &piece : edge_geometry(surface, edge))
    for (const auto &q : piece.quadrature)
      {
        const Point<spacedim> across = (normal_direction(edge.side) == 0 ? q.A1 : q.A2).normalized();
        const Point<spacedim> along  = (normal_direction(edge.side) == 0 ? q.A2 : q.A1).normalized();
        double                sine   = std::abs(across.dot(along));
        if (symmetry.normal)
          {
            Point<spacedim> normal                     = Point<spacedim>::Zero();
            normal[static_cast<int>(*symmetry.normal)] = 1.;
            sine = std::max((across - across.dot(normal) * normal).norm(), std::abs(along.dot(normal)));
          }
        if (sine > oblique)
          throw InvalidParameter(
              "symmetry of edge \"" + symmetry.edge + "\": at (" + print(q.position[0]) + ", " + print(q.position[1]) +
              (spacedim == 3 ? ", " + print(q.position[spacedim - 1]) : "") +
              ") the parameter lines cross the edge, or the surface its plane of symmetry, " +
              print(std::round(std::asin(std::min(sine, 1.)) * 1800. / std::numbers::pi) / 10.) +
              " degrees off the right angle, expected at most 3; check the axis given as normal, or impose it weakly");
      }
}

} // namespace internal

template <int degree, int spacedim>
std::vector<Tie> ties(const Supports &supports, const Surface<degree, spacedim> &surface)
{
  constexpr int     n_fields = fields_per_point<spacedim>;
  std::vector<char> held(surface.n_control_points() * n_fields, 0);
  const auto        chosen = holders(supports, surface);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    held[i / spacedim * n_fields + i % spacedim] = chosen[i] >= 0;

  std::vector<Tie> all;
  for (const auto &symmetry : supports.symmetries())
    for (const auto &edge : surface.edge(symmetry.edge))
      {
        internal::check_crossing(symmetry, surface, edge);
        for (auto &tie : level_ties(surface, edge, spacedim))
          {
            for (int component = 0; component < spacedim; ++component)
              if (symmetry.normal && component != static_cast<int>(*symmetry.normal))
                {
                  all.push_back(tie);
                  all.back().field = component;
                }
            all.push_back(std::move(tie));
          }
      }

  auto result = resolve(all, held, n_fields);
  // On each patch of the slave the master has a function that covers its elements.
  const auto covers = [&](int master, int slave) {
    const auto inner = surface.locations_of(slave), outer = surface.locations_of(master);
    return std::all_of(inner.begin(), inner.end(), [&](const auto &i) {
      return std::any_of(outer.begin(), outer.end(), [&](const auto &o) {
        const auto &basis = surface.patch(i.patch).basis;
        return o.patch == i.patch && contains(basis.function(o.local).support(), basis.function(i.local).support());
      });
    });
  };
  for (const auto &tie : result)
    for (const int master : tie.masters)
      {
        if (!covers(master, tie.point))
          throw Error("ties: control point " + std::to_string(tie.point) + " follows control point " +
                      std::to_string(master) +
                      ", whose function does not cover the elements of the first; refine the edge evenly");
      }
  return result;
}

} // namespace sherd
