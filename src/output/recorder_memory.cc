#include <sherd/output/recorder_memory.h>

#include <type_traits>

namespace sherd
{
namespace
{

template <class Archive>
void exchange(Archive archive, Energies &energies)
{
  archive("active", energies.active);
  archive("passive", energies.passive);
  archive("kinetic", energies.kinetic);
  archive("fracture", energies.fracture);
  archive("constraint", energies.constraint);
  archive("bending", energies.bending);
  archive("diffuse_length", energies.diffuse_length);
}

template <class Archive>
void exchange(Archive archive, ExternalWork &work)
{
  archive("supports", work.supports);
  archive("loads", work.loads);
}

template <class Archive>
void exchange(Archive archive, EnergyBalance::State &balance)
{
  archive("initial", balance.initial);
  exchange(archive.in("now"), balance.now);
  exchange(archive.in("work"), balance.work);
  archive("irreversible", balance.irreversible);
  archive("dissipation", balance.dissipation);
  archive("inertial_dissipation", balance.inertial_dissipation);
  archive("refinement", balance.refinement);
  archive("largest", balance.largest);
}

template <class Archive>
void exchange(Archive archive, RunTotals &totals)
{
  archive("steps", totals.steps);
  archive("attempts", totals.attempts);
  archive("rejected", totals.rejected);
  archive("repeated", totals.repeated);
  archive("switched", totals.switched);
  archive("refined", totals.refined);
  archive("newton", totals.newton);
  archive("linear", totals.linear);
}

template <class Archive>
void exchange(Archive archive, HistoryRow &row)
{
  archive("step", row.step);
  archive("time", row.time);
  archive("dt", row.dt);
  archive("newton", row.newton);
  archive("linear", row.linear);
  archive("rejected", row.rejected);
  archive("switched", row.switched);
  archive("elements", row.elements);
  archive("dofs", row.dofs);
  archive("min_h", row.min_h);
  archive("max_phi", row.max_phi);
  archive("elastic", row.elastic);
  archive("kinetic", row.kinetic);
  archive("fracture", row.fracture);
  archive("external_work", row.external_work);
  archive("constraint", row.constraint);
  archive("irreversible", row.irreversible);
  archive("balance", row.balance);
  archive("crack_length", row.crack_length);
  archive("tips", row.tips);
  archive("tip_speed", row.tip_speed);
  archive("wall", row.wall);
  archive("active", row.active);
  archive("passive", row.passive);
  archive("membrane", row.membrane);
  archive("bending", row.bending);
  archive("support_work", row.support_work);
  archive("load_work", row.load_work);
  archive("dissipation", row.dissipation);
  archive("inertial_dissipation", row.inertial_dissipation);
  archive("refinement", row.refinement);
  archive("diffuse_length", row.diffuse_length);
  archive("fastest_tip", row.fastest_tip);
  archive("closure", row.closure);
  archive("error", row.error);
}

template <class Archive>
void exchange(Archive archive, std::map<std::string, double> &seconds)
{
  std::string         names;
  std::vector<double> values;
  for (const auto &[name, value] : seconds)
    {
      names += name + '\n';
      values.push_back(value);
    }
  archive("names", names);
  archive("seconds", values);
  seconds.clear();
  std::size_t begin = 0;
  for (const double value : values)
    {
      const auto end = names.find('\n', begin);
      if (end == names.npos)
        throw FileError("the phases of the timers have fewer names than seconds");
      seconds[names.substr(begin, end - begin)] = value;
      begin                                     = end + 1;
    }
}

/// One member of all items as an array. @param member   gives a reference to it
template <class Archive, class Item, class Member>
void column(Archive &archive, const std::string &name, std::vector<Item> &items, Member member)
{
  using Found = std::remove_reference_t<decltype(member(items.front()))>;
  using Value = std::conditional_t<std::is_floating_point_v<Found>, double, int>;
  std::vector<Value> values;
  for (auto &item : items)
    values.push_back(member(item));
  archive(name, values);
  if (values.size() != items.size())
    throw FileError(name + " has " + std::to_string(values.size()) + " entries, expected " +
                    std::to_string(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i)
    member(items[i]) = static_cast<Found>(values[i]);
}

/// Positions as three columns.
template <class Archive, class Item, class Member>
void position_columns(Archive &archive, const std::string &name, std::vector<Item> &items, Member member)
{
  for (int d = 0; d < 3; ++d)
    column(archive, name + "_" + "xyz"[d], items, [&](Item &item) -> double & { return member(item)[d]; });
}

template <class Archive, class Item>
void exchange_size(Archive &archive, std::vector<Item> &items)
{
  int n = static_cast<int>(items.size());
  archive("n", n);
  items.resize(n);
}

template <class Archive>
void exchange(Archive archive, std::vector<CrackTip> &tips)
{
  exchange_size(archive, tips);
  column(archive, "id", tips, [](CrackTip &tip) -> int & { return tip.id; });
  column(archive, "parent", tips, [](CrackTip &tip) -> int & { return tip.parent; });
  column(archive, "active", tips, [](CrackTip &tip) -> bool & { return tip.active; });
  position_columns(archive, "X", tips, [](CrackTip &tip) -> Eigen::Vector3d & { return tip.X; });
  position_columns(archive, "anchor", tips, [](CrackTip &tip) -> Eigen::Vector3d & { return tip.anchor; });
  column(archive, "length", tips, [](CrackTip &tip) -> double & { return tip.length; });
  column(archive, "speed", tips, [](CrackTip &tip) -> double & { return tip.speed; });

  std::vector<int>              counts;
  std::vector<CrackTip::Record> recent;
  for (const auto &tip : tips)
    {
      counts.push_back(static_cast<int>(tip.recent.size()));
      recent.insert(recent.end(), tip.recent.begin(), tip.recent.end());
    }
  archive("n_recent", counts);
  auto records = archive.in("recent");
  exchange_size(records, recent);
  column(records, "time", recent, [](CrackTip::Record &record) -> double & { return record.time; });
  column(records, "length", recent, [](CrackTip::Record &record) -> double & { return record.length; });
  std::size_t begin = 0;
  for (std::size_t i = 0; i < tips.size(); ++i)
    {
      if (counts.size() != tips.size() || counts[i] < 0 || begin + counts[i] > recent.size())
        throw FileError("the recent lengths of the crack tips do not fit the tips");
      tips[i].recent.assign(recent.begin() + begin, recent.begin() + begin + counts[i]);
      begin += counts[i];
    }
}

template <class Archive>
void exchange(Archive archive, std::vector<Branching> &branchings)
{
  exchange_size(archive, branchings);
  column(archive, "time", branchings, [](Branching &branching) -> double & { return branching.time; });
  position_columns(archive, "X", branchings, [](Branching &branching) -> Eigen::Vector3d & { return branching.X; });
  column(archive, "parent", branchings, [](Branching &branching) -> int & { return branching.parent; });
  column(archive, "child", branchings, [](Branching &branching) -> int & { return branching.child; });
}

template <class Archive>
void exchange(Archive archive, CrackTree::State &cracks)
{
  std::vector<double> time;
  if (cracks.time)
    time.push_back(*cracks.time);
  archive("time", time);
  cracks.time = time.empty() ? std::nullopt : std::optional(time.front());
  exchange(archive.in("tips"), cracks.tips);
  exchange(archive.in("branchings"), cracks.branchings);
}

template <class Archive>
void exchange(Archive archive, RecorderMemory &memory)
{
  exchange(archive.in("balance"), memory.balance);
  exchange(archive.in("energies"), memory.energies);
  exchange(archive.in("totals"), memory.totals);
  exchange(archive.in("last"), memory.last);
  archive("largest_elastic", memory.largest_elastic);
  archive("largest_elastic_time", memory.largest_elastic_time);
  archive("largest_imbalance", memory.largest_imbalance);
  archive("n_frames", memory.n_frames);
  archive("wall_seconds", memory.wall_seconds);
  exchange(archive.in("phases"), memory.phase_seconds);
  exchange(archive.in("cracks"), memory.cracks);
}

} // namespace

void put(ArrayWriter archive, const RecorderMemory &memory)
{
  auto copy = memory;
  exchange(archive, copy);
}

RecorderMemory get_recorder_memory(ArrayReader archive)
{
  RecorderMemory memory;
  exchange(archive, memory);
  return memory;
}

} // namespace sherd
