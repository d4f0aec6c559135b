#include <sherd/output/tips_table.h>

namespace sherd
{
namespace
{

const std::vector<std::string> columns = {"step", "time", "tip",    "parent", "x",
                                          "y",    "z",    "length", "speed",  "speed_over_cR"};

} // namespace

TipsTable::TipsTable(const std::filesystem::path &directory) : table_(directory / "tips.csv", columns) {}

TipsTable::TipsTable(CsvTable table) : table_(std::move(table)) {}

TipsTable TipsTable::resume(const std::filesystem::path &directory, double time)
{
  return TipsTable(CsvTable::resume(directory / "tips.csv", columns, time));
}

void TipsTable::append(int step, double time, const CrackTracker &tracker)
{
  for (const auto &tip : tracker.tree().tips())
    if (tip.active)
      table_.append(CsvRow() << step << time << tip.id << tip.parent << tip.X[0] << tip.X[1] << tip.X[2] << tip.length
                             << tip.speed << tip.speed / tracker.options().rayleigh_speed);
}

} // namespace sherd
