#pragma once

#include <span>
#include <vector>

namespace sherd
{

/// Lists of integers in compressed rows, for example the functions of each element.
class Adjacency
{
public:
  int n_rows() const { return static_cast<int>(offsets_.size()) - 1; }

  /// Entries of row @p i.
  std::span<const int> operator[](int i) const
  {
    return {columns_.data() + offsets_[i], static_cast<std::size_t>(offsets_[i + 1] - offsets_[i])};
  }

  void reserve(std::size_t n_rows, std::size_t n_entries)
  {
    offsets_.reserve(n_rows + 1);
    columns_.reserve(n_entries);
  }

  /// Appends @p column to the open row.
  void push_back(int column) { columns_.push_back(column); }

  /// Closes the open row; the next push_back starts another.
  void end_row() { offsets_.push_back(static_cast<int>(columns_.size())); }

  /// The transposed lists, each ascending, for @p n_columns rows.
  Adjacency transposed(int n_columns) const
  {
    Adjacency result;
    result.offsets_.assign(n_columns + 1, 0);
    result.columns_.resize(columns_.size());
    for (const int column : columns_)
      ++result.offsets_[column + 1];
    for (int i = 0; i < n_columns; ++i)
      result.offsets_[i + 1] += result.offsets_[i];
    auto next = result.offsets_;
    for (int row = 0; row < n_rows(); ++row)
      for (const int column : (*this)[row])
        result.columns_[next[column]++] = row;
    return result;
  }

private:
  std::vector<int> offsets_{0};
  std::vector<int> columns_;
};

} // namespace sherd
