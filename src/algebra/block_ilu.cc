#include <sherd/algebra/block_ilu.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#ifdef __AVX__
#  include <immintrin.h>
#endif
#include <omp.h>

#include "registers.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

/// Inverts a small matrix in place (Gauss-Jordan with column pivots); false if it is singular.
template <int n>
bool invert(double (&a)[n * n])
{
  double inverse[n * n] = {};
  for (int i = 0; i < n; ++i)
    inverse[i * n + i] = 1.;
  for (int k = 0; k < n; ++k)
    {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
        if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k]))
          pivot = i;
      const double value = a[pivot * n + k];
      if (value == 0. || !std::isfinite(value))
        return false;
      for (int j = 0; j < n; ++j)
        {
          std::swap(a[k * n + j], a[pivot * n + j]);
          std::swap(inverse[k * n + j], inverse[pivot * n + j]);
        }
      for (int j = 0; j < n; ++j)
        {
          a[k * n + j] /= value;
          inverse[k * n + j] /= value;
        }
      for (int i = 0; i < n; ++i)
        if (i != k)
          {
            const double factor = a[i * n + k];
            for (int j = 0; j < n; ++j)
              {
                a[i * n + j] -= factor * a[k * n + j];
                inverse[i * n + j] -= factor * inverse[k * n + j];
              }
          }
    }
  for (int i = 0; i < n * n; ++i)
    a[i] = inverse[i];
  return true;
}

/// One row of the symbolic phase: its columns in ascending order as a linked list with their levels.
class SortedRow
{
public:
  explicit SortedRow(int n_columns) : next_(n_columns + 1, end), level_(n_columns + 1) {}

  static constexpr int end = -1;

  /// The list starts after head(), which precedes every column.
  int head() const { return static_cast<int>(next_.size()) - 1; }
  int next(int column) const { return next_[column]; }
  int level(int column) const { return level_[column]; }

  /// Adds a column or lowers its level. Searches from @p from, a member of the list (or head()) before it, and returns
  /// the position of the column, from which larger ones may be added.
  int add(int from, int column, int level)
  {
    int before = from;
    while (next_[before] != end && next_[before] < column)
      before = next_[before];
    if (next_[before] == column)
      level_[column] = std::min(level_[column], level);
    else
      {
        next_[column]  = std::exchange(next_[before], column);
        level_[column] = level;
      }
    return column;
  }

  void clear() { next_[head()] = end; }

private:
  std::vector<int> next_, level_;
};

/// Blocks of consecutive rows from position @p first on, with the levels of those right of the diagonal.
struct Pattern
{
  int                      first         = 0;
  std::vector<std::size_t> lower_offsets = {0}, upper_offsets = {0};
  std::vector<int>         lower_columns, upper_columns, upper_levels;

  void append(const Pattern &next)
  {
    const auto append_offsets = [](std::vector<std::size_t> &offsets, const std::vector<std::size_t> &more) {
      const auto shift = offsets.back();
      for (std::size_t k = 1; k < more.size(); ++k)
        offsets.push_back(shift + more[k]);
    };
    append_offsets(lower_offsets, next.lower_offsets);
    append_offsets(upper_offsets, next.upper_offsets);
    lower_columns.insert(lower_columns.end(), next.lower_columns.begin(), next.lower_columns.end());
    upper_columns.insert(upper_columns.end(), next.upper_columns.begin(), next.upper_columns.end());
    upper_levels.insert(upper_levels.end(), next.upper_levels.begin(), next.upper_levels.end());
  }
};

