#include <sherd/geometry/interface.h>

#include <algorithm>
#include <cmath>

#include <sherd/base/print.h>

namespace sherd
{

std::string describe(const Edge &edge)
{
  const char *const names[] = {"u_min", "u_max", "v_min", "v_max"};
  return std::string("side ") + names[static_cast<int>(edge.side)] + " of patch " + std::to_string(edge.patch);
}

namespace internal
{

SideRuler::SideRuler(const std::vector<double> &initial_knots, bool reversed)
    : knots_(initial_knots), reversed_(reversed)
{
  knots_.erase(std::unique(knots_.begin(), knots_.end()), knots_.end());
}

SideRuler::Mark SideRuler::mark(double parameter) const
{
  const auto   n_spans = static_cast<Mark>(knots_.size()) - 1;
  const auto   upper   = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, parameter);
  const double low = *(upper - 1), high = *upper;
  const double place   = (parameter - low) / (high - low) * static_cast<double>(unit);
  const double nearest = std::round(place);
  if (std::abs(place - nearest) > .05)
    throw InvalidParameter("interface: knot " + print(parameter) + " between the initial knots " + print(low) +
                           " and " + print(high) +
                           " is not reached by halving their span, as sides that are joined need");
  const Mark mark = (upper - knots_.begin() - 1) * unit + static_cast<Mark>(nearest);
  return reversed_ ? n_spans * unit - mark : mark;
}

double SideRuler::parameter(Mark mark) const
{
  const auto n_spans = static_cast<Mark>(knots_.size()) - 1;
  if (reversed_)
    mark = n_spans * unit - mark;
  const auto span   = mark / unit;
  const Mark inside = mark % unit;
  if (inside == 0)
    return knots_[span];
  Mark   below = 0, above = unit;
  double low = knots_[span], high = knots_[span + 1];
  for (;;)
    {
      const Mark   middle = (below + above) / 2;
      const double value  = .5 * (low + high);
      if (middle == inside)
        return value;
      (middle < inside ? below : above) = middle;
      (middle < inside ? low : high)    = value;
    }
}

template <int degree>
std::vector<SideFunction<degree>> side_functions(const LRBasis<degree> &basis, Side side, bool reversed)
{
  const int       normal = normal_direction(side), along = 1 - normal;
  const double    border = at_maximum(side) ? basis.domain().max[normal] : basis.domain().min[normal];
  const SideRuler ruler(basis.initial_knots()[along], reversed);

  std::vector<SideFunction<degree>> result;
  for (int i = 0; i < basis.n_functions(); ++i)
    {
      // All knots but one lie on the side.
      const auto &across = basis.function(i).knots[normal];
      if (across[1] != border || across[degree] != border || (across.front() != border && across.back() != border))
        continue;
      SideFunction<degree> function{{}, i};
      for (int k = 0; k < degree + 2; ++k)
        function.marks[k] = ruler.mark(basis.function(i).knots[along][k]);
      if (reversed)
        std::reverse(function.marks.begin(), function.marks.end());
      result.push_back(function);
    }
  std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) { return a.marks < b.marks; });
  return result;
}

namespace
{

using Mark = SideRuler::Mark;

/// A knot of some function on a side, with the largest multiplicity it has in one.
struct SideKnot
{
  Mark mark;
  int  multiplicity;
};

template <int degree>
std::vector<SideKnot> side_knots(const std::vector<SideFunction<degree>> &functions)
{
  std::vector<SideKnot> all;
  for (const auto &function : functions)
    for (auto k = function.marks.begin(); k != function.marks.end();)
      {
        const auto next = std::upper_bound(k, function.marks.end(), *k);
        all.push_back({*k, static_cast<int>(next - k)});
        k = next;
      }
  std::sort(all.begin(), all.end(), [](const SideKnot &a, const SideKnot &b) {
    return a.mark != b.mark ? a.mark < b.mark : a.multiplicity > b.multiplicity;
  });
  all.erase(std::unique(all.begin(), all.end(), [](const SideKnot &a, const SideKnot &b) { return a.mark == b.mark; }),
            all.end());
  return all;
}

auto lower_bound(const std::vector<SideKnot> &knots, Mark mark)
{
  return std::lower_bound(knots.begin(), knots.end(), mark,
                          [](const SideKnot &knot, Mark value) { return knot.mark < value; });
}

/// Knots inside the support of a function that it has not, or with a smaller multiplicity.
template <int degree>
std::vector<SideKnot> missing_knots(const SideFunction<degree> &function, const std::vector<SideKnot> &knots)
{
  const auto           &marks = function.marks;
  std::vector<SideKnot> missing;
  for (auto k = lower_bound(knots, marks.front() + 1); k != knots.end() && k->mark < marks.back(); ++k)
    if (std::count(marks.begin(), marks.end(), k->mark) < k->multiplicity)
      missing.push_back(*k);
  return missing;
}

template <int degree>
bool contains(const std::vector<SideFunction<degree>> &functions, const SideFunction<degree> &function)
{
  const auto found = std::lower_bound(functions.begin(), functions.end(), function,
                                      [](const auto &a, const auto &b) { return a.marks < b.marks; });
  return found != functions.end() && found->marks == function.marks;
}

} // namespace

