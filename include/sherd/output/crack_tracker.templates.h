#pragma once

#include <algorithm>
#include <limits>

#include <sherd/geometry/place.h>
#include <sherd/output/crack_tracker.h>

namespace sherd
{
namespace internal
{

/// X of a patch at parameters (u, v), z = 0 in the plane.
template <int degree, int spacedim>
Eigen::Vector3d position(const Patch<degree, spacedim> &patch, double u, double v)
{
  const auto      element = bezier_element<spacedim>(patch, patch.basis.element_at(u, v), patch.control_points);
  Eigen::Vector3d X       = Eigen::Vector3d::Zero();
  X.head<spacedim>()      = element(u, v);
  return X;
}

/// Largest |A_1| and |A_2| on a grid of points, by differences over its cells.
template <int degree, int spacedim>
std::array<double, 2> largest_tangents(const Patch<degree, spacedim> &patch)
{
  constexpr int         n      = 32;
  const auto           &domain = patch.basis.domain();
  const auto            size   = domain.size();
  std::array<double, 2> result{0., 0.};
  for (int d = 0; d < 2; ++d)
    for (int k = 0; k <= n; ++k)
      {
        Eigen::Vector3d before;
        for (int l = 0; l <= n; ++l)
          {
            std::array<double, 2> at;
            at[d]        = l == n ? domain.max[d] : domain.min[d] + size[d] * l / n;
            at[1 - d]    = k == n ? domain.max[1 - d] : domain.min[1 - d] + size[1 - d] * k / n;
            const auto X = position(patch, at[0], at[1]);
            if (l > 0)
              result[d] = std::max(result[d], (X - before).norm() / (size[d] / n));
            before = X;
          }
      }
  return result;
}

/// Number of initial knot spans if these are equal, otherwise 1.
inline int n_equal_spans(const std::vector<double> &knots)
{
  std::vector<double> values = knots;
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const int    n    = static_cast<int>(values.size()) - 1;
  const double span = (values.back() - values.front()) / n;
  for (int k = 0; k < n; ++k)
    if (std::abs(values[k + 1] - values[k] - span) > 1e-10 * span)
      return 1;
  return n;
}

/// Parameters of points along a side, a sample apart.
template <int degree, int spacedim>
std::vector<std::array<double, 2>> parameters_along_side(const Patch<degree, spacedim> &patch, Side side,
                                                         const SampleLattice &lattice)
{
  std::vector<std::array<double, 2>> result;
  const auto                        &domain = patch.basis.domain();
  const int                          d      = 1 - normal_direction(side);
  for (int k = 0; k <= lattice.n[d]; ++k)
    {
      std::array<double, 2> at;
      at[d]     = k == lattice.n[d] ? domain.max[d] : domain.min[d] + k * lattice.spacing[d];
      at[1 - d] = at_maximum(side) ? domain.max[1 - d] : domain.min[1 - d];
      result.push_back(at);
    }
  return result;
}

/// The stretches of all interfaces where phi is below the threshold, as points a sample apart.
template <int degree, int spacedim>
std::vector<BrokenRun> broken_runs(const Surface<degree, spacedim> &surface, const Eigen::VectorXd &phase,
                                   const std::vector<SampleLattice> &lattices, double threshold)
{
  std::vector<BrokenRun> result;
  for (const auto &interface : surface.interfaces())
    {
      const int   p          = interface.first.patch;
      const auto &patch      = surface.patch(p);
      const auto  points     = surface.points_of_patch(p);
      const auto  parameters = parameters_along_side(patch, interface.first.side, lattices[p]);
      const auto  is_broken  = [&](const std::array<double, 2> &at) {
        const auto functions = patch.basis.functions_of(patch.basis.element_at(at[0], at[1]));
        // phi lies between its control values.
        if (std::none_of(functions.begin(), functions.end(), [&](int i) { return phase[points[i]] < threshold; }))
          return false;
        const auto shape = evaluate(surface, SurfacePlace{p, at[0], at[1]});
        double     phi   = 0.;
        for (std::size_t k = 0; k < shape.points.size(); ++k)
          phi += shape.value[k] * phase[shape.points[k]];
        return phi < threshold;
      };
      for (std::size_t begin = 0; begin < parameters.size(); ++begin)
        if (is_broken(parameters[begin]))
          {
            auto       &run = result.emplace_back();
            std::size_t end = begin;
            for (; end < parameters.size() && (end == begin || is_broken(parameters[end])); ++end)
              run.points.push_back(position(patch, parameters[end][0], parameters[end][1]));
            run.patches     = {p, interface.second.patch};
            const int d     = normal_direction(interface.first.side);
            auto      inner = parameters[(begin + end) / 2];
            inner[d] += (at_maximum(interface.first.side) ? -1. : 1.) * lattices[p].spacing[d];
            run.across = run.points[run.points.size() / 2] - position(patch, inner[0], inner[1]);
            begin      = end;
          }
    }
  return result;
}

} // namespace internal

template <int degree, int spacedim>
SampleLattice sample_lattice(const Patch<degree, spacedim> &patch, double spacing)
{
  const auto   &domain   = patch.basis.domain();
  const auto    size     = domain.size();
  const auto    tangents = internal::largest_tangents(patch);
  SampleLattice lattice;
  for (int d = 0; d < 2; ++d)
    {
      int n = internal::n_equal_spans(patch.basis.initial_knots()[d]);
      while (tangents[d] * size[d] / n > spacing * (1. + 1e-6))
        n *= 2;
      lattice.n[d]       = n;
      lattice.origin[d]  = domain.min[d];
      lattice.spacing[d] = size[d] / n;
    }
  return lattice;
}

template <int degree, int spacedim, class Derived>
SampleGrid sample_broken_set(const Patch<degree, spacedim> &patch, const Eigen::MatrixBase<Derived> &phase,
                             const SampleLattice &lattice, double threshold)
{
  using Element = BezierElement<degree, 1>;
  using Table   = Eigen::Matrix<double, degree + 1, Eigen::Dynamic>;
  SampleGrid           grid(lattice.n[0], lattice.n[1]);
  std::array<Table, 2> tables;
  const auto          &basis = patch.basis;
  for (int e = 0; e < basis.n_elements(); ++e)
    {
      // Bernstein polynomials and functions are not negative: phi lies between its control values.
      const auto functions = basis.functions_of(e);
      if (std::none_of(functions.begin(), functions.end(), [&](int i) { return phase[i] < threshold; }))
        continue;
      const Element element = bezier_element<1>(patch, e, phase);
      if (!(element.values.minCoeff() < threshold))
        continue;

      const auto         size = element.box.size();
      std::array<int, 2> first, n;
      for (int d = 0; d < 2; ++d)
        {
          first[d] = lattice.first_behind(d, element.box.min[d]);
          n[d]     = lattice.first_behind(d, element.box.max[d]) - first[d];
          tables[d].resize(degree + 1, n[d]);
          for (int k = 0; k < n[d]; ++k)
            {
              const double at  = lattice.origin[d] + (first[d] + k + 0.5) * lattice.spacing[d];
              const auto   B   = bernstein_1d<degree>((at - element.box.min[d]) / size[d]).value;
              tables[d].col(k) = Eigen::Map<const Eigen::Matrix<double, degree + 1, 1>>(B.data());
            }
        }
      using Net                         = Eigen::Matrix<double, degree + 1, degree + 1>;
      const typename Element::Weights H = element.weights.cwiseProduct(element.values);
      const Eigen::Map<const Net>     numerator(H.data()), denominator(element.weights.data());
      for (int l = 0; l < n[1]; ++l)
        {
          const Eigen::Matrix<double, degree + 1, 1> row = numerator * tables[1].col(l);
          const Eigen::Matrix<double, degree + 1, 1> W   = denominator * tables[1].col(l);
          for (int k = 0; k < n[0]; ++k)
            {
              const double phi = row.dot(tables[0].col(k)) / W.dot(tables[0].col(k));
              if (phi < threshold)
                {
                  const double depth = std::clamp(255. * (threshold - phi) / threshold, 1., 255.);
                  grid.set({first[0] + k, first[1] + l}, static_cast<std::uint8_t>(std::lround(depth)));
                }
            }
        }
    }
  return grid;
}

template <int degree, int spacedim>
CrackTracker::CrackTracker(const Surface<degree, spacedim> &surface, const CrackOptions &options)
    : options_(options), tree_(options)
{
  const double spacing = std::min(options.target_size, 0.5 * options.length_scale) / 4.;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      lattices_.push_back(sample_lattice(surface.patch(p), spacing));
      for (const Side side : {Side::u_min, Side::u_max, Side::v_min, Side::v_max})
        {
          const auto  is_this = [&](const Edge &edge) { return edge.patch == p && edge.side == side; };
          const auto &all     = surface.interfaces();
          const bool  joined  = std::any_of(all.begin(), all.end(), [&](const Interface &interface) {
            return is_this(interface.first) || is_this(interface.second);
          });
          if (!joined)
            for (const auto &at : internal::parameters_along_side(surface.patch(p), side, lattices_.back()))
              body_edge_.push_back(internal::position(surface.patch(p), at[0], at[1]));
        }
    }
}