/// Appends row @p i to the pattern of the rows before it. @param columns of the matrix in this row, ascending.
void append_row(int i, std::span<const int> columns, int fill_level, SortedRow &row, Pattern &pattern)
{
  row.clear();
  int last = row.head();
  for (const int j : columns)
    last = row.add(last, j, 0);
  row.add(row.head(), i, 0);

  int j = row.next(row.head());
  for (; j < i; j = row.next(j))
    {
      if (row.level(j) < fill_level)
        {
          int        place = j;
          const auto k     = static_cast<std::size_t>(j - pattern.first);
          for (auto p = pattern.upper_offsets[k] + 1; p < pattern.upper_offsets[k + 1]; ++p)
            if (const int level = row.level(j) + pattern.upper_levels[p] + 1; level <= fill_level)
              place = row.add(place, pattern.upper_columns[p], level);
        }
      pattern.lower_columns.push_back(j);
    }
  for (; j != SortedRow::end; j = row.next(j))
    {
      pattern.upper_columns.push_back(j);
      pattern.upper_levels.push_back(row.level(j));
    }
  pattern.lower_offsets.push_back(pattern.lower_columns.size());
  pattern.upper_offsets.push_back(pattern.upper_columns.size());
}

/// Rows of blocks and blocks of vectors in registers. What a block does not fill holds numbers that nobody reads.
template <int block_size>
struct Lanes
{
  static constexpr int width = block_size <= 2 ? 2 : 4;
  using Doubles              = typename Registers<width>::Doubles;
  using Floats               = typename Registers<width>::Floats;

  static const Doubles &at(const double *place) { return *reinterpret_cast<const Doubles *>(place); }
  static Doubles       &at(double *place) { return *reinterpret_cast<Doubles *>(place); }
  static Doubles        filled(double value) { return Doubles{} + value; }
  static Doubles        widened(const float *place)
  {
#ifdef __AVX__ // in one instruction, which not every compiler finds
    if constexpr (width == 4)
      return _mm256_cvtps_pd(_mm_loadu_ps(place));
    else
#endif
      return __builtin_convertvector(*reinterpret_cast<const Floats *>(place), Doubles);
  }
};

/// Reverses the order of @p rows; deferred ones go behind the last of their neighbours in the new order.
void reverse(std::span<int> rows, const SparseGraph &graph, std::span<const char> deferred)
{
  std::reverse(rows.begin(), rows.end());
  if (deferred.empty())
    return;
  std::vector<int> places(graph.n_rows(), -1);
  for (std::size_t k = 0; k < rows.size(); ++k)
    places[rows[k]] = static_cast<int>(k);
  std::vector<std::pair<int, int>> keys; // place of the row or of its last neighbour, and whether it is deferred
  for (const int row : rows)
    {
      int last = places[row];
      if (deferred[row])
        for (const int j : graph.row(row))
          if (j < graph.n_rows() && !deferred[j])
            last = std::max(last, places[j]);
      keys.push_back({last, deferred[row]});
    }
  std::vector<int> sorted(rows.begin(), rows.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) { return keys[places[a]] < keys[places[b]]; });
  std::copy(sorted.begin(), sorted.end(), rows.begin());
}

bool all_finite(std::span<const float> values)
{
  constexpr std::size_t n_lanes        = 16;
  float                 zeros[n_lanes] = {}, zero = 0.F; // sums of zeros, or of what is not finite
  const auto            n_whole = values.size() / n_lanes * n_lanes;
  for (std::size_t m = 0; m < n_whole; m += n_lanes)
    for (std::size_t lane = 0; lane < n_lanes; ++lane)
      zeros[lane] += values[m + lane] * 0.F;
  for (std::size_t m = n_whole; m < values.size(); ++m)
    zero += values[m] * 0.F;
  for (const float lane : zeros)
    zero += lane;
  return zero == 0.F;
}

/// Sum of blocks times blocks of a vector.
template <int block_size>
struct RowSum
{
  using Lane                              = Lanes<block_size>;
  typename Lane::Doubles sums[block_size] = {};

  void add(const float *block, const double *vector)
  {
    const auto in = Lane::at(vector);
    for (int c = 0; c < block_size; ++c)
      sums[c] += Lane::widened(block + c * block_size) * in;
  }

  double component(int c) const
  {
    double result = sums[c][0];
    for (int d = 1; d < block_size; ++d)
      result += sums[c][d];
    return result;
  }
};

} // namespace

