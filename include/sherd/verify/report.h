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

/// What was checked of one policy, with figures. Tests ask passed(), people read the text.
class Report
{
public:
  struct Entry
  {
    std::string name;
    double      defect, tolerance; ///< worst defect found and largest allowed
    double      order;             ///< worst observed order of a derivative; infinite for all else

    /// False for NaN, too.
    bool passed() const { return defect <= tolerance && order > DerivativeCheck::required_order; }
  };

  /// Adds the comparison of a derivative with its difference quotients.
  void add(const std::string &name, const DerivativeCheck &check)
  {
    add(name, check.smallest_defect, DerivativeCheck::allowed_defect, check.order);
  }

  /// Adds a quantity >= 0 that should vanish up to the tolerance. Of entries with one name the worst is kept.
  void add(const std::string &name, const double defect, const double tolerance,
           const double order = std::numeric_limits<double>::infinity())
  {
    const auto same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry &e) { return e.name == name; });
    if (same == entries_.end())
      entries_.push_back({name, defect, tolerance, order});
    else
      {
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

/// One line an entry: verdict, name, defect, tolerance, order.
inline std::ostream &operator<<(std::ostream &out, const Report &report)
{
  for (const auto &entry : report.entries())
    out << (entry.passed() ? "  ok    " : "  WRONG ") << entry.name << ": defect " << print(entry.defect)
        << " (allowed " << print(entry.tolerance) << "), order " << print(entry.order) << '\n';
  return out;
}

} // namespace sherd::verify
