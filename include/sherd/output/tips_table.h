#pragma once

#include <sherd/output/crack_tracker.h>
#include <sherd/output/csv_table.h>

namespace sherd
{

/// tips.csv: a row for every active crack tip in every accepted step,
/// `step,time,tip,parent,x,y,z,length,speed,speed_over_cR`.  theory L
///
/// Positions on the reference surface, z = 0 in the plane; parent -1: not from a branching.
class TipsTable
{
public:
  explicit TipsTable(const std::filesystem::path &directory);

  /// Goes on with the rows up to @p time (CsvTable::resume).
  static TipsTable resume(const std::filesystem::path &directory, double time);

  /// Writes the tips of the step the tracker has seen last.
  void append(int step, double time, const CrackTracker &tracker);

private:
  explicit TipsTable(CsvTable table);

  CsvTable table_;
};

} // namespace sherd