BlockIlu::BlockIlu(const SparseGraph &graph, int block_size, int fill_level, int n_threads,
                   std::span<const char> deferred)
    : block_size_(block_size), fill_level_(fill_level), n_threads_(n_threads)
{
  if (block_size < 1 || block_size > 4)
    throw InvalidParameter("block size of incomplete factors = " + std::to_string(block_size) + ", expected 1 to 4");
  if (fill_level < 0)
    throw InvalidParameter("level of fill = " + std::to_string(fill_level) + ", expected at least 0");
  if (n_threads < 1)
    throw InvalidParameter("threads of incomplete factors = " + std::to_string(n_threads) + ", expected at least 1");
  if (!deferred.empty() && static_cast<int>(deferred.size()) != graph.n_rows())
    throw DimensionMismatch("incomplete factors of " + std::to_string(graph.n_rows()) +
                            " rows: " + std::to_string(deferred.size()) + " marks of deferred rows");
  cut(graph, deferred);
  find_pattern(graph);
}

void BlockIlu::cut(const SparseGraph &graph, std::span<const char> deferred)
{
  const int         n_rows = graph.n_rows();
  std::vector<int>  chunks(n_rows);
  std::vector<char> in_separator(n_rows, 0);
  for (int i = 0; i < n_rows; ++i)
    chunks[i] =
        static_cast<int>(static_cast<std::int64_t>(n_threads_) * graph.offsets[i] / std::max(graph.offsets.back(), 1));
  for (int i = 0; i < n_rows; ++i)
    chunks[i] = std::min(chunks[i], n_threads_ - 1); // empty rows at the end
  for (int i = 0; i < n_rows; ++i)
    for (const int j : graph.row(i))
      if (j < n_rows && chunks[i] != chunks[j])
        in_separator[std::max(i, j)] = 1;
  // A deferred row stays behind its neighbours: it goes to the separator with any of them.
  std::vector<int> followers;
  for (int i = 0; i < n_rows && !deferred.empty(); ++i)
    if (const auto row = graph.row(i); deferred[i] && std::any_of(row.begin(), row.end(), [&](int j) {
                                         return j < n_rows && in_separator[j] && chunks[j] == chunks[i];
                                       }))
      followers.push_back(i);
  for (const int i : followers)
    in_separator[i] = 1;

  const auto part = [&](int i) { return chunks[i] + (in_separator[i] ? n_threads_ : 0); };
  parts_.assign(2 * n_threads_ + 1, 0);
  for (int i = 0; i < n_rows; ++i)
    ++parts_[part(i) + 1];
  for (int p = 0; p < 2 * n_threads_; ++p)
    parts_[p + 1] += parts_[p];
  auto next = parts_;
  order_.resize(n_rows);
  for (int i = 0; i < n_rows; ++i)
    order_[next[part(i)]++] = i;
  for (int p = 1; p < n_threads_; p += 2)
    reverse({order_.begin() + parts_[p], order_.begin() + parts_[p + 1]}, graph, deferred);
}

