#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <vector>

#include <sherd/geometry/surface.h>

namespace sherd::internal
{

/// Functions of the first row of a side by knots, and the mesh lines that can split such functions. Depths are
/// distances from the side, in the parameter across it.
template <int degree>
class FirstRow
{
public:
  /// A function of the first row: its only span that is not empty, [0, depth], and its knots along the side.
  struct Key
  {
    double             depth;
    LocalKnots<degree> along;

    auto operator<=>(const Key &) const = default;
  };

  FirstRow(const LRBasis<degree> &basis, Side side)
  {
    const int  normal = normal_direction(side);
    const bool at_max = at_maximum(side);
    border_           = at_max ? basis.domain().max[normal] : basis.domain().min[normal];
    for (const auto &line : basis.mesh_lines())
      if (static_cast<int>(line.direction) != normal)
        {
          if ((at_max ? line.end : line.start) == border_)
            across_.push_back({line.value, depth(at_max ? line.start : line.end), line.multiplicity});
        }
      else if (line.value != border_)
        along_.push_back({depth(line.value), line.start, line.end});
    std::sort(across_.begin(), across_.end(), [](const Across &a, const Across &b) { return a.value < b.value; });
    std::sort(along_.begin(), along_.end(), [](const Along &a, const Along &b) { return a.depth < b.depth; });
  }

  double depth(double value) const { return std::abs(value - border_); }

  /// The B-spline @p key as a sum of the minimal ones of the mesh, by knot insertion; parts that vanish on the side are
  /// left out.  theory H.2
  std::map<Key, double> split(const Key &key) const
  {
    std::map<Key, double> work{{key, 1.}}, result;
    KnotInsertion         insertion;
    while (!work.empty())
      {
        Key          part   = work.begin()->first;
        const double factor = work.begin()->second;
        work.erase(work.begin());
        part.depth          = least_depth(part);
        const auto inserted = missing_knots(part);
        if (inserted.empty())
          {
            result[part] += factor;
            continue;
          }
        insert_knots<degree>(part.along, inserted, insertion);
        for (std::size_t k = 0; k < insertion.weights.size(); ++k)
          {
            Key child{part.depth, {}};
            std::copy_n(insertion.knots.begin() + k, degree + 2, child.along.begin());
            work[child] += factor * insertion.weights[k];
          }
      }
    return result;
  }

private:
  struct Across
  {
    double value, depth;
    int    multiplicity;
  };
  struct Along
  {
    double depth, start, end;
  };

  /// First span after all lines parallel to the side that run across the whole support.
  double least_depth(const Key &key) const
  {
    for (const auto &line : along_)
      if (line.depth < key.depth && line.start <= key.along.front() && key.along.back() <= line.end)
        return line.depth;
    return key.depth;
  }

  /// Knots to insert: lines that reach across the whole support with a multiplicity above that in the knots.
  std::vector<double> missing_knots(const Key &key) const
  {
    std::vector<double> missing;
    const auto          first = std::upper_bound(across_.begin(), across_.end(), key.along.front(),
                                                 [](double value, const Across &line) { return value < line.value; });
    for (auto line = first; line != across_.end() && line->value < key.along.back();)
      {
        const double value        = line->value;
        int          multiplicity = 0;
        for (; line != across_.end() && line->value == value; ++line)
          if (line->depth >= key.depth)
            multiplicity = std::max(multiplicity, line->multiplicity);
        for (auto m = std::count(key.along.begin(), key.along.end(), value); m < multiplicity; ++m)
          missing.push_back(value);
      }
    return missing;
  }

  double              border_;
  std::vector<Across> across_; ///< lines that start at the side
  std::vector<Along>  along_;  ///< lines parallel to it
};

} // namespace sherd::internal
