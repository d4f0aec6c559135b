#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/output/run_recorder.h>

namespace sherd
{

template <int degree, int spacedim>
template <class Solver>
void RunRecorder<degree, spacedim>::write_rows(Solver &solver, const SpaceType &space, const StateType &state,
                                               const StepSummary &step)
{
  const auto timing = solver.timers().measure("output");

  HistoryRow row{};
  row.step          = state.step;
  row.time          = state.time;
  row.dt            = step.dt;
  row.newton        = step.newton;
  row.linear        = step.linear;
  row.rejected      = step.rejected;
  row.switched      = step.switched;
  row.elements      = space.surface().n_elements();
  row.dofs          = space.n_unknowns();
  row.min_h         = solver.assembler().shortest_edge();
  row.max_phi       = step.largest_phase;
  row.elastic       = energies_.elastic();
  row.kinetic       = energies_.kinetic;
  row.fracture      = energies_.fracture;
  row.external_work = balance_.external_work();
  row.irreversible  = balance_.irreversible();
  row.balance       = balance_.balance();
  row.wall          = env_.elapsed_seconds();

  std::vector<Point<spacedim>> reactions;
  for (const auto &edge : settings_.edges)
    reactions.push_back(solver.reaction(edge));
  const auto all = snapshot(state);
  on_root(env_.comm(), [&] {
    files_->tracker.update(space.surface(), all.phase, state.time);
    row.crack_length   = files_->tracker.length();
    row.tips           = files_->tracker.tree().n_active();
    const auto fastest = files_->tracker.tree().fastest();
    row.tip_speed      = fastest ? fastest->speed : 0.;
    files_->history.append(row);
    files_->tips.append(state.step, state.time, files_->tracker);
    files_->probes.append(space.surface(), all, reactions);
    for (const auto &message : step.messages)
      std::cout << "  " << message << '\n';
    files_->progress.report({row.step, row.time, row.dt, row.newton, row.dofs, row.crack_length});
  });
  last_ = row;
  if (row.elastic > largest_elastic_)
    {
      largest_elastic_      = row.elastic;
      largest_elastic_time_ = row.time;
    }
  largest_imbalance_ = std::max(largest_imbalance_, std::abs(row.balance));
}

template <int degree, int spacedim>
template <class Solver>
void RunRecorder<degree, spacedim>::write_frame(Solver &solver, const SpaceType &space, const StateType &state)
{
  const auto timing = solver.timers().measure("output");

  // Energy densities of the elements a rank owns, brought together by their numbers.
  struct Entry
  {
    int    element;
    double elastic, fracture;
  };
  const auto        &d         = space.distribution();
  const auto         densities = solver.assembler().densities(state.position, state.phase);
  std::vector<Entry> entries;
  for (int e = 0; e < space.n_active_elements(); ++e)
    if (d.owns[e])
      entries.push_back({d.elements[e], densities[entries.size()].elastic, densities[entries.size()].fracture});
  entries = all_gather(env_.comm(), entries);

  const auto all = snapshot(state);
  on_root(env_.comm(), [&] {
    std::vector<ElementField> fields{{"elastic energy", std::vector<double>(entries.size())},
                                     {"fracture energy", std::vector<double>(entries.size())}};
    for (const auto &entry : entries)
      {
        fields[0].values[entry.element] = entry.elastic;
        fields[1].values[entry.element] = entry.fracture;
      }
    files_->frames.write(space.surface(), all, fields);
    files_->fields.write(space.surface(), all);
  });
  ++n_frames_;
}

template <int degree, int spacedim>
template <class Solver>
void RunRecorder<degree, spacedim>::finish(Solver &solver, const std::string &ending)
{
  const auto seconds = solver.timers().maximum(env_.comm());
  on_root(env_.comm(), [&] {
    JsonObject wall;
    for (const auto &[phase, value] : seconds)
      wall.add(phase, value);
    wall.add("total", env_.elapsed_seconds());

    std::vector<JsonObject> branchings;
    for (const auto &branching : files_->tracker.tree().branchings())
      branchings.push_back(JsonObject()
                               .add("time", branching.time)
                               .add("X", std::vector{branching.X[0], branching.X[1], branching.X[2]})
                               .add("parent", branching.parent)
                               .add("child", branching.child));
    std::vector<JsonObject> tips;
    for (const auto &tip : files_->tracker.tree().tips())
      tips.push_back(JsonObject()
                         .add("tip", tip.id)
                         .add("parent", tip.parent)
                         .add("active", tip.active)
                         .add("X", std::vector{tip.X[0], tip.X[1], tip.X[2]})
                         .add("length", tip.length));
    write_summary(files_->directory, JsonObject()
                                         .add("ending", ending)
                                         .add("time", last_.time)
                                         .add("final", JsonObject()
                                                           .add("elements", last_.elements)
                                                           .add("dofs", last_.dofs)
                                                           .add("elastic", last_.elastic)
                                                           .add("kinetic", last_.kinetic)
                                                           .add("fracture", last_.fracture)
                                                           .add("external_work", last_.external_work)
                                                           .add("irreversible", last_.irreversible)
                                                           .add("balance", last_.balance)
                                                           .add("crack_length", last_.crack_length))
                                         .add("extreme", JsonObject()
                                                             .add("elastic", largest_elastic_)
                                                             .add("elastic_at", largest_elastic_time_)
                                                             .add("balance", largest_imbalance_))
                                         .add("totals", JsonObject()
                                                            .add("steps", totals_.steps)
                                                            .add("attempts", totals_.attempts)
                                                            .add("rejected", totals_.rejected)
                                                            .add("repeated", totals_.repeated)
                                                            .add("switched", totals_.switched)
                                                            .add("refined", totals_.refined)
                                                            .add("newton", totals_.newton)
                                                            .add("linear", totals_.linear))
                                         .add("wall_seconds", wall)
                                         .add("branched_at", branchings)
                                         .add("tips", tips));
  });
}

} // namespace sherd