template <int degree, int spacedim>
void CrackTracker::update(const Surface<degree, spacedim> &surface, const Eigen::VectorXd &phase, double time)
{
  if (surface.n_patches() != static_cast<int>(lattices_.size()))
    throw DimensionMismatch("crack tracker: made for " + std::to_string(lattices_.size()) +
                            " patches, given a surface with " + std::to_string(surface.n_patches()));
  if (phase.size() != surface.n_control_points())
    throw DimensionMismatch("crack tracker: " + std::to_string(phase.size()) + " phase values for " +
                            std::to_string(surface.n_control_points()) + " control points");
  const auto                   known = branch_points();
  const double                 l0    = options_.length_scale;
  const auto                   runs  = internal::broken_runs(surface, phase, lattices_, options_.threshold);
  std::vector<Eigen::Vector3d> broken;
  for (const auto &run : runs)
    broken.insert(broken.end(), run.points.begin(), run.points.end());
  const Pruning     pruning{4. * l0, 2. * l0, 2. * l0, known, broken};
  PatchedCracks     cracks;
  std::vector<char> self_joined(surface.n_patches(), 0);
  for (const auto &interface : surface.interfaces())
    if (interface.first.patch == interface.second.patch)
      self_joined[interface.first.patch] = 1;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      const auto     &patch   = surface.patch(p);
      const auto     &lattice = lattices_[p];
      const auto      points  = surface.points_of_patch(p);
      Eigen::VectorXd values(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        values[i] = phase[points[i]];
      const auto &domain    = patch.basis.domain();
      const auto  in_domain = [&](const std::array<double, 2> &at) {
        return at[0] >= domain.min[0] && at[0] <= domain.max[0] && at[1] >= domain.min[1] && at[1] <= domain.max[1];
      };
      const LatticeField field{[&](const Eigen::Vector2d &q) {
                                 const auto at = lattice.parameters(q);
                                 return internal::position(patch, std::clamp(at[0], domain.min[0], domain.max[0]),
                                                           std::clamp(at[1], domain.min[1], domain.max[1]));
                               },
                               [&](const Eigen::Vector2d &q) {
                                 const auto at = lattice.parameters(q);
                                 if (!in_domain(at))
                                   return std::numeric_limits<double>::infinity();
                                 return bezier_element<1>(patch, patch.basis.element_at(at[0], at[1]),
                                                          values)(at[0], at[1])[0];
                               },
                               options_.threshold};
      const auto         grid = sample_broken_set(patch, values, lattice, options_.threshold);
      if (!grid.samples().empty())
        cracks.append(crack_graph(grid, field, pruning), p);
    }
  join(std::move(cracks), self_joined, runs, pruning);
  tree_.advance(cracks_, ends_inside(), time);
}

} // namespace sherd