void BlockIlu::find_pattern(const SparseGraph &graph)
{
  std::vector<int> positions(n_rows());
  for (int i = 0; i < n_rows(); ++i)
    positions[order_[i]] = i;
  const auto append_part = [&](int part, Pattern &pattern) {
    SortedRow        row(n_rows());
    std::vector<int> columns;
    for (int i = parts_[part]; i < parts_[part + 1]; ++i)
      {
        columns.clear();
        for (const int j : graph.row(order_[i]))
          if (j < n_rows())
            columns.push_back(positions[j]);
        if (!std::is_sorted(columns.begin(), columns.end()))
          std::sort(columns.begin(), columns.end());
        append_row(i, columns, fill_level_, row, pattern);
      }
  };

  std::vector<Pattern> interiors(n_threads_);
#pragma omp parallel for num_threads(n_threads_) schedule(static, 1)
  for (int part = 0; part < n_threads_; ++part)
    {
      interiors[part].first = parts_[part];
      append_part(part, interiors[part]);
    }
  Pattern pattern = std::move(interiors[0]);
  for (int part = 1; part < n_threads_; ++part)
    pattern.append(interiors[part]);
  for (int part = n_threads_; part < 2 * n_threads_; ++part)
    {
      append_part(part, pattern);
      for (int i = parts_[part]; i < parts_[part + 1]; ++i)
        for (auto p = pattern.lower_offsets[i]; p < pattern.lower_offsets[i + 1]; ++p)
          {
            const int j = pattern.lower_columns[p];
            separators_coupled_ |= j >= parts_[n_threads_] && j < parts_[part];
          }
      for (int i = parts_[n_threads_]; i < parts_[part]; ++i)
        for (auto p = pattern.upper_offsets[i]; p < pattern.upper_offsets[i + 1]; ++p)
          separators_coupled_ |= pattern.upper_columns[p] >= parts_[part];
    }

  const auto allocate = [this](Triangle &triangle, std::vector<std::size_t> &offsets, std::vector<int> &columns) {
    triangle.offsets = std::move(offsets);
    triangle.columns = std::move(columns);
    triangle.values.assign(triangle.columns.size() * block_size_ * block_size_ + 4, 0.F);
  };
  allocate(lower_, pattern.lower_offsets, pattern.lower_columns);
  allocate(upper_, pattern.upper_offsets, pattern.upper_columns);
  work_.assign(static_cast<std::size_t>(n_rows()) * 4, 0.);
}

std::vector<int> BlockIlu::row(int i) const
{
  std::vector<int> result(lower_.columns.begin() + lower_.offsets[i], lower_.columns.begin() + lower_.offsets[i + 1]);
  result.insert(result.end(), upper_.columns.begin() + upper_.offsets[i],
                upper_.columns.begin() + upper_.offsets[i + 1]);
  return result;
}

struct BlockIlu::Workspace
{
  std::vector<int>    slots;  ///< of each column among the kept blocks of the current row, -1 for the others
  std::vector<double> blocks; ///< of the current row, their rows padded to whole registers
};

