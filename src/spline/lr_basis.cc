#include <sherd/spline/lr_basis.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <sherd/base/exceptions.h>
#include <sherd/spline/evaluation.h>

#include "function_splitter.h"

namespace sherd
{

namespace
{

std::string text(double x)
{
  return std::to_string(x);
}

/// Negative zero becomes zero: knots are hashed by their bits.
void normalise(double &x)
{
  x += 0.;
}

std::vector<double> checked(std::vector<double> knots, const char *direction, int degree)
{
  const std::string where = std::string("knots along ") + direction + ": ";
  if (!std::all_of(knots.begin(), knots.end(), [](double x) { return std::isfinite(x); }))
    throw InvalidParameter(where + "all knots must be finite");
  if (!std::is_sorted(knots.begin(), knots.end()))
    throw InvalidParameter(where + "knots must ascend");
  std::for_each(knots.begin(), knots.end(), normalise);
  for (auto k = knots.begin(); k != knots.end();)
    {
      const auto next    = std::upper_bound(k, knots.end(), *k);
      const bool is_end  = k == knots.begin() || next == knots.end();
      const auto n_times = next - k;
      if (is_end ? n_times != degree + 1 : n_times > degree)
        throw InvalidParameter(where + "knot " + text(*k) + " is given " + std::to_string(n_times) +
                               " times; at degree " + std::to_string(degree) + " the first and the last are wanted " +
                               std::to_string(degree + 1) + " times, others at most " + std::to_string(degree) +
                               " times");
      k = next;
    }
  if (knots.empty() || knots.front() == knots.back())
    throw InvalidParameter(where + "at least two different knots are wanted");
  return knots;
}

/// Rows of the transfer from the shares of each function.
class TransferRows
{
public:
  void reserve(std::size_t n)
  {
    transfer.offsets.reserve(n + 1);
    transfer.columns.reserve(2 * n);
    transfer.values.reserve(2 * n);
  }

  void add_unchanged(int old)
  {
    transfer.columns.push_back(old);
    transfer.values.push_back(1.);
    transfer.offsets.push_back(static_cast<int>(transfer.columns.size()));
  }

  /// Adds the row s_j / gamma, gamma = sum_j s_j; returns gamma.
  template <class Share>
  double add_shares(const std::vector<Share> &shares, int first)
  {
    row_.clear();
    for (int s = first; s >= 0; s = shares[s].next)
      row_.emplace_back(shares[s].old, shares[s].value);
    std::sort(row_.begin(), row_.end());
    double gamma = 0.;
    for (const auto &[old, share] : row_)
      gamma += share;
    for (const auto &[old, share] : row_)
      {
        transfer.columns.push_back(old);
        transfer.values.push_back(share / gamma);
      }
    transfer.offsets.push_back(static_cast<int>(transfer.columns.size()));
    return gamma;
  }

