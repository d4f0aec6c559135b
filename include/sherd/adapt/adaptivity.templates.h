#pragma once

#include <sherd/adapt/adaptivity.h>
#include <sherd/base/print.h>

namespace sherd
{

template <class Model>
Adaptivity<Model>::Adaptivity(const SurfaceType &surface, const RefinementSettings &settings) : settings_(settings)
{
  if (!(settings.target > 0.))
    throw InvalidParameter("refinement.target = " + std::to_string(settings.target) +
                           ", expected an element size > 0, at most half the length scale");
  if (!(settings.halo >= 0.))
    throw InvalidParameter("refinement.halo = " + std::to_string(settings.halo) + ", expected a length >= 0");
  targets_ = span_targets(surface, settings.target);
}

template <class Model>
template <class Solver>
void Adaptivity<Model>::prepare(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
                                const PreCrack<spacedim> &pre_crack)
{
  is_new_mesh_       = true;
  const auto &model  = solver.model();
  auto       &timers = solver.timers();
  {
    const auto timing = timers.measure("partition");
    for (;;)
      {
        const auto       marking = timers.measure("marking");
        std::vector<int> marked;
        const auto       X = surface.control_points();
        for (const int point : coarse_points(surface, targets_))
          {
            const Point<spacedim> position = X.row(point).transpose();
            const auto [p, i]              = surface.locate_point(point);
            // Functions so coarse that the crack may run between their control points are marked as well.
            if (pre_crack.phase(position, model.crack_density) < settings_.phase ||
                pre_crack.distance(position) <=
                    settings_.target * reach(surface.patch(p).basis.function(i), targets_[p]))
              marked.push_back(point);
          }
        if (marked.empty())
          break;
        const auto refining = timers.measure("refine");
        surface.refine_to(marked, targets_);
      }
    space.rebuild();
    state = StateType(space);
  }
  solver.rebuild(state);

  const auto timing = timers.measure("initial state");
  const auto X      = surface.control_points();
  for (int a = 0; a < state.distribution->n_local(); ++a)
    if (const auto point = state.distribution->global(a); !space.is_multiplier(point))
      state.phase.local()[a] = pre_crack.phase(Point<spacedim>(X.row(point).transpose()), model.crack_density);
  int n_cracked = 0;
  for (int e = 0; e < space.n_active_elements(); ++e)
    for (int q = 0; q < state.n_q; ++q)
      {
        const auto position = solver.assembler().quadrature_position(e, q);
        state.history[e][q] = model.irreversibility.initial(
            pre_crack.history(position, model.degradation, model.crack_density, model.toughness(position)),
            pre_crack.phase(position, model.crack_density));
        n_cracked += pre_crack.contains(position);
      }
  MPI_Allreduce(MPI_IN_PLACE, &n_cracked, 1, MPI_INT, MPI_SUM, space.environment().comm());
  if (n_cracked == 0 && !pre_crack.cracks().empty())
    throw InvalidParameter("pre-crack: no quadrature point lies within " + print(pre_crack.half_width) +
                           " l0 of it, so that it would have no effect; check its position, and that "
                           "refinement.target = " +
                           print(settings_.target) + " is at most l0/2 = " + print(.5 * model.length_scale));
  solver.equilibrate_phase(state);
}

template <class Model>
template <class Solver>
void Adaptivity<Model>::refine(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
                               const Triggers<spacedim> &triggers)
{
  is_new_mesh_ = true;
  auto &timers = solver.timers();
  {
    const auto timing = timers.measure("transfer");
    auto       global = gather(state, space);
    for (;;)
      {
        const auto marking = timers.measure("marking");
        // At least the triggering functions themselves, whatever the rounding of their positions.
        const auto marked = coarse_points_near(surface, targets_, triggers, .5 * settings_.target);
        if (marked.empty())
          break;
        const auto refining     = timers.measure("refine");
        const auto boxes        = element_boxes(surface);
        const auto refinement   = surface.refine_to(marked, targets_);
        const auto transferring = timers.measure("transfer");
        global                  = transfer(global, boxes, refinement, surface);
      }
    {
      const auto partitioning = timers.measure("partition");
      space.rebuild();
    }
    state = distribute(global, space);
  }
  solver.rebuild(state);
  const auto timing  = timers.measure("transfer");
  Vector     at_rest = state.acceleration;
  at_rest.fill(0.);
  state.history = solver.assembler().committed({state.position, at_rest, state.phase}, state.history);
}

template <class Model>
template <class Solver>
StepSummary Adaptivity<Model>::advance(Solver &solver, SurfaceType &surface, SpaceType &space, StateType &state,
                                       StepController &controller, double end_time)
{
  StepSummary summary;
  for (;;)
    {
      controller.limit(solver.largest_step());
      const double stop      = controller.next_stop(state.time, end_time);
      const double remaining = stop - state.time;
      const double dt        = controller.step_within(remaining);
      auto         result    = solver.attempt(state, dt);
      ++summary.attempts;
      summary.linear += result.linear;
      summary.switched += result.switched;
      summary.messages.insert(summary.messages.end(), result.messages.begin(), result.messages.end());
      if (!result.state)
        {
          ++summary.rejected;
          summary.messages.push_back("rejected: " + result.failure);
          controller.reject(summary.rejected == 1 ? result.failure
                                                  : result.failure + " (at first " + summary.messages.front() + ")",
                            dt);
          continue;
        }
      if (controller.is_inaccurate(result.error))
        {
          ++summary.rejected;
          summary.messages.push_back("rejected: estimated error " + print(result.error));
          controller.reject_inaccurate(result.error, dt);
          continue;
        }

      const auto triggers = [&] {
        const auto timing = solver.timers().measure("marking");
        return find_triggers(solver.assembler(), *result.state, targets_, settings_);
      }();
      if (!triggers.empty() && triggers.smallest_phase < settings_.recompute_phase)
        {
          refine(solver, surface, space, state, triggers);
          controller.refine();
          controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());
          ++summary.refined;
          ++summary.repeated;
          continue;
        }

      summary.dt            = dt;
      summary.newton        = result.newton;
      summary.error         = result.error;
      summary.work          = result.work;
      summary.withheld_work = result.withheld_work;
      summary.largest_phase = result.largest_phase;
      {
        const auto timing = solver.timers().measure("energies");
        if (is_new_mesh_)
          summary.before = solver.energies(state);
        summary.energies = solver.energies(*result.state);
        is_new_mesh_     = false;
      }
      state = std::move(*result.state);
      // The sum of time and step may miss the stop by rounding.
      if (dt == remaining)
        state.time = stop;
      if (triggers.empty())
        controller.accept(result.newton, result.error, dt);
      else
        {
          solver.keep_reactions();
          refine(solver, surface, space, state, triggers);
          controller.refine();
          controller.bound(solver.assembler().shortest_edge(), solver.rayleigh_speed());
          ++summary.refined;
        }
      return summary;
    }
}

} // namespace sherd