template <int block_size>
std::string BlockIlu::factor_part(int part, const SparseGraph &graph, std::span<const double> values,
                                  std::span<const double> more_values, std::span<const int> positions,
                                  Workspace &workspace)
{
  using Lane           = Lanes<block_size>;
  constexpr int size   = block_size * block_size;
  constexpr int width  = Lane::width;
  constexpr int padded = block_size * width;
  auto         &slots  = workspace.slots;
  slots.assign(n_rows(), -1);
  for (int i = parts_[part]; i < parts_[part + 1]; ++i)
    {
      const std::span<const int> left(lower_.columns.data() + lower_.offsets[i],
                                      lower_.columns.data() + lower_.offsets[i + 1]);
      const std::span<const int> right(upper_.columns.data() + upper_.offsets[i],
                                       upper_.columns.data() + upper_.offsets[i + 1]);
      const int                  n_left = static_cast<int>(left.size()), n_right = static_cast<int>(right.size());
      for (int k = 0; k < n_left; ++k)
        slots[left[k]] = k;
      for (int k = 0; k < n_right; ++k)
        slots[right[k]] = n_left + k;
      workspace.blocks.assign(static_cast<std::size_t>(n_left + n_right) * padded, 0.);
      double *const work = workspace.blocks.data();

      const int     r     = order_[i];
      const auto    first = static_cast<std::size_t>(graph.offsets[r]) * size;
      const double *row = first < values.size() ? values.data() + first : more_values.data() + (first - values.size());
      const auto    blocks = graph.row(r);
      const auto    length = blocks.size() * block_size;
      for (std::size_t k = 0; k < blocks.size(); ++k)
        if (blocks[k] < n_rows())
          {
            double *const block = work + static_cast<std::size_t>(slots[positions[blocks[k]]]) * padded;
            for (int c = 0; c < block_size; ++c)
              for (int d = 0; d < block_size; ++d)
                block[c * width + d] = row[c * length + k * block_size + d];
          }

      for (int k = 0; k < n_left; ++k)
        {
          const auto    begin = upper_.offsets[left[k]], end = upper_.offsets[left[k] + 1];
          double *const entry   = work + k * padded;
          const float  *inverse = upper_.values.data() + begin * size;
          for (int c = 0; c < block_size; ++c)
            {
              auto sum = entry[c * width] * Lane::widened(inverse);
              for (int m = 1; m < block_size; ++m)
                sum += entry[c * width + m] * Lane::widened(inverse + m * block_size);
              Lane::at(entry + c * width) = sum;
            }
          typename Lane::Doubles lower[block_size][block_size];
          for (int c = 0; c < block_size; ++c)
            for (int m = 0; m < block_size; ++m)
              lower[c][m] = Lane::filled(entry[c * width + m]);
          for (auto q = begin + 1; q < end; ++q)
            if (const int slot = slots[upper_.columns[q]]; slot >= 0)
              {
                double                *target = work + slot * padded;
                const float           *upper  = upper_.values.data() + q * size;
                typename Lane::Doubles rows[block_size];
                for (int m = 0; m < block_size; ++m)
                  rows[m] = Lane::widened(upper + m * block_size);
                for (int c = 0; c < block_size; ++c)
                  {
                    auto sum = Lane::at(target + c * width);
                    for (int m = 0; m < block_size; ++m)
                      sum -= lower[c][m] * rows[m];
                    Lane::at(target + c * width) = sum;
                  }
              }
        }

      double        pivot[size];
      double *const diagonal = work + n_left * padded;
      for (int c = 0; c < block_size; ++c)
        std::copy_n(diagonal + c * width, block_size, pivot + c * block_size);
      if (!invert<block_size>(pivot))
        return "incomplete factors: singular diagonal block in row " + std::to_string(r);
      for (int c = 0; c < block_size; ++c)
        std::copy_n(pivot + c * block_size, block_size, diagonal + c * width);

      const auto store = [](const double *from, int n_blocks, std::span<float> to) {
        for (int k = 0; k < n_blocks * block_size; ++k)
          for (int d = 0; d < block_size; ++d)
            to[k * block_size + d] = static_cast<float>(from[k * width + d]);
        return all_finite(to);
      };
      const std::span<float> left_values(lower_.values.data() + lower_.offsets[i] * size, left.size() * size);
      const std::span<float> right_values(upper_.values.data() + upper_.offsets[i] * size, right.size() * size);
      const bool             left_finite = store(work, n_left, left_values);
      if (!store(diagonal, n_right, right_values) || !left_finite)
        return "incomplete factors: value out of range in row " + std::to_string(r);
      for (const int j : left)
        slots[j] = -1;
      for (const int j : right)
        slots[j] = -1;
    }
  return {};
}

template <int block_size>
void BlockIlu::factor_blocks(const SparseGraph &graph, std::span<const double> values,
                             std::span<const double> more_values)
{
  std::vector<int> positions(n_rows());
  for (int i = 0; i < n_rows(); ++i)
    positions[order_[i]] = i;
  std::vector<Workspace>   workspaces(n_threads_);
  std::vector<std::string> failures(2 * n_threads_);
  const auto               factor_part = [&](int part) {
    failures[part] =
        this->factor_part<block_size>(part, graph, values, more_values, positions, workspaces[omp_get_thread_num()]);
  };
  const auto check = [&] {
    for (const auto &failure : failures)
      if (!failure.empty())
        throw NoConvergence(failure);
  };
#pragma omp parallel for num_threads(n_threads_) schedule(static, 1)
  for (int part = 0; part < n_threads_; ++part)
    factor_part(part);
  check();
#pragma omp parallel for num_threads(n_threads_) schedule(static, 1) if (!separators_coupled_)
  for (int part = n_threads_; part < 2 * n_threads_; ++part)
    factor_part(part);
  check();
}

template <int block_size>
void BlockIlu::sweep_forward(int part, const double *b)
{
  constexpr int width = Lanes<block_size>::width;
  for (int i = parts_[part]; i < parts_[part + 1]; ++i)
    {
      RowSum<block_size> sum;
      for (auto p = lower_.offsets[i]; p < lower_.offsets[i + 1]; ++p)
        sum.add(lower_.values.data() + p * block_size * block_size,
                work_.data() + static_cast<std::size_t>(lower_.columns[p]) * width);
      const double *in  = b + static_cast<std::size_t>(order_[i]) * block_size;
      double       *out = work_.data() + static_cast<std::size_t>(i) * width;
      for (int c = 0; c < block_size; ++c)
        out[c] = in[c] - sum.component(c);
    }
}