  SparseTransfer transfer{{0}, {}, {}};

private:
  std::vector<std::pair<int, double>> row_;
};

std::vector<int> touched_elements(const ElementTree &tree, const std::vector<MeshLine> &lines)
{
  std::vector<int> touched;
  for (const auto &line : lines)
    tree.append_touching(line, touched);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

/// Splits all functions on the given elements that are crossed; returns the entry of each function, -1 if it has none.
template <int degree>
std::vector<int> split_crossed_functions(const LRBasis<degree> &basis, const std::vector<int> &elements,
                                         internal::FunctionSplitter<degree> &splitter)
{
  std::vector<char> seen(basis.n_functions(), 0);
  std::vector<int>  crossed, queue, entry_of(basis.n_functions(), -1);
  for (const int e : elements)
    for (const int i : basis.functions_of(e))
      if (!std::exchange(seen[i], 1) && splitter.is_crossed(basis.function(i)))
        crossed.push_back(i);

  const auto enter = [&](int i) {
    if (entry_of[i] < 0)
      entry_of[i] = splitter.add_old(i, basis.function(i));
    return entry_of[i];
  };
  for (const int i : crossed)
    queue.push_back(enter(i));
  // Parts of a function may equal old functions inside its support: those share an element with it.
  for (const int i : crossed)
    for (const int e : basis.elements_of(i))
      for (const int other : basis.functions_of(e))
        if (contains(basis.function(i).support(), basis.function(other).support()))
          enter(other);
  splitter.run(std::move(queue));
  return entry_of;
}

} // namespace

template <int degree>
LRBasis<degree>::LRBasis(std::vector<double> knots_u, std::vector<double> knots_v)
    : initial_knots_{checked(std::move(knots_u), "u", degree), checked(std::move(knots_v), "v", degree)},
      domain_{{initial_knots_[0].front(), initial_knots_[1].front()},
              {initial_knots_[0].back(), initial_knots_[1].back()}},
      mesh_(initial_knots_[0], initial_knots_[1]),
      tree_(initial_knots_[0], initial_knots_[1]),
      mesh_lines_(mesh_.lines())
{
  const auto &[u, v] = initial_knots_;
  for (std::size_t j = 0; j + degree + 1 < v.size(); ++j)
    for (std::size_t i = 0; i + degree + 1 < u.size(); ++i)
      {
        LRFunction<degree> function{.knots = {}, .gamma = 1.};
        std::copy_n(u.begin() + i, degree + 2, function.knots[0].begin());
        std::copy_n(v.begin() + j, degree + 2, function.knots[1].begin());
        functions_.push_back(function);
      }

  const auto cell = [](const std::vector<double> &knots, double x) {
    int n = -1;
    for (auto k = knots.begin(); k != knots.end() && *k <= x; k = std::upper_bound(k, knots.end(), *k))
      ++n;
    return n;
  };
  const int n_u = cell(u, u.back());
  for (const auto &function : functions_)
    {
      const Box box = function.support();
      for (int j = cell(v, box.min[1]); j < cell(v, box.max[1]); ++j)
        for (int i = cell(u, box.min[0]); i < cell(u, box.max[0]); ++i)
          elements_of_function_.push_back(j * n_u + i);
      elements_of_function_.end_row();
    }
  functions_of_element_ = elements_of_function_.transposed(n_elements());
}

template <int degree>
LRBasis<degree>::LRBasis(LRBasisParts<degree> parts)
    : initial_knots_{checked(std::move(parts.initial_knots[0]), "u", degree),
                     checked(std::move(parts.initial_knots[1]), "v", degree)},
      domain_{{initial_knots_[0].front(), initial_knots_[1].front()},
              {initial_knots_[0].back(), initial_knots_[1].back()}},
      mesh_(initial_knots_[0], initial_knots_[1]),
      tree_(initial_knots_[0], initial_knots_[1], parts.elements),
      functions_(std::move(parts.functions))
{
  for (const auto &line : parts.lines)
    if (const int d = static_cast<int>(line.direction); line.value != domain_.min[d] && line.value != domain_.max[d])
      check(line);
  mesh_.add(parts.lines);
  mesh_lines_ = mesh_.lines();
  if (mesh_lines_ != parts.lines)
    throw InvalidParameter("LR basis: the mesh lines given are not merged and in order, or lack lines of the initial "
                           "mesh; expected those of LRBasis::mesh_lines");
  check_elements();
  check_functions();
  std::vector<int> elements;
  for (const auto &function : functions_)
    {
      elements.clear();
      tree_.append_inside(function.support(), elements);
      for (const int e : elements)
        elements_of_function_.push_back(e);
      elements_of_function_.end_row();
    }
  functions_of_element_ = elements_of_function_.transposed(n_elements());
  check_partition_of_unity();
}

template <int degree>
void LRBasis<degree>::check_elements() const
{
  for (int e = 0; e < n_elements(); ++e)
    {
      const Box &box = element(e);
      for (int d = 0; d < 2; ++d)
        {
          const auto direction = static_cast<Direction>(d);
          const auto crossing  = mesh_.between(direction, box.min[d], box.max[d]);
          const bool bounded   = mesh_.multiplicity(direction, box.min[d], box.min[1 - d], box.max[1 - d]) > 0 &&
                               mesh_.multiplicity(direction, box.max[d], box.min[1 - d], box.max[1 - d]) > 0;
          if (!bounded || std::any_of(crossing.begin(), crossing.end(), [&](const auto &line) {
                return line.multiplicity(box.min[1 - d], box.max[1 - d]) > 0;
              }))
            throw InvalidParameter("LR basis: element " + std::to_string(e) + " is " +
                                   (bounded ? "crossed" : "not bounded") + " by lines of the mesh");
        }
    }
}

template <int degree>
void LRBasis<degree>::check_functions() const
{
  internal::FunctionSplitter<degree> splitter(mesh_);
  for (int i = 0; i < n_functions(); ++i)
    {
      const auto &[knots, gamma] = functions_[i];
      bool valid                 = gamma > 0. && gamma <= 1. + 1e-10;
      for (int d = 0; d < 2; ++d)
        valid = valid && std::is_sorted(knots[d].begin(), knots[d].end()) && domain_.min[d] <= knots[d].front() &&
                knots[d].front() < knots[d].back() && knots[d].back() <= domain_.max[d];
      if (!valid || splitter.is_crossed(functions_[i]))
        throw InvalidParameter("LR basis: function " + std::to_string(i) + " has " +
                               (valid ? "a support that lines of the mesh cross"
                                      : "knots that do not ascend inside the domain or a weight outside (0, 1]"));
    }
}

template <int degree>
void LRBasis<degree>::check_partition_of_unity() const
{
  for (int e = 0; e < n_elements(); ++e)
    {
      const auto [u, v] = element(e).centre();
      double sum        = 0.;
      for (const auto &value : evaluate(*this, e, u, v))
        sum += value.value;
      const auto n = functions_of(e).size();
      if (n < (degree + 1) * (degree + 1) || !(std::abs(sum - 1.) < 1e-10))
        throw InvalidParameter("LR basis: element " + std::to_string(e) + " has " + std::to_string(n) +
                               " functions whose sum is " + text(sum) + " at its centre, expected at least " +
                               std::to_string((degree + 1) * (degree + 1)) + " and 1");
    }
}

template <int degree>
int LRBasis<degree>::element_at(double u, double v) const
{
  const int e = tree_.element_at(u, v);
  if (e < 0)
    throw InvalidParameter("element_at: the point (" + text(u) + ", " + text(v) + ") lies outside the domain [" +
                           text(domain_.min[0]) + ", " + text(domain_.max[0]) + "] x [" + text(domain_.min[1]) + ", " +
                           text(domain_.max[1]) + "]");
  return e;
}

template <int degree>
void LRBasis<degree>::check(const MeshLine &line) const
{
  const int         d = static_cast<int>(line.direction), o = 1 - d;
  const std::string where = std::string("mesh line ") + "uv"[d] + " = " + text(line.value) + ", " + "uv"[o] + " in [" +
                            text(line.start) + ", " + text(line.end) + "]: ";
  if (!(domain_.min[d] < line.value && line.value < domain_.max[d]))
    throw InvalidParameter(where + "its value must lie strictly between " + text(domain_.min[d]) + " and " +
                           text(domain_.max[d]));
  if (!(line.start < line.end))
    throw InvalidParameter(where + "its start must lie before its end");
  if (!(domain_.min[o] <= line.start && line.end <= domain_.max[o]))
    throw InvalidParameter(where + "it must lie between " + text(domain_.min[o]) + " and " + text(domain_.max[o]));
  if (line.multiplicity < 1 || line.multiplicity > degree)
    throw InvalidParameter(where + "its multiplicity " + std::to_string(line.multiplicity) + " must be from 1 to " +
                           std::to_string(degree));
}

template <int degree>
Refinement LRBasis<degree>::insert(std::span<const MeshLine> given)
{
  std::for_each(given.begin(), given.end(), [this](const MeshLine &line) { check(line); });
  auto lines = merged({given.begin(), given.end()});
  for (auto &line : lines)
    {
      normalise(line.value);
      normalise(line.start);
      normalise(line.end);
    }
  mesh_.add(lines);
  mesh_lines_ = mesh_.lines();

  const auto                         touched = touched_elements(tree_, lines);
  internal::FunctionSplitter<degree> splitter(mesh_);
  const auto                         entry_of = split_crossed_functions(*this, touched, splitter);

  const int        n_old_elements = n_elements();
  std::vector<int> parent         = tree_.split(touched, mesh_);

  TransferRows                    rows;
  std::vector<LRFunction<degree>> functions;
  std::vector<int>                origin;
  rows.reserve(n_functions() + splitter.entries().size());
  functions.reserve(n_functions() + splitter.entries().size());
  for (int i = 0; i < n_functions(); ++i)
    {
      const auto *entry = entry_of[i] < 0 ? nullptr : &splitter.entries()[entry_of[i]];
      if (entry && entry->split)
        continue;
      functions.push_back(functions_[i]);
      origin.push_back(i);
      if (entry)
        functions.back().gamma = rows.add_shares(splitter.shares(), entry->first_share);
      else
        rows.add_unchanged(i);
    }
  for (const auto &entry : splitter.entries())
    if (!entry.is_old && !entry.split)
      {
        functions.push_back({entry.knots, rows.add_shares(splitter.shares(), entry.first_share)});
        origin.push_back(entry.origin);
      }
  functions_ = std::move(functions);
  rebuild_adjacency(parent, origin, n_old_elements);
  return {std::move(rows.transfer), std::move(parent)};
}

template <int degree>
void LRBasis<degree>::rebuild_adjacency(const std::vector<int> &parent, std::span<const int> origin, int n_old_elements)
{
  std::vector<int> first_part(n_old_elements + 1, 0);
  for (const int e : parent)
    ++first_part[e + 1];
  for (int e = 0; e < n_old_elements; ++e)
    first_part[e + 1] += first_part[e];

  Adjacency elements_of_function;
  for (int i = 0; i < n_functions(); ++i)
    {
      const Box support = functions_[i].support();
      for (const int old : elements_of_function_[origin[i]])
        for (int e = first_part[old]; e < first_part[old + 1]; ++e)
          if (contains(support, element(e)))
            elements_of_function.push_back(e);
      elements_of_function.end_row();
    }
  elements_of_function_ = std::move(elements_of_function);
  functions_of_element_ = elements_of_function_.transposed(n_elements());
}

template <int degree>
Refinement LRBasis<degree>::refine(std::span<const int> functions, const SpanTarget &target)
{
  return insert(structured_mesh_lines(*this, functions, target));
}

template <int degree>
std::vector<MeshLine> structured_mesh_lines(const LRBasis<degree> &basis, std::span<const int> functions,
                                            const SpanTarget &target)
{
  constexpr double      slack = 1. + 1e-10;
  std::vector<MeshLine> lines;
  for (const double length : target.length)
    if (!(length > 0.))
      throw InvalidParameter("structured mesh: the target span length " + text(length) + " must be positive");
  for (const int i : functions)
    {
      if (i < 0 || i >= basis.n_functions())
        throw InvalidParameter("structured mesh: function " + std::to_string(i) + " is marked, but the basis has " +
                               std::to_string(basis.n_functions()));
      const auto &knots = basis.function(i).knots;
      for (int d = 0; d < 2; ++d)
        for (int k = 0; k <= degree; ++k)
          if (knots[d][k + 1] - knots[d][k] > target.length[d] * slack)
            lines.push_back({static_cast<Direction>(d), 0.5 * (knots[d][k] + knots[d][k + 1]), knots[1 - d].front(),
                             knots[1 - d].back(), 1});
    }
  return merged(std::move(lines));
}

template class LRBasis<2>;
template class LRBasis<3>;
template class LRBasis<4>;
template std::vector<MeshLine> structured_mesh_lines(const LRBasis<2> &, std::span<const int>, const SpanTarget &);
template std::vector<MeshLine> structured_mesh_lines(const LRBasis<3> &, std::span<const int>, const SpanTarget &);
template std::vector<MeshLine> structured_mesh_lines(const LRBasis<4> &, std::span<const int>, const SpanTarget &);

} // namespace sherd
