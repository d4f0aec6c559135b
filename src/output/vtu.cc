#include <sherd/output/vtu.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>

#include <zlib.h>

#include <sherd/base/exceptions.h>
#include <sherd/output/csv_table.h>

namespace sherd
{
namespace
{

constexpr std::uint8_t vtk_bezier_quadrilateral = 77;

/// The arrays behind the XML header, each as vtkZLibDataCompressor has it: number of blocks, size of a full block, size
/// of the last block if it is not full (0 if it is), compressed sizes, all UInt64; then the compressed blocks.
class AppendedData
{
public:
  /// Appends an array and returns its offset.
  template <class T>
  std::size_t add(const std::vector<T> &values)
  {
    return add(reinterpret_cast<const unsigned char *>(values.data()), values.size() * sizeof(T));
  }

  const std::string &bytes() const { return bytes_; }

private:
  std::size_t add(const unsigned char *data, std::size_t size)
  {
    constexpr std::size_t      block    = 1u << 17;
    constexpr int              level    = 4; // beyond it, files shrink by less than a tenth and take twice the time
    const std::size_t          offset   = bytes_.size();
    const std::size_t          n_blocks = (size + block - 1) / block;
    std::vector<std::uint64_t> header   = {n_blocks, block, size % block};
    std::string                compressed;
    std::vector<Bytef>         buffer(compressBound(block));
    for (std::size_t k = 0; k < n_blocks; ++k)
      {
        uLongf     length = buffer.size();
        const auto status =
            compress2(buffer.data(), &length, data + k * block, std::min(block, size - k * block), level);
        if (status != Z_OK)
          throw FileError("frame: zlib cannot compress (status " + std::to_string(status) + ")");
        header.push_back(length);
        compressed.append(reinterpret_cast<const char *>(buffer.data()), length);
      }
    bytes_.append(reinterpret_cast<const char *>(header.data()), header.size() * sizeof(std::uint64_t));
    bytes_ += compressed;
    return offset;
  }

  std::string bytes_;
};

std::string data_array(const std::string &type, const std::string &name, int n_components, std::size_t offset)
{
  return "        <DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(n_components) + "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
}

void check_size(const std::string &name, std::size_t size, std::size_t expected)
{
  if (size != expected)
    throw DimensionMismatch("frame: array '" + name + "' has " + std::to_string(size) + " values, expected " +
                            std::to_string(expected));
}

/// The value of an attribute in a line of XML.
std::string attribute(const std::string &line, const std::string &name)
{
  const auto start = line.find(" " + name + "=\"");
  if (start == std::string::npos)
    return {};
  const auto from = start + name.size() + 3;
  return line.substr(from, line.find('"', from) - from);
}

} // namespace

std::vector<int> vtk_bezier_order(int degree)
{
  const int        p = degree, n = degree + 1;
  std::vector<int> order = {0, p, n * p + p, n * p};
  for (int i = 1; i < p; ++i)
    order.push_back(i);
  for (int j = 1; j < p; ++j)
    order.push_back(n * j + p);
  for (int i = 1; i < p; ++i)
    order.push_back(n * p + i);
  for (int j = 1; j < p; ++j)
    order.push_back(n * j);
  for (int j = 1; j < p; ++j)
    for (int i = 1; i < p; ++i)
      order.push_back(n * j + i);
  return order;
}

std::string vtu_text(const BezierGrid &grid)
{
  const std::size_t n_points = grid.points.size(), n_cells = grid.n_cells();
  const int         n_b = (grid.degree + 1) * (grid.degree + 1);
  check_size("RationalWeights", grid.weights.size(), n_points);
  check_size("connectivity", grid.cells.size(), n_cells * n_b);

  AppendedData              data;
  std::string               points, cells, point_data, cell_data;
  std::vector<std::int32_t> offsets;
  for (std::size_t e = 1; e <= n_cells; ++e)
    offsets.push_back(static_cast<std::int32_t>(e * n_b));
  std::vector<double> degrees;
  for (std::size_t e = 0; e < n_cells; ++e)
    degrees.insert(degrees.end(), {double(grid.degree), double(grid.degree), 0.});

  points = data_array("Float64", "Points", 3, data.add(grid.points));
  cells  = data_array("Int32", "connectivity", 1, data.add(grid.cells)) +
          data_array("Int32", "offsets", 1, data.add(offsets)) +
          data_array("UInt8", "types", 1, data.add(std::vector<std::uint8_t>(n_cells, vtk_bezier_quadrilateral)));
  point_data = data_array("Float64", "RationalWeights", 1, data.add(grid.weights));
  for (const auto &array : grid.point_data)
    {
      check_size(array.name, array.values.size(), n_points * array.n_components);
      point_data += data_array("Float32", array.name, array.n_components, data.add(array.values));
    }
  cell_data = data_array("Float64", "HigherOrderDegrees", 3, data.add(degrees));
  for (const auto &array : grid.cell_data)
    {
      check_size(array.name, array.values.size(), n_cells * array.n_components);
      cell_data += data_array("Float32", array.name, array.n_components, data.add(array.values));
    }

  const std::uint16_t probe         = 1;
  const bool          little_endian = reinterpret_cast<const unsigned char &>(probe) == 1;
  return std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"") +
         (little_endian ? "LittleEndian" : "BigEndian") +
         "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n"
         "    <Piece NumberOfPoints=\"" +
         std::to_string(n_points) + "\" NumberOfCells=\"" + std::to_string(n_cells) + "\">\n      <Points>\n" + points +
         "      </Points>\n      <Cells>\n" + cells +
         "      </Cells>\n      <PointData RationalWeights=\"RationalWeights\">\n" + point_data +
         "      </PointData>\n      <CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n" + cell_data +
         "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _" +
         data.bytes() + "\n  </AppendedData>\n</VTKFile>\n";
}

std::string pvd_text(const std::vector<PvdEntry> &entries)
{
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const auto &entry : entries)
    text += "    <DataSet timestep=\"" + exact(entry.time) + "\" file=\"" + entry.file + "\"/>\n";
  return text + "  </Collection>\n</VTKFile>\n";
}

std::vector<PvdEntry> read_pvd(const std::filesystem::path &file)
{
  std::vector<PvdEntry> entries;
  std::ifstream         stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.find("<DataSet") != std::string::npos)
      {
        const auto time  = attribute(line, "timestep");
        PvdEntry   entry = {0., attribute(line, "file")};
        const auto parse = std::from_chars(time.data(), time.data() + time.size(), entry.time);
        if (parse.ec != std::errc() || entry.file.empty())
          throw FileError(file.string() + ": cannot read '" + line + "'; expected timestep and file");
        entries.push_back(entry);
      }
  return entries;
}

} // namespace sherd
