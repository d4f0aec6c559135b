// Which blocks the factors keep, and in which order: the symbolic phase.
#include <sherd/algebra/block_ilu.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

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

} // namespace sherd
