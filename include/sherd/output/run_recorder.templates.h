#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>

#include <sherd/base/all_gather.h>
#include <sherd/base/collective.h>
#include <sherd/base/profile.h>
#include <sherd/base/progress.h>
#include <sherd/output/fields_file.h>
#include <sherd/output/frames.h>
#include <sherd/output/history.h>
#include <sherd/output/json.h>
#include <sherd/output/run_recorder.h>
#include <sherd/output/tips_table.h>

namespace sherd
{

template <int degree, int spacedim>
struct RunRecorder<degree, spacedim>::Files
{
  Files(const std::filesystem::path &path, const Surface<degree, spacedim> &surface,
        const RecorderSettings<spacedim> &settings)
      : directory(path),
        history(path),
        work(path / "work.csv", work_columns(settings)),
        tips(path),
        probes(path, surface, settings.points, settings.edges),
        frames(path),
        fields(path, degree, spacedim),
        tracker(surface, settings.crack),
        progress(0., settings.end_time, std::cout)
  {
  }

  Files(const std::filesystem::path &path, const Surface<degree, spacedim> &surface,
        const RecorderSettings<spacedim> &settings, const RecorderMemory &memory)
      : directory(path),
        history(History::resume(path, memory.last.time)),
        work(CsvTable::resume(path / "work.csv", work_columns(settings), memory.last.time)),
        tips(TipsTable::resume(path, memory.last.time)),
        probes(Probes<spacedim>::resume(path, surface, settings.points, settings.edges, memory.last.time)),
        frames(FrameWriter::resume(path, memory.last.time)),
        fields(FieldsFile::resume(path, degree, spacedim, memory.last.time)),
        tracker(surface, settings.crack),
        progress(memory.last.time, settings.end_time, std::cout)
  {
    tracker.restore(memory.cracks);
  }

  static std::vector<std::string> work_columns(const RecorderSettings<spacedim> &settings)
  {
    std::vector<std::string> columns{"step", "time", "supports"};
    for (const auto &load : settings.loads)
      columns.push_back(column_name(load));
    return columns;
  }

