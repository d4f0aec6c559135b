#pragma once

#include <sherd/base/print.h>
#include <sherd/verify/derivative.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace sherd::verify
{

/// What was checked of one policy, with figures. Tests ask passed(), people read the text:
///
///   const auto report = verify::split(my_split);
///   INFO(report);
///   CHECK(report.passed());
class Report
{
public:
  struct Entry
  {
    std::string name;
    double      defect, tolerance; ///< worst defect found and largest allowed
    double      order;             ///< worst observed order of a derivative; infinite for all else
    std::string where;             ///< of the worst defect

    /// False for NaN, too.
    bool passed() const { return defect <= tolerance && order > DerivativeCheck::required_order; }
  };

  /// Adds the comparison of a derivative with its difference quotients.
  void add(const std::string &name, const DerivativeCheck &check, const std::string &where = "")
  {
    add(name, check.smallest_defect, DerivativeCheck::allowed_defect, where, check.order);
  }

  /// Adds a quantity >= 0 that should vanish up to the tolerance. Of entries with one name the worst is kept: one that
  /// fails before one that holds, then the larger defect.
  /// @param where  says which sample it is.
  void add(const std::string &name, const double defect, const double tolerance, const std::string &where = "",
           const double order = std::numeric_limits<double>::infinity())
  {
    const Entry entry{name, defect, tolerance, order, where};
    const auto  same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry &e) { return e.name == name; });
    if (same == entries_.end())
      entries_.push_back(entry);
    else
      {
        const bool is_worse = same->passed() ? !entry.passed() || defect > same->defect
                                             : !entry.passed() && (std::isnan(defect) || defect > same->defect);
        if (is_worse)
          same->where = where;
        if (std::isnan(defect) || defect > same->defect)
          same->defect = defect;
        if (std::isnan(order) || order < same->order)
          same->order = order;
      }
  }

  const std::vector<Entry> &entries() const { return entries_; }

  /// Whether something was checked and all of it held.
  bool passed() const
  {
    return !entries_.empty() &&
           std::all_of(entries_.begin(), entries_.end(), [](const Entry &e) { return e.passed(); });
  }

private:
  std::vector<Entry> entries_;
};

/// The verdict in one line, then one line an entry: name, defect, tolerance, order of a derivative, and the worst
/// sample of what is wrong.
inline std::ostream &operator<<(std::ostream &out, const Report &report)
{
  const auto n       = report.entries().size();
  const auto n_wrong = std::count_if(report.entries().begin(), report.entries().end(),
                                     [](const Report::Entry &entry) { return !entry.passed(); });
  if (n == 0)
    out << "nothing was checked\n";
  else if (n_wrong > 0)
    out << n_wrong << " of " << n << " checks failed\n";
  else
    out << "all " << n << " checks hold\n";
  for (const auto &entry : report.entries())
    {
      out << (entry.passed() ? "  ok    " : "  WRONG ") << entry.name << ": defect " << print(entry.defect)
          << " (allowed " << print(entry.tolerance) << ')';
      if (!std::isinf(entry.order))
        out << ", order " << print(entry.order) << " (2 where right)";
      if (!entry.passed() && !entry.where.empty())
        out << ", worst at " << entry.where;
      out << '\n';
    }
  return out;
}

} // namespace sherd::verify
