#include <sherd/output/history.h>

namespace sherd
{

const std::vector<std::string> &History::columns()
{
  static const std::vector<std::string> names = {"step",         "time",         "dt",
                                                 "newton",       "linear",       "rejected",
                                                 "switched",     "elements",     "dofs",
                                                 "min_h",        "max_phi",      "elastic",
                                                 "kinetic",      "fracture",     "external_work",
                                                 "constraint",   "irreversible", "balance",
                                                 "crack_length", "tips",         "tip_speed",
                                                 "wall",         "active",       "passive",
                                                 "membrane",     "bending",      "support_work",
                                                 "load_work",    "dissipation",  "inertial_dissipation",
                                                 "refinement",   "closure",      "diffuse_length",
                                                 "fastest_tip",  "error"};
  return names;
}

History::History(const std::filesystem::path &directory) : table_(directory / "history.csv", columns()) {}

History::History(CsvTable table) : table_(std::move(table)) {}

History History::resume(const std::filesystem::path &directory, double time)
{
  return History(CsvTable::resume(directory / "history.csv", columns(), time));
}

void History::append(const HistoryRow &row)
{
  table_.append(CsvRow() << row.step << row.time << row.dt << row.newton << row.linear << row.rejected << row.switched
                         << row.elements << row.dofs << row.min_h << row.max_phi << row.elastic << row.kinetic
                         << row.fracture << row.external_work << row.constraint << row.irreversible << row.balance
                         << row.crack_length << row.tips << row.tip_speed << row.wall << row.active << row.passive
                         << row.membrane << row.bending << row.support_work << row.load_work << row.dissipation
                         << row.inertial_dissipation << row.refinement << row.closure << row.diffuse_length
                         << row.fastest_tip << row.error);
}

} // namespace sherd