template <int block_size>
void BlockIlu::sweep_backward(int part, double *x)
{
  constexpr int width = Lanes<block_size>::width, size = block_size * block_size;
  for (int i = parts_[part + 1] - 1; i >= parts_[part]; --i)
    {
      const auto         first = upper_.offsets[i];
      RowSum<block_size> sum;
      for (auto p = upper_.offsets[i + 1] - 1; p > first; --p)
        sum.add(upper_.values.data() + p * size, work_.data() + static_cast<std::size_t>(upper_.columns[p]) * width);
      double *const work = work_.data() + static_cast<std::size_t>(i) * width;
      for (int c = 0; c < block_size; ++c)
        work[c] -= sum.component(c);
      RowSum<block_size> result;
      result.add(upper_.values.data() + first * size, work);
      double *const out = x + static_cast<std::size_t>(order_[i]) * block_size;
      for (int c = 0; c < block_size; ++c)
        out[c] = work[c] = result.component(c);
    }
}

template <int block_size>
void BlockIlu::solve_blocks(const double *b, double *x)
{
#pragma omp parallel num_threads(n_threads_) if (n_threads_ > 1)
  {
#pragma omp for schedule(static, 1)
    for (int part = 0; part < n_threads_; ++part)
      sweep_forward<block_size>(part, b);
    if (separators_coupled_)
      {
#pragma omp single
        {
          for (int part = n_threads_; part < 2 * n_threads_; ++part)
            sweep_forward<block_size>(part, b);
          for (int part = 2 * n_threads_ - 1; part >= n_threads_; --part)
            sweep_backward<block_size>(part, x);
        }
      }
    else
      {
#pragma omp for schedule(static, 1)
        for (int part = n_threads_; part < 2 * n_threads_; ++part)
          {
            sweep_forward<block_size>(part, b);
            sweep_backward<block_size>(part, x);
          }
      }
#pragma omp for schedule(static, 1)
    for (int part = 0; part < n_threads_; ++part)
      sweep_backward<block_size>(part, x);
  }
}

void BlockIlu::factor(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values)
{
  const auto expected = static_cast<std::size_t>(graph.offsets.back()) * block_size_ * block_size_;
  if (graph.n_rows() != n_rows() || values.size() + more_values.size() != expected)
    throw DimensionMismatch("incomplete factors of " + std::to_string(n_rows()) +
                            " rows: " + std::to_string(graph.n_rows()) + " rows and " +
                            std::to_string(values.size() + more_values.size()) + " values given, expected " +
                            std::to_string(expected) + " values");
  switch (block_size_)
    {
    case 1:
      return factor_blocks<1>(graph, values, more_values);
    case 2:
      return factor_blocks<2>(graph, values, more_values);
    case 3:
      return factor_blocks<3>(graph, values, more_values);
    default:
      return factor_blocks<4>(graph, values, more_values);
    }
}

void BlockIlu::solve(std::span<const double> b, std::span<double> x)
{
  const auto expected = static_cast<std::size_t>(n_rows()) * block_size_;
  if (b.size() != expected || x.size() != expected)
    throw DimensionMismatch("incomplete factors of " + std::to_string(n_rows()) + " rows of blocks of " +
                            std::to_string(block_size_) + " applied to " + std::to_string(b.size()) +
                            " values, result in " + std::to_string(x.size()));
  switch (block_size_)
    {
    case 1:
      return solve_blocks<1>(b.data(), x.data());
    case 2:
      return solve_blocks<2>(b.data(), x.data());
    case 3:
      return solve_blocks<3>(b.data(), x.data());
    default:
      return solve_blocks<4>(b.data(), x.data());
    }
}

} // namespace sherd
