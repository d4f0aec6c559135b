#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace sherd
{

/// Shortest text that reads back as exactly this number; "nan", "inf", "-inf" for those.
std::string exact(double value);

/// @p name with a blank in the place of each comma, quote and line end, which a table does not take: names that others
/// have given, as those of edges in geometry files.
std::string column_name(std::string name);

/// One row of a CsvTable, filled from left to right.
class CsvRow
{
public:
  CsvRow &operator<<(double value);
  CsvRow &operator<<(int value);
  CsvRow &operator<<(long value);
  CsvRow &operator<<(const std::string &text); ///< without commas, quotes and line ends

  int                size() const { return size_; }
  const std::string &text() const { return text_; }

private:
  void add(const std::string &cell);

  std::string text_;
  int         size_ = 0;
};

/// Table in a file: a line of column names, then a line a row, cells separated by commas. Every row is on disk when
/// append() returns. Numbers read back exactly.
class CsvTable
{
public:
  /// Starts a file anew.
  /// @throws InvalidParameter   a column name with a comma, quote or line end   @throws FileError   if it cannot be
  ///                            written
  CsvTable(const std::filesystem::path &file, std::vector<std::string> columns);

  /// Goes on with an existing file: keeps the rows with column "time" up to @p time, drops later and torn ones.
  /// Starts anew if there is no file.
  /// @throws FileError   other columns in the file, or it cannot be read or written
  static CsvTable resume(const std::filesystem::path &file, std::vector<std::string> columns, double time);

  /// @throws DimensionMismatch   number of cells and of columns differ
  /// @throws FileError           if the row cannot be written
  void append(const CsvRow &row);

  const std::vector<std::string> &columns() const { return columns_; }

private:
  CsvTable() = default;
  void open();

  std::filesystem::path    file_;
  std::vector<std::string> columns_;
  std::ofstream            stream_;
};

} // namespace sherd