  std::filesystem::path directory;
  History               history;
  CsvTable              work;
  TipsTable             tips;
  Probes<spacedim>      probes;
  FrameWriter           frames;
  FieldsFile            fields;
  CrackTracker          tracker;
  ProgressLine          progress;
};

template <int degree, int spacedim>
RunRecorder<degree, spacedim>::RunRecorder(const Environment &env, const OutputDirectory &directory,
                                           const Surface<degree, spacedim> &surface, const Energies &initial,
                                           const RecorderSettings<spacedim> &settings)
    : env_(env), settings_(settings), balance_(initial)
{
  memory_.energies = initial;
  on_root(env.comm(), [&] { files_ = std::make_unique<Files>(directory.path(), surface, settings); });
}

template <int degree, int spacedim>
RunRecorder<degree, spacedim>::RunRecorder(const Environment &env, const OutputDirectory &directory,
                                           const Surface<degree, spacedim> &surface, const RecorderMemory &memory,
                                           const RecorderSettings<spacedim> &settings)
    : env_(env), settings_(settings), balance_(memory.balance), memory_(memory)
{
  on_root(env.comm(), [&] { files_ = std::make_unique<Files>(directory.path(), surface, settings, memory); });
}

template <int degree, int spacedim>
RunRecorder<degree, spacedim>::~RunRecorder() = default;

template <int degree, int spacedim>
void RunRecorder<degree, spacedim>::start(Source &source, const SpaceType &space, const StateType &state)
{
  write_rows(source, space, state, {});
  write_frame(source, space, state);
  ++memory_.n_frames;
}

template <int degree, int spacedim>
void RunRecorder<degree, spacedim>::record(Source &source, const SpaceType &space, const StateType &state,
                                           const StepSummary &step)
{
  balance_.add(step);
  memory_.energies = step.energies;
  memory_.totals.add(step);
  write_rows(source, space, state, step);
  const auto is_due = [&] { return state.time >= settings_.frame_time(memory_.n_frames) * (1. - 1e-9); };
  if (is_due() || std::find(settings_.times.begin(), settings_.times.end(), state.time) != settings_.times.end())
    write_frame(source, space, state);
  while (is_due())
    ++memory_.n_frames;
}

template <int degree, int spacedim>
CsvRow RunRecorder<degree, spacedim>::work_row(const HistoryRow &row) const
{
  CsvRow cells;
  cells << row.step << row.time << row.support_work;
  // None is known before the first step.
  auto of_loads = balance_.work().loads;
  of_loads.resize(settings_.loads.size(), 0.);
  for (const double work : of_loads)
    cells << work;
  return cells;
}

template <int degree, int spacedim>
void RunRecorder<degree, spacedim>::write_rows(Source &source, const SpaceType &space, const StateType &state,
                                               const StepSummary &step)
{
  const auto timing = source.timers().measure("output");

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
  row.min_h         = source.shortest_edge();
  row.max_phi       = step.largest_phase;
  row.elastic       = memory_.energies.elastic();
  row.kinetic       = memory_.energies.kinetic;
  row.fracture      = memory_.energies.fracture;
  row.constraint    = memory_.energies.constraint;
  row.external_work = balance_.external_work();
  row.irreversible  = balance_.irreversible();
  row.balance       = balance_.balance();
  row.wall          = wall_seconds();

  row.active               = memory_.energies.active;
  row.passive              = memory_.energies.passive;
  row.membrane             = memory_.energies.membrane();
  row.bending              = memory_.energies.bending;
  row.support_work         = balance_.work().supports;
  row.load_work            = balance_.work().of_loads();
  row.dissipation          = balance_.dissipation();
  row.inertial_dissipation = balance_.inertial_dissipation();
  row.refinement           = balance_.refinement();
  row.closure              = balance_.closure();
  row.diffuse_length       = memory_.energies.diffuse_length;
  row.fastest_tip          = -1;
  row.error                = step.error;

  std::vector<Point<spacedim>> reactions;
  for (const auto &edge : settings_.edges)
    reactions.push_back(source.reaction(edge));
  const auto all = snapshot(state);
  {
    const auto tracking = source.timers().measure("tracker");
    on_root(env_.comm(), [&] { files_->tracker.update(space.surface(), all.phase, state.time); });
  }
  on_root(env_.comm(), [&] {
    row.crack_length   = files_->tracker.length();
    row.tips           = files_->tracker.tree().n_active();
    const auto fastest = files_->tracker.tree().fastest();
    row.tip_speed      = fastest ? fastest->speed : 0.;
    row.fastest_tip    = fastest ? fastest->id : -1;
    files_->history.append(row);
    files_->work.append(work_row(row));
    files_->tips.append(state.step, state.time, files_->tracker);
    files_->probes.append(space.surface(), all, reactions);
    for (const auto &message : step.messages)
      std::cout << "  " << message << '\n';
    files_->progress.report({row.step, row.time, row.dt, row.newton, row.dofs, row.crack_length});
  });
  memory_.last = row;
  if (row.elastic > memory_.largest_elastic)
    {
      memory_.largest_elastic      = row.elastic;
      memory_.largest_elastic_time = row.time;
    }
  memory_.largest_imbalance = std::max(memory_.largest_imbalance, std::abs(row.balance));
}

template <int degree, int spacedim>
void RunRecorder<degree, spacedim>::write_frame(Source &source, const SpaceType &space, const StateType &state)
{
  const auto timing = source.timers().measure("output");

  // Energy densities of the elements a rank owns, brought together by their numbers.
  struct Entry
  {
    int    element;
    double elastic, fracture;
  };
  const auto        &d         = space.distribution();
  const auto         densities = source.densities(state);
  std::vector<Entry> entries;
  for (int e = 0; e < space.n_active_elements(); ++e)
    if (d.owns[e])
      entries.push_back({d.elements[e], densities[entries.size()].elastic, densities[entries.size()].fracture});
  entries = all_gather(env_.comm(), entries);

  const auto all = snapshot(state);
  on_root(env_.comm(), [&] {
    std::vector<ElementField> fields{{"elastic energy", std::vector<double>(entries.size())},
                                     {"fracture energy", std::vector<double>(entries.size())},
                                     {"rank", {d.element_owner.begin(), d.element_owner.end()}}};
    for (const auto &entry : entries)
      {
        fields[0].values[entry.element] = entry.elastic;
        fields[1].values[entry.element] = entry.fracture;
      }
    files_->frames.write(space.surface(), all, fields);
    files_->fields.write(space.surface(), all);
  });
}

template <int degree, int spacedim>
void RunRecorder<degree, spacedim>::finish(Source &source, const std::string &ending)
{
  const auto  seconds = phase_seconds(source);
  const auto &last    = memory_.last;
  const auto &totals  = memory_.totals;
  // Meshes only grow: the last one is the largest.
  const auto profile = make_profile(env_.comm(), source.timers(), env_.elapsed_seconds(), last.dofs);
  on_root(env_.comm(), [&] {
    JsonObject wall;
    for (const auto &[phase, value] : seconds)
      wall.add(phase, value);
    wall.add("total", wall_seconds());

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
                                         .add("time", last.time)
                                         .add("final", JsonObject()
                                                           .add("elements", last.elements)
                                                           .add("dofs", last.dofs)
                                                           .add("elastic", last.elastic)
                                                           .add("kinetic", last.kinetic)
                                                           .add("fracture", last.fracture)
                                                           .add("external_work", last.external_work)
                                                           .add("irreversible", last.irreversible)
                                                           .add("balance", last.balance)
                                                           .add("dissipation", last.dissipation)
                                                           .add("closure", last.closure)
                                                           .add("crack_length", last.crack_length))
                                         .add("extreme", JsonObject()
                                                             .add("elastic", memory_.largest_elastic)
                                                             .add("elastic_at", memory_.largest_elastic_time)
                                                             .add("balance", memory_.largest_imbalance))
                                         .add("totals", JsonObject()
                                                            .add("steps", totals.steps)
                                                            .add("attempts", totals.attempts)
                                                            .add("rejected", totals.rejected)
                                                            .add("repeated", totals.repeated)
                                                            .add("switched", totals.switched)
                                                            .add("refined", totals.refined)
                                                            .add("newton", totals.newton)
                                                            .add("linear", totals.linear))
                                         .add("wall_seconds", wall)
                                         .add("memory", JsonObject()
                                                            .add("peak_bytes", profile.memory.sum)
                                                            .add("largest_rank", profile.memory.largest)
                                                            .add("per_unknown", profile.bytes_per_unknown()))
                                         .add("ranks", profile.n_ranks)
                                         .add("threads", profile.n_threads)
                                         .add("branched_at", branchings)
                                         .add("tips", tips));
    if (env_.command_line().profile)
      std::cout << table(profile) << std::flush;
  });
}

template <int degree, int spacedim>
std::map<std::string, double> RunRecorder<degree, spacedim>::phase_seconds(Source &source) const
{
  auto seconds = source.timers().maximum(env_.comm());
  for (const auto &[phase, earlier] : memory_.phase_seconds)
    seconds[phase] += earlier;
  return seconds;
}

template <int degree, int spacedim>
RecorderMemory RunRecorder<degree, spacedim>::memory(Source &source) const
{
  auto result          = memory_;
  result.balance       = balance_.state();
  result.wall_seconds  = wall_seconds();
  result.phase_seconds = phase_seconds(source);
  if (files_)
    result.cracks = files_->tracker.tree().state();
  return result;
}

} // namespace sherd
