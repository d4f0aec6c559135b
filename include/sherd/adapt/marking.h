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
  double phase_with       = .985; ///< once something is refined, functions with control values below it are as well
  double halo             = 0.;   ///< how far ahead a front at 0.6 c_R refines [length], slower ones less; 0: none
  double recompute_phase  = .9;   ///< a step that took phi below it on too coarse a mesh is repeated
  double history_fraction = .5;   ///< elements in which H exceeds this part of the onset density are refined; > 0

  void declare(ParameterSection &section)
  {
    section.value("target", target, "length", range::positive(), "largest element edge at cracks, at most l0/2");
    section.value("phase", phase, "-", range::left_open(0., 1.),
                  "a control value below it refines the support of its function");
    section.value("phase_with", phase_with, "-", range::left_open(0., 1.),
                  "once something is refined, functions with control values below it are as well");
    section.value("halo", halo, "length", range::non_negative(),
                  "a crack front at 0.6 c_R refines so far ahead, a slower one in proportion; 0: none");
    section.value("recompute_phase", recompute_phase, "-", range::closed(0., 1.),
                  "a step that took the phase below it on too coarse a mesh is repeated");
    section.value("history_fraction", history_fraction, "-", range::positive(),
                  "elements whose driving energy exceeds this part of the onset of damage are refined");
  }
};

/// Knot spans of the parameter domain of each patch that are as long as @p length on the reference surface, or shorter,
/// everywhere on the patch; shape=(n_patches).
template <int degree, int spacedim>
std::vector<SpanTarget> span_targets(const Surface<degree, spacedim> &surface, double length)
{
  std::vector<std::array<double, 2>> largest(surface.n_patches(), {0., 0.});
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto [p, local] = surface.locate_element(e);
      const auto size       = surface.patch(p).basis.element(local).size();
      const auto geometry   = element_geometry(surface, e);
      for (const auto &q : geometry.reference)
        for (int d = 0; d < 2; ++d)
          largest[p][d] = std::max(largest[p][d], std::sqrt(q.covariant[d]) / size[d]);
    }
  // A target that differs from a bisected span by rounding is met by that span.
  constexpr double        slack = 1. + 1e-9;
  std::vector<SpanTarget> targets;
  for (const auto &[first, second] : largest)
    targets.push_back({{length * slack / first, length * slack / second}});
  return targets;
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