template <int degree>
std::vector<MeshLine> closing_lines(const LRBasis<degree> &basis, const Edge &edge, const SideRuler &ruler,
                                    const std::vector<SideFunction<degree>> &own,
                                    const std::vector<SideFunction<degree>> &other, const SpanTarget &target)
{
  const int normal = normal_direction(edge.side), along = 1 - normal;

  const auto has_midpoints = [&](const SideFunction<degree> &function, const std::vector<SideKnot> &knots) {
    const auto &values = basis.function(function.index).knots[along];
    for (int k = 0; k <= degree; ++k)
      if (values[k + 1] - values[k] > target.length[along] * (1. + 1e-10))
        {
          const Mark middle = (ruler.mark(values[k]) + ruler.mark(values[k + 1])) / 2;
          const auto found  = lower_bound(knots, middle);
          if (found == knots.end() || found->mark != middle)
            return false;
        }
    return true;
  };
  std::vector<MeshLine> lines;
  const auto            add_knots = [&](const SideFunction<degree> &function, const std::vector<SideKnot> &missing) {
    const Box support = basis.function(function.index).support();
    for (const auto &knot : missing)
      lines.push_back({static_cast<Direction>(along), ruler.parameter(knot.mark), support.min[normal],
                       support.max[normal], knot.multiplicity});
  };

  const auto                                                          knots = side_knots(other);
  std::vector<std::pair<SideFunction<degree>, std::vector<SideKnot>>> incomplete;
  std::vector<int>                                                    halved;
  bool                                                                equal = own.size() == other.size();
  for (const auto &function : own)
    if (!contains(other, function))
      {
        equal              = false;
        const auto missing = missing_knots(function, knots);
        if (missing.empty())
          continue;
        if (has_midpoints(function, knots))
          {
            halved.push_back(function.index);
            add_knots(function, missing);
          }
        else
          incomplete.emplace_back(function, missing);
      }
  if (equal)
    return {};
  if (halved.empty())
    for (const auto &[function, missing] : incomplete)
      add_knots(function, missing);
  const auto midlines = structured_mesh_lines(basis, halved, target);
  lines.insert(lines.end(), midlines.begin(), midlines.end());
  return lines;
}

template std::vector<SideFunction<2>> side_functions(const LRBasis<2> &, Side, bool);
template std::vector<SideFunction<3>> side_functions(const LRBasis<3> &, Side, bool);
template std::vector<SideFunction<4>> side_functions(const LRBasis<4> &, Side, bool);
template std::vector<MeshLine>        closing_lines(const LRBasis<2> &, const Edge &, const SideRuler &,
                                                    const std::vector<SideFunction<2>> &, const std::vector<SideFunction<2>> &,
                                                    const SpanTarget &);
template std::vector<MeshLine>        closing_lines(const LRBasis<3> &, const Edge &, const SideRuler &,
                                                    const std::vector<SideFunction<3>> &, const std::vector<SideFunction<3>> &,
                                                    const SpanTarget &);
template std::vector<MeshLine>        closing_lines(const LRBasis<4> &, const Edge &, const SideRuler &,
                                                    const std::vector<SideFunction<4>> &, const std::vector<SideFunction<4>> &,
                                                    const SpanTarget &);

} // namespace internal

} // namespace sherd
