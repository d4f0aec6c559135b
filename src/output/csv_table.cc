#include <sherd/output/csv_table.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include <sherd/base/exceptions.h>
#include <sherd/output/replace_file.h>

namespace sherd
{
namespace
{

constexpr const char *no_part_of_cells = ",\"\n\r";

std::string join(const std::vector<std::string> &cells)
{
  std::string line;
  for (const auto &cell : cells)
    line += (line.empty() ? "" : ",") + cell;
  return line;
}

/// The cell of a line at position @p index, empty if there are fewer.
std::string cell(const std::string &line, std::size_t index)
{
  std::istringstream stream(line);
  std::string        result;
  for (std::size_t k = 0; k <= index; ++k)
    if (!std::getline(stream, result, ','))
      return {};
  return result;
}

} // namespace

std::string exact(double value)
{
  if (std::isnan(value))
    return "nan";
  if (std::isinf(value))
    return value > 0 ? "inf" : "-inf";
  char       buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  return {buffer, end};
}

std::string column_name(std::string name)
{
  for (auto at = name.find_first_of(no_part_of_cells); at != name.npos; at = name.find_first_of(no_part_of_cells, at))
    name[at] = ' ';
  return name;
}

CsvRow &CsvRow::operator<<(double value)
{
  add(exact(value));
  return *this;
}

CsvRow &CsvRow::operator<<(int value)
{
  add(std::to_string(value));
  return *this;
}

CsvRow &CsvRow::operator<<(long value)
{
  add(std::to_string(value));
  return *this;
}

CsvRow &CsvRow::operator<<(const std::string &text)
{
  if (text.find_first_of(no_part_of_cells) != std::string::npos)
    throw InvalidParameter("table cell '" + text + "' contains a comma, a quote or a line end");
  add(text);
  return *this;
}

void CsvRow::add(const std::string &cell)
{
  text_ += (size_++ > 0 ? "," : "") + cell;
}

CsvTable::CsvTable(const std::filesystem::path &file, std::vector<std::string> columns)
    : file_(file), columns_(std::move(columns))
{
  for (const auto &name : columns_)
    if (name.find_first_of(no_part_of_cells) != std::string::npos)
      throw InvalidParameter("table " + file_.string() + ": the column name '" + name +
                             "' contains a comma, a quote or a line end");
  replace_file(file_, join(columns_) + "\n");
  open();
}

CsvTable CsvTable::resume(const std::filesystem::path &file, std::vector<std::string> columns, double time)
{
  if (!std::filesystem::exists(file))
    return CsvTable(file, std::move(columns));
  const auto time_column = std::find(columns.begin(), columns.end(), "time") - columns.begin();
  if (time_column == static_cast<std::ptrdiff_t>(columns.size()))
    throw InvalidParameter("table " + file.string() + " has no column 'time', so it cannot be resumed");

  std::ifstream stream(file);
  std::string   line;
  std::getline(stream, line);
  if (line != join(columns))
    throw FileError(file.string() + " has the columns " + line + ", expected " + join(columns) +
                    "; move it away or write to another folder");
  std::string kept = line + "\n";
  while (std::getline(stream, line))
    {
      // A line without its end was cut off while it was written.
      if (stream.eof())
        break;
      const auto text  = cell(line, time_column);
      double     value = 0.;
      const auto parse = std::from_chars(text.data(), text.data() + text.size(), value);
      if (parse.ec == std::errc() && value <= time)
        kept += line + "\n";
    }
  CsvTable table;
  table.file_    = file;
  table.columns_ = std::move(columns);
  replace_file(file, kept);
  table.open();
  return table;
}

void CsvTable::append(const CsvRow &row)
{
  if (row.size() != static_cast<int>(columns_.size()))
    throw DimensionMismatch("table " + file_.string() + ": a row of " + std::to_string(row.size()) + " cells for " +
                            std::to_string(columns_.size()) + " columns");
  stream_ << row.text() << '\n';
  stream_.flush();
  if (!stream_)
    throw FileError("cannot write to " + file_.string() + "; is there space left on the device?");
}

void CsvTable::open()
{
  stream_.open(file_, std::ios::app);
  if (!stream_)
    throw FileError("cannot open " + file_.string() + " for writing");
}

} // namespace sherd
