#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <sherd/assembly/assembler.h>
#include <sherd/base/all_gather.h>
#include <sherd/base/parameter_section.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/state/state.h>

namespace sherd
{

/// When and where the mesh is refined around cracks (theory F.4, H.6).
struct RefinementSettings
{
  double target           = 0.;   ///< largest element edge at cracks [length], at most l0/2
  double phase            = .975; ///< a control value below it refines the support of its function, paper section 2.3
  double halo             = 0.;   ///< functions this close to a triggering one are refined too [length]; 0: none
  double recompute_phase  = .9;   ///< a step that took phi below it on too coarse a mesh is repeated
  double history_fraction = .5;   ///< elements in which H exceeds this part of the onset density are refined; > 0

  void declare(ParameterSection &section)
  {
    section.value("target", target, "length", range::positive(), "largest element edge at cracks, at most l0/2");
    section.value("phase", phase, "-", range::left_open(0., 1.),
                  "a control value below it refines the support of its function");
    section.value("halo", halo, "length", range::non_negative(),
                  "functions this close to a triggering one are refined with it; 0: none");
    section.value("recompute_phase", recompute_phase, "-", range::closed(0., 1.),
                  "a step that took the phase below it on too coarse a mesh is repeated");
    section.value("history_fraction", history_fraction, "-", range::positive(),
                  "elements whose driving energy exceeds this part of the onset of damage are refined");
  }
};

/// Knot spans of the parameter domain that are as long as @p length on the reference surface, or shorter, everywhere.
template <int degree, int spacedim>
SpanTarget span_target(const Surface<degree, spacedim> &surface, double length)
{
  double largest[2] = {0., 0.};
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto [p, local] = surface.locate_element(e);
      const auto size       = surface.patch(p).basis.element(local).size();
      const auto geometry   = element_geometry(surface, e);
      for (const auto &q : geometry.reference)
        for (int d = 0; d < 2; ++d)
          largest[d] = std::max(largest[d], std::sqrt(q.covariant[d]) / size[d]);
    }
  // A target that differs from a bisected span by rounding is met by that span.
  constexpr double slack = 1. + 1e-9;
  return {{length * slack / largest[0], length * slack / largest[1]}};
}

/// Whether a knot span of the function is longer than the target.
template <int degree>
bool is_coarse(const LRFunction<degree> &function, const SpanTarget &target)
{
  for (int d = 0; d < 2; ++d)
    for (int k = 0; k <= degree; ++k)
      if (function.knots[d][k + 1] - function.knots[d][k] > target.length[d] * (1. + 1e-10))
        return true;
  return false;
}

/// Half the diagonal of the largest knot span of the function in units of the target length, from above: about the
/// distance between a point of the surface and the nearest control point of functions this coarse.
template <int degree>
double reach(const LRFunction<degree> &function, const SpanTarget &target)
{
  double span[2] = {0., 0.};
  for (int d = 0; d < 2; ++d)
    for (int k = 0; k <= degree; ++k)
      span[d] = std::max(span[d], (function.knots[d][k + 1] - function.knots[d][k]) / target.length[d]);
  return .5 * std::hypot(span[0], span[1]) * (1. + 1e-9);
}

/// Control points of the surface whose function is coarse, ascending.
template <int degree, int spacedim>
std::vector<int> coarse_points(const Surface<degree, spacedim> &surface, const SpanTarget &target)
{
  std::vector<int> points;
  for (int p = 0; p < surface.n_patches(); ++p)
    for (int i = 0; i < surface.patch(p).basis.n_functions(); ++i)
      if (is_coarse(surface.patch(p).basis.function(i), target))
        points.push_back(surface.point_offset(p) + i);
  return points;
}

/// Places that ask for refinement: control points of coarse functions, as positions on the reference surface.
template <int spacedim>
struct Triggers
{
  std::vector<Point<spacedim>> positions;
  double                       smallest_phase = 1.; ///< among their control values

  bool empty() const { return positions.empty(); }
};

/// Coarse functions with a control value below the threshold, and those on elements whose history is close to the
/// onset of damage. Collective; the same on all ranks.
template <class Model>
Triggers<Model::spacedim> find_triggers(const Assembler<Model>                      &assembler,
                                        const State<Model::degree, Model::spacedim> &state, const SpanTarget &target,
                                        const RefinementSettings &settings)
{
  const auto &space   = assembler.space();
  const auto &surface = space.surface();
  const auto &d       = space.distribution();

  // This rank looks at the control points it owns and at the elements it integrates.
  std::vector<int> marked;
  const auto       coarse = [&](int point) {
    const auto [p, i] = surface.locate_point(point);
    return is_coarse(surface.patch(p).basis.function(i), target);
  };
  for (std::size_t a = 0; a < d.owned.size(); ++a)
    if (state.phase.local()[a] < settings.phase && coarse(static_cast<int>(d.owned[a])))
      marked.push_back(static_cast<int>(d.owned[a]));
  const auto intensity = assembler.intensity(state.history);
  for (int e = 0; e < space.n_active_elements(); ++e)
    if (intensity[e] > settings.history_fraction)
      {
        const auto [p, local] = surface.locate_element(d.elements[e]);
        for (const int i : surface.patch(p).basis.functions_of(local))
          if (is_coarse(surface.patch(p).basis.function(i), target))
            marked.push_back(surface.point_offset(p) + i);
      }
  marked = all_gather(space.environment().comm(), marked);
  std::sort(marked.begin(), marked.end());
  marked.erase(std::unique(marked.begin(), marked.end()), marked.end());

  Triggers<Model::spacedim> triggers;
  for (const int point : marked)
    {
      const auto [p, i] = surface.locate_point(point);
      triggers.positions.push_back(surface.patch(p).control_points.row(i).transpose());
      if (const int a = d.local[point]; a >= 0)
        triggers.smallest_phase = std::min(triggers.smallest_phase, state.phase.local()[a]);
    }
  MPI_Allreduce(MPI_IN_PLACE, &triggers.smallest_phase, 1, MPI_DOUBLE, MPI_MIN, space.environment().comm());
  return triggers;
}

/// Coarse functions whose control point lies within @p radius of one of @p centres.
template <int degree, int spacedim>
std::vector<int> coarse_points_near(const Surface<degree, spacedim> &surface, const SpanTarget &target,
                                    const std::vector<Point<spacedim>> &centres, double radius)
{
  std::vector<int> near;
  for (const int point : coarse_points(surface, target))
    {
      const auto [p, i]           = surface.locate_point(point);
      const Point<spacedim> X     = surface.patch(p).control_points.row(i).transpose();
      const auto            close = [&](const Point<spacedim> &c) { return (X - c).squaredNorm() <= radius * radius; };
      if (std::any_of(centres.begin(), centres.end(), close))
        near.push_back(point);
    }
  return near;
}

} // namespace sherd
