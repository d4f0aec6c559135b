#include <sherd/algebra/block_ilu.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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

} // namespace

BlockIlu::BlockIlu(const SparseGraph &graph, int block_size, int fill_level)
    : n_rows_(graph.n_rows()), block_size_(block_size), fill_level_(fill_level)
{
  if (block_size < 1 || block_size > 4)
    throw InvalidParameter("block size of incomplete factors = " + std::to_string(block_size) + ", expected 1 to 4");
  if (fill_level < 0)
    throw InvalidParameter("level of fill = " + std::to_string(fill_level) + ", expected at least 0");

  offsets_.assign(1, 0);
  diagonal_.reserve(n_rows_);
  std::vector<int> levels;
  SortedRow        row(n_rows_);
  for (int i = 0; i < n_rows_; ++i)
    {
      row.clear();
      int last = row.head();
      for (const int j : graph.row(i))
        if (j < n_rows_)
          last = row.add(last, j, 0);
      row.add(row.head(), i, 0);

      for (int j = row.next(row.head()); j < i; j = row.next(j))
        if (row.level(j) < fill_level)
          {
            int place = j;
            for (std::size_t p = diagonal_[j] + 1; p < offsets_[j + 1]; ++p)
              if (const int level = row.level(j) + levels[p] + 1; level <= fill_level)
                place = row.add(place, columns_[p], level);
          }

      for (int j = row.next(row.head()); j != SortedRow::end; j = row.next(j))
        {
          if (j == i)
            diagonal_.push_back(columns_.size());
          columns_.push_back(j);
          levels.push_back(row.level(j));
        }
      offsets_.push_back(columns_.size());
    }
  factors_.resize(columns_.size() * block_size * block_size);
}

template <int block_size>
void BlockIlu::factor_blocks(const SparseGraph &graph, std::span<const double> values,
                             std::span<const double> more_values)
{
  constexpr int       size = block_size * block_size;
  std::vector<int>    slots(n_rows_, -1); // of each column among the kept blocks of the current row
  std::vector<double> work;
  for (int i = 0; i < n_rows_; ++i)
    {
      const auto begin = offsets_[i], end = offsets_[i + 1];
      work.assign((end - begin) * size, 0.);
      for (auto p = begin; p < end; ++p)
        slots[columns_[p]] = static_cast<int>(p - begin);

      const auto    first = static_cast<std::size_t>(graph.offsets[i]) * size;
      const double *row = first < values.size() ? values.data() + first : more_values.data() + (first - values.size());
      const auto    blocks = graph.row(i);
      const auto    length = blocks.size() * block_size;
      for (std::size_t k = 0; k < blocks.size(); ++k)
        if (blocks[k] < n_rows_)
          for (int c = 0; c < block_size; ++c)
            for (int d = 0; d < block_size; ++d)
              work[slots[blocks[k]] * size + c * block_size + d] = row[c * length + k * block_size + d];

      for (auto p = begin; p < diagonal_[i]; ++p)
        {
          const int    j       = columns_[p];
          double      *entry   = work.data() + (p - begin) * size;
          const float *inverse = factors_.data() + diagonal_[j] * size;
          double       lower[size];
          for (int c = 0; c < block_size; ++c)
            for (int d = 0; d < block_size; ++d)
              {
                double sum = 0.;
                for (int m = 0; m < block_size; ++m)
                  sum += entry[c * block_size + m] * inverse[m * block_size + d];
                lower[c * block_size + d] = sum;
              }
          for (int m = 0; m < size; ++m)
            entry[m] = lower[m];
          for (auto q = diagonal_[j] + 1; q < offsets_[j + 1]; ++q)
            if (const int slot = slots[columns_[q]]; slot >= 0)
              {
                double      *target = work.data() + slot * size;
                const float *upper  = factors_.data() + q * size;
                for (int c = 0; c < block_size; ++c)
                  for (int m = 0; m < block_size; ++m)
                    for (int d = 0; d < block_size; ++d)
                      target[c * block_size + d] -= lower[c * block_size + m] * upper[m * block_size + d];
              }
        }

      double        pivot[size];
      double *const diagonal = work.data() + (diagonal_[i] - begin) * size;
      for (int m = 0; m < size; ++m)
        pivot[m] = diagonal[m];
      if (!invert<block_size>(pivot))
        throw NoConvergence("incomplete factors: singular diagonal block in row " + std::to_string(i));
      for (int m = 0; m < size; ++m)
        diagonal[m] = pivot[m];

      float *const stored = factors_.data() + begin * size;
      float        finite = 0.F;
      for (std::size_t m = 0; m < work.size(); ++m)
        {
          stored[m] = static_cast<float>(work[m]);
          finite += stored[m] * 0.F;
        }
      if (finite != 0.F)
        throw NoConvergence("incomplete factors: value out of range in row " + std::to_string(i));
      for (auto p = begin; p < end; ++p)
        slots[columns_[p]] = -1;
    }
}

template <int block_size>
void BlockIlu::solve_blocks(double *x) const
{
  constexpr int size     = block_size * block_size;
  const auto    subtract = [&](std::size_t begin, std::size_t end, double *sum) {
    for (auto p = begin; p < end; ++p)
      {
        const float  *block = factors_.data() + p * size;
        const double *in    = x + static_cast<std::size_t>(columns_[p]) * block_size;
        for (int c = 0; c < block_size; ++c)
          for (int d = 0; d < block_size; ++d)
            sum[c] -= block[c * block_size + d] * in[d];
      }
  };
  for (int i = 0; i < n_rows_; ++i)
    {
      double  sum[block_size];
      double *out = x + static_cast<std::size_t>(i) * block_size;
      for (int c = 0; c < block_size; ++c)
        sum[c] = out[c];
      subtract(offsets_[i], diagonal_[i], sum);
      for (int c = 0; c < block_size; ++c)
        out[c] = sum[c];
    }
  for (int i = n_rows_ - 1; i >= 0; --i)
    {
      double  sum[block_size];
      double *out = x + static_cast<std::size_t>(i) * block_size;
      for (int c = 0; c < block_size; ++c)
        sum[c] = out[c];
      subtract(diagonal_[i] + 1, offsets_[i + 1], sum);
      const float *inverse = factors_.data() + diagonal_[i] * size;
      for (int c = 0; c < block_size; ++c)
        {
          out[c] = 0.;
          for (int d = 0; d < block_size; ++d)
            out[c] += inverse[c * block_size + d] * sum[d];
        }
    }
}

void BlockIlu::factor(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values)
{
  const auto expected = static_cast<std::size_t>(graph.offsets.back()) * block_size_ * block_size_;
  if (graph.n_rows() != n_rows_ || values.size() + more_values.size() != expected)
    throw DimensionMismatch("incomplete factors of " + std::to_string(n_rows_) +
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

void BlockIlu::solve(std::span<double> x) const
{
  if (x.size() != static_cast<std::size_t>(n_rows_) * block_size_)
    throw DimensionMismatch("incomplete factors of " + std::to_string(n_rows_) + " rows of blocks of " +
                            std::to_string(block_size_) + " applied to " + std::to_string(x.size()) + " values");
  switch (block_size_)
    {
    case 1:
      return solve_blocks<1>(x.data());
    case 2:
      return solve_blocks<2>(x.data());
    case 3:
      return solve_blocks<3>(x.data());
    default:
      return solve_blocks<4>(x.data());
    }
}

} // namespace sherd