/// Whether the function of a control point is coarse on one of its patches.
template <int degree, int spacedim>
bool is_coarse(const Surface<degree, spacedim> &surface, int point, const std::vector<SpanTarget> &targets)
{
  const auto locations = surface.locations_of(point);
  return std::any_of(locations.begin(), locations.end(), [&](const auto &at) {
    return is_coarse(surface.patch(at.patch).basis.function(at.local), targets[at.patch]);
  });
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
std::vector<int> coarse_points(const Surface<degree, spacedim> &surface, const std::vector<SpanTarget> &targets)
{
  std::vector<int> points;
  for (int point = 0; point < surface.n_control_points(); ++point)
    if (is_coarse(surface, point, targets))
      points.push_back(point);
  return points;
}

/// Places that ask for refinement: control points of coarse functions, as positions on the reference surface.
template <int spacedim>
struct Triggers
{
  std::vector<Point<spacedim>> positions;
  std::vector<double>          radii;               ///< around each, coarse functions are refined with it [length]
  double                       smallest_phase = 1.; ///< among their control values

  bool empty() const { return positions.empty(); }
};

/// Speed of the level set of the phase at a control value that fell from @p before to @p after within @p dt. Ahead of a
/// crack 1 - phi = (1 + r/l0) exp(-r/l0) falls by a factor e on about every l0 (theory C.1), so the level set moves l0
/// for each unit of d(log(1 - phi)).
inline double front_speed(double before, double after, double dt, double length_scale)
{
  return after < before && after < 1. ? length_scale * (before - after) / (dt * (1. - after)) : 0.;
}

/// Coarse functions with a control value below the threshold, and those on elements whose history is close to the
/// onset of damage; if there are any, also those that will soon follow, with control values below phase_with: one
/// refinement instead of several. Collective; the same on all ranks.
template <class Model>
Triggers<Model::spacedim> find_triggers(const Assembler<Model>                      &assembler,
                                        const State<Model::degree, Model::spacedim> &state,
                                        const std::vector<SpanTarget> &targets, const RefinementSettings &settings)
{
  const auto &space   = assembler.space();
  const auto &surface = space.surface();
  const auto &d       = space.distribution();

  // This rank looks at the control points it owns and at the elements it integrates.
  std::vector<int> marked;
  const auto       mark_below = [&](double phase) {
    for (std::size_t a = 0; a < d.owned.size(); ++a)
      if (const int point = static_cast<int>(d.owned[a]);
          !space.is_multiplier(point) && state.phase.local()[a] < phase && is_coarse(surface, point, targets))
        marked.push_back(point);
  };
  mark_below(settings.phase);
  const auto intensity = assembler.intensity(state.history);
  for (int e = 0; e < space.n_active_elements(); ++e)
    if (intensity[e] > settings.history_fraction)
      {
        const auto [p, local] = surface.locate_element(d.elements[e]);
        for (const int i : surface.patch(p).basis.functions_of(local))
          if (is_coarse(surface, surface.point(p, i), targets))
            marked.push_back(surface.point(p, i));
      }
  int triggered = !marked.empty();
  MPI_Allreduce(MPI_IN_PLACE, &triggered, 1, MPI_INT, MPI_MAX, space.environment().comm());
  if (triggered)
    mark_below(settings.phase_with);
  marked = all_gather(space.environment().comm(), marked);
  std::sort(marked.begin(), marked.end());
  marked.erase(std::unique(marked.begin(), marked.end()), marked.end());

  Triggers<Model::spacedim> triggers;
  triggers.radii.assign(marked.size(), 0.);
  const double fast = .6 * assembler.fastest_waves().rayleigh;
  for (std::size_t k = 0; k < marked.size(); ++k)
    {
      const auto [p, i] = surface.locate_point(marked[k]);
      triggers.positions.push_back(surface.patch(p).control_points.row(i).transpose());
      if (const int a = d.local[marked[k]]; a >= 0)
        {
          const double phase = state.phase.local()[a];
          const double speed =
              front_speed(state.previous_phase.local()[a], phase, state.step_size, assembler.model().length_scale);
          triggers.radii[k]       = settings.halo * std::min(1., speed / fast);
          triggers.smallest_phase = std::min(triggers.smallest_phase, phase);
        }
    }
  MPI_Allreduce(MPI_IN_PLACE, triggers.radii.data(), static_cast<int>(triggers.radii.size()), MPI_DOUBLE, MPI_MAX,
                space.environment().comm());
  MPI_Allreduce(MPI_IN_PLACE, &triggers.smallest_phase, 1, MPI_DOUBLE, MPI_MIN, space.environment().comm());
  return triggers;
}

/// Coarse functions whose control point lies within the radius of a trigger, @p least at least.
template <int degree, int spacedim>
std::vector<int> coarse_points_near(const Surface<degree, spacedim> &surface, const std::vector<SpanTarget> &targets,
                                    const Triggers<spacedim> &triggers, double least)
{
  std::vector<int> near;
  for (const int point : coarse_points(surface, targets))
    {
      const auto [p, i]           = surface.locate_point(point);
      const Point<spacedim> X     = surface.patch(p).control_points.row(i).transpose();
      bool                  close = false;
      for (std::size_t k = 0; k < triggers.positions.size() && !close; ++k)
        close = (X - triggers.positions[k]).norm() <= std::max(triggers.radii[k], least);
      if (close)
        near.push_back(point);
    }
  return near;
}

} // namespace sherd
