#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include <sherd/base/print.h>
#include <sherd/geometry/interface_closure.h>
#include <sherd/geometry/surface.h>
#include <sherd/spline/independence.h>

namespace sherd
{

namespace internal
{

/// Largest extent of the control points in any direction.
template <int degree, int spacedim>
double extent(const std::vector<Patch<degree, spacedim>> &patches)
{
  Point<spacedim> low = patches.front().control_points.row(0).transpose(), high = low;
  for (const auto &patch : patches)
    {
      low  = low.cwiseMin(patch.control_points.colwise().minCoeff().transpose());
      high = high.cwiseMax(patch.control_points.colwise().maxCoeff().transpose());
    }
  return (high - low).maxCoeff();
}

/// What keeps two sides from being one curve; empty if they are.
template <int degree, int spacedim>
std::string mismatch(const std::vector<Patch<degree, spacedim>> &patches, const Interface &interface, double size)
{
  constexpr double tolerance = 1e-10;
  const auto      &first = patches[interface.first.patch], &second = patches[interface.second.patch];
  const auto       initial = [](const auto &patch, Side side, bool reversed) {
    auto         knots = patch.basis.initial_knots()[1 - normal_direction(side)];
    const double low = knots.front(), high = knots.back();
    for (double &knot : knots)
      knot = reversed ? (high - knot) / (high - low) : (knot - low) / (high - low);
    if (reversed)
      std::reverse(knots.begin(), knots.end());
    return knots;
  };
  const auto knots_1 = initial(first, interface.first.side, false);
  const auto knots_2 = initial(second, interface.second.side, interface.reversed);
  if (!std::equal(knots_1.begin(), knots_1.end(), knots_2.begin(), knots_2.end(),
                  [&](double a, double b) { return std::abs(a - b) <= tolerance; }))
    return "their initial knots along it differ";
  const InterfaceFunctions<degree> functions(patches, interface);
  if (!functions.agree())
    return "their functions along it differ: one is refined where the other is not";
  for (std::size_t k = 0; k < functions.sides[0].size(); ++k)
    {
      const int    i = functions.sides[0][k].index, j = functions.sides[1][k].index;
      const double w = first.weights[i];
      if (std::abs(w - second.weights[j]) > tolerance * w)
        return "weights " + print(w) + " and " + print(second.weights[j]) + " of the same function differ";
      if (std::abs(first.basis.function(i).gamma - second.basis.function(j).gamma) > tolerance)
        return "the partition of unity gives the same function different weights";
      const Point<spacedim> X = first.control_points.row(i).transpose();
      if (const double gap = (X - second.control_points.row(j).transpose()).norm(); gap > tolerance * size)
        {
          std::string place;
          for (int d = 0; d < spacedim; ++d)
            place += (d == 0 ? "(" : ", ") + print(X[d]);
          return "at control point " + place + ") they are " + print(gap) + " apart";
        }
    }
  return {};
}

/// Sets of control points that are the same, by union-find; the representative is the smallest.
class SameNumbers
{
public:
  explicit SameNumbers(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int i)
  {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(int i, int j)
  {
    i                       = find(i);
    j                       = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

private:
  std::vector<int> parent_;
};

} // namespace internal

template <int degree, int spacedim>
Surface<degree, spacedim>::Surface(std::vector<PatchType> patches, std::map<std::string, std::vector<Edge>> edges,
                                   std::vector<Interface> interfaces)
    : patches_(std::move(patches)), edges_(std::move(edges)), interfaces_(std::move(interfaces))
{
  for (const auto &patch : patches_)
    validate(patch);
  const auto exists = [&](const Edge &edge) { return edge.patch >= 0 && edge.patch < n_patches(); };
  for (const auto &[name, sides] : edges_)
    for (const auto &edge : sides)
      if (!exists(edge))
        throw InvalidParameter("surface: edge \"" + name + "\" lies on patch " + std::to_string(edge.patch) +
                               ", but the surface has " + std::to_string(n_patches()) + " patches");
  std::set<std::pair<int, Side>> joined;
  for (const auto &interface : interfaces_)
    {
      for (const auto &edge : {interface.first, interface.second})
        {
          if (!exists(edge))
            throw InvalidParameter("surface: an interface lies on patch " + std::to_string(edge.patch) +
                                   ", but the surface has " + std::to_string(n_patches()) + " patches");
          if (!joined.insert({edge.patch, edge.side}).second)
            throw InvalidParameter("surface: " + describe(edge) +
                                   " lies on two interfaces, or is joined to itself; expected two different sides for "
                                   "an interface, each of them in one only");
        }
      if (const auto reason = internal::mismatch(patches_, interface, internal::extent(patches_)); !reason.empty())
        throw InvalidParameter("surface: " + internal::describe(interface) + " cannot be joined: " + reason +
                               (interface.reversed ? " (reversed)" : "") +
                               "; expected the same knots, weights and control points along both");
    }
  number();
  equalise();
}

template <int degree, int spacedim>
void Surface<degree, spacedim>::number()
{
  element_offset_.assign(1, 0);
  std::vector<int> offset(1, 0);
  for (const auto &patch : patches_)
    {
      offset.push_back(offset.back() + patch.basis.n_functions());
      element_offset_.push_back(element_offset_.back() + patch.basis.n_elements());
    }
  polynomial_.clear();
  for (const auto &patch : patches_)
    polynomial_.push_back((patch.weights.array() == patch.weights[0]).all());
  internal::SameNumbers same(offset.back());
  for (const auto &interface : interfaces_)
    {
      const internal::InterfaceFunctions<degree> functions(patches_, interface);
      for (std::size_t k = 0; k < functions.sides[0].size(); ++k)
        same.join(offset[interface.first.patch] + functions.sides[0][k].index,
                  offset[interface.second.patch] + functions.sides[1][k].index);
    }
  std::vector<int> id(offset.back());
  int              n_points = 0;
  for (int i = 0; i < offset.back(); ++i)
    id[i] = same.find(i) == i ? n_points++ : id[same.find(i)];

  points_.clear();
  location_offsets_.assign(n_points + 1, 0);
  for (int p = 0; p < n_patches(); ++p)
    {
      points_.emplace_back(id.begin() + offset[p], id.begin() + offset[p + 1]);
      for (const int point : points_[p])
        ++location_offsets_[point + 1];
    }
  std::partial_sum(location_offsets_.begin(), location_offsets_.end(), location_offsets_.begin());
  locations_.resize(offset.back());
  std::vector<int> next(location_offsets_.begin(), location_offsets_.end() - 1);
  for (int p = 0; p < n_patches(); ++p)
    for (std::size_t i = 0; i < points_[p].size(); ++i)
      locations_[next[points_[p][i]]++] = {p, static_cast<int>(i)};
}

template <int degree, int spacedim>
typename Surface<degree, spacedim>::Location Surface<degree, spacedim>::source_of(int point) const
{
  for (const auto &location : locations_of(point))
    if (polynomial_[location.patch])
      return location;
  return locate_point(point);
}

template <int degree, int spacedim>
void Surface<degree, spacedim>::equalise()
{
  for (int point = 0; point < n_control_points(); ++point)
    if (const auto all = locations_of(point); all.size() > 1)
      {
        const auto   source = source_of(point);
        const auto   X      = patches_[source.patch].control_points.row(source.local).eval();
        const double w      = patches_[source.patch].weights[source.local];
        for (const auto &[p, local] : all)
          {
            patches_[p].control_points.row(local) = X;
            patches_[p].weights[local]            = w;
          }
      }
}

template <int degree, int spacedim>
typename Surface<degree, spacedim>::Location Surface<degree, spacedim>::locate_element(int element) const
{
  const auto next = std::upper_bound(element_offset_.begin(), element_offset_.end(), element);
  const int  p    = static_cast<int>(next - element_offset_.begin()) - 1;
  return {p, element - element_offset_[p]};
}

template <int degree, int spacedim>
const std::vector<Edge> &Surface<degree, spacedim>::edge(const std::string &name) const
{
  const auto found = edges_.find(name);
  if (found == edges_.end())
    {
      std::string names;
      for (const auto &entry : edges_)
        names += (names.empty() ? "" : ", ") + entry.first;
      throw InvalidParameter("surface: there is no edge \"" + name + "\"; its edges are " + names);
    }
  return found->second;
}

template <int degree, int spacedim>
ControlValues<spacedim> Surface<degree, spacedim>::control_points() const
{
  ControlValues<spacedim> all(n_control_points(), spacedim);
  for (int point = 0; point < n_control_points(); ++point)
    {
      const auto [p, local] = locate_point(point);
      all.row(point)        = patches_[p].control_points.row(local);
    }
  return all;
}

template <int degree, int spacedim>
Eigen::VectorXd Surface<degree, spacedim>::weights() const
{
  Eigen::VectorXd all(n_control_points());
  for (int point = 0; point < n_control_points(); ++point)
    {
      const auto [p, local] = locate_point(point);
      all[point]            = patches_[p].weights[local];
    }
  return all;
}

template <int degree, int spacedim>
SurfaceRefinement Surface<degree, spacedim>::refine(const std::vector<int> &points, const SpanTarget &target)
{
  return refine_to(points, std::vector<SpanTarget>(patches_.size(), target));
}

template <int degree, int spacedim>
SurfaceRefinement Surface<degree, spacedim>::refine_to(const std::vector<int>        &points,
                                                       const std::vector<SpanTarget> &targets)
{
  if (targets.size() != patches_.size())
    throw DimensionMismatch("surface: " + std::to_string(targets.size()) + " targets of a refinement for " +
                            std::to_string(n_patches()) + " patches");
  std::vector<std::vector<int>> marked(patches_.size());
  for (const int point : points)
    {
      if (point < 0 || point >= n_control_points())
        throw InvalidParameter("surface: control point " + std::to_string(point) +
                               " was marked for refinement, expected 0 to " + std::to_string(n_control_points() - 1));
      for (const auto &[p, local] : locations_of(point))
        marked[p].push_back(local);
    }
  auto refined = internal::refine_joined(patches_, interfaces_, marked, targets);
  for (int p = 0; p < n_patches(); ++p)
    if (const auto check = check_independence(patches_[p].basis); !check.independent())
      throw Error("surface: refinement made " + std::to_string(check.dependent.size()) + " functions of patch " +
                  std::to_string(p) + " linearly dependent; refine a wider neighbourhood (theory H.5)");

  SurfaceRefinement result;
  for (int p = 0; p < n_patches(); ++p)
    {
      auto &patch          = patches_[p];
      refined[p].transfer  = rational_transfer(std::move(refined[p].transfer), patch.weights);
      patch.control_points = refined[p].transfer.apply(patch.control_points);
      for (const int parent : refined[p].parent)
        result.parent.push_back(element_offset_[p] + parent);
    }
  const auto old_points = points_;
  number();
  equalise();

  // Rows of a shared control point agree on its patches: on a side only functions of that side have a part in it.
  result.transfer.offsets.assign(1, 0);
  std::vector<std::pair<int, double>> row;
  for (int point = 0; point < n_control_points(); ++point)
    {
      const auto [p, local] = source_of(point);
      const auto columns    = refined[p].transfer.row_columns(local);
      const auto values     = refined[p].transfer.row_values(local);
      row.clear();
      for (std::size_t k = 0; k < columns.size(); ++k)
        row.emplace_back(old_points[p][columns[k]], values[k]);
      std::sort(row.begin(), row.end());
      for (std::size_t k = 0; k < row.size(); ++k)
        if (k > 0 && row[k].first == row[k - 1].first)
          result.transfer.values.back() += row[k].second;
        else
          {
            result.transfer.columns.push_back(row[k].first);
            result.transfer.values.push_back(row[k].second);
          }
      result.transfer.offsets.push_back(static_cast<int>(result.transfer.columns.size()));
    }
  return result;
}

template <int degree, int spacedim>
std::vector<Interface> find_interfaces(const std::vector<Patch<degree, spacedim>> &patches)
{
  const double size = patches.empty() ? 0. : internal::extent(patches);
  // Ends of the sides, to sort out what cannot coincide.
  struct Candidate
  {
    Edge                           edge;
    std::array<Point<spacedim>, 2> ends;
  };
  std::vector<Candidate> candidates;
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    for (const Side side : {Side::u_min, Side::u_max, Side::v_min, Side::v_max})
      {
        const auto functions = internal::side_functions(patches[p].basis, side, false);
        const auto X         = [&](const auto &function) -> Point<spacedim> {
          return patches[p].control_points.row(function.index).transpose();
        };
        double length = 0.;
        for (const auto &function : functions)
          length = std::max(length, (X(function) - X(functions.front())).norm());
        if (length > 1e-10 * size)
          candidates.push_back({{p, side}, {X(functions.front()), X(functions.back())}});
      }
  std::vector<Interface> result;
  std::vector<char>      joined(candidates.size(), 0);
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size(); ++b)
      for (const bool reversed : {false, true})
        {
          const auto close = [&](int i, int j) {
            return (candidates[a].ends[i] - candidates[b].ends[j]).norm() <= 1e-9 * size;
          };
          const Interface interface {
            candidates[a].edge, candidates[b].edge, reversed
          };
          if (!close(0, reversed ? 1 : 0) || !close(1, reversed ? 0 : 1) ||
              !internal::mismatch(patches, interface, size).empty())
            continue;
          if (joined[a] || joined[b])
            throw InvalidParameter("interfaces: " + internal::describe(interface) +
                                   " coincide, but one of them coincides with a third side already; expected at most "
                                   "two patches along a curve, name the interfaces yourself");
          joined[a] = joined[b] = 1;
          result.push_back(interface);
          break;
        }
  return result;
}

template <int degree, int spacedim>
std::vector<int> elements_along(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  const auto &basis   = surface.patch(edge.patch).basis;
  const int   normal  = internal::normal_direction(edge.side);
  const int   tangent = 1 - normal;
  double      border  = internal::at_maximum(edge.side) ? -std::numeric_limits<double>::infinity()
                                                        : std::numeric_limits<double>::infinity();
  const auto  outer   = [&](int e) {
    const auto &box = basis.element(e);
    return internal::at_maximum(edge.side) ? box.max[normal] : box.min[normal];
  };
  for (int e = 0; e < basis.n_elements(); ++e)
    border = internal::at_maximum(edge.side) ? std::max(border, outer(e)) : std::min(border, outer(e));

  std::vector<int> elements;
  for (int e = 0; e < basis.n_elements(); ++e)
    if (outer(e) == border)
      elements.push_back(e);
  std::sort(elements.begin(), elements.end(),
            [&](int a, int b) { return basis.element(a).min[tangent] < basis.element(b).min[tangent]; });
  for (int &e : elements)
    e += surface.element_offset(edge.patch);
  return elements;
}

namespace internal
{
/// Functions whose knots across a side repeat its value exactly @p multiplicity times, in the order of the parameter
/// along the side.
template <int degree>
std::vector<int> functions_of_multiplicity(const LRBasis<degree> &basis, Side side, int multiplicity)
{
  const int    normal  = normal_direction(side);
  const int    tangent = 1 - normal;
  const double border  = at_maximum(side) ? basis.domain().max[normal] : basis.domain().min[normal];

  std::vector<int> functions;
  for (int i = 0; i < basis.n_functions(); ++i)
    {
      const auto &knots = basis.function(i).knots[normal];
      if (std::count(knots.begin(), knots.end(), border) == multiplicity)
        functions.push_back(i);
    }
  const auto centre = [&](int i) {
    const auto &knots = basis.function(i).knots[tangent];
    return std::accumulate(knots.begin() + 1, knots.end() - 1, 0.);
  };
  std::sort(functions.begin(), functions.end(), [&](int a, int b) { return centre(a) < centre(b); });
  return functions;
}

template <int degree, int spacedim>
std::vector<int> points_of_multiplicity(const Surface<degree, spacedim> &surface, const Edge &edge, int multiplicity)
{
  auto points = functions_of_multiplicity(surface.patch(edge.patch).basis, edge.side, multiplicity);
  for (int &i : points)
    i = surface.point(edge.patch, i);
  return points;
}
} // namespace internal

template <int degree, int spacedim>
std::vector<int> points_along(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  return internal::points_of_multiplicity(surface, edge, degree + 1);
}

template <int degree, int spacedim>
std::vector<int> second_row_along(const Surface<degree, spacedim> &surface, const Edge &edge)
{
  return internal::points_of_multiplicity(surface, edge, degree);
}

} // namespace sherd
