#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace sherd
{

/// Values at points or in cells, shape=(n, n_components), written as 32 bit floats.
struct VtuArray
{
  std::string        name;
  int                n_components;
  std::vector<float> values;
};

/// An unstructured grid of rational Bezier quadrilaterals of one degree.
struct BezierGrid
{
  int                                degree;
  std::vector<std::array<double, 3>> points;
  std::vector<double>                weights; ///< shape=(n_points)
  std::vector<int>                   cells;   ///< points of the cells in VTK's order, shape=(n_cells, (degree+1)^2)
  std::vector<VtuArray>              point_data, cell_data;

  int n_cells() const { return static_cast<int>(cells.size()) / ((degree + 1) * (degree + 1)); }
};

/// VTK's numbering of the control points of a Bezier quadrilateral: entry k is the place j (degree+1) + i, i along u,
/// of VTK's point k. Corners counter-clockwise; the inner points of the sides v = 0, u = 1, v = 1, u = 0, in the
/// direction of growing parameter; the inside, u fastest.
std::vector<int> vtk_bezier_order(int degree);

/// Content of a .vtu file: cells VTK_BEZIER_QUADRILATERAL, point attribute RationalWeights, cell attribute
/// HigherOrderDegrees, and the fields; arrays appended as raw binary, compressed by zlib in blocks.
/// Positions and weights have 64 bits: curved rational cells are exact.
/// @throws DimensionMismatch   arrays that do not fit the points or the cells
std::string vtu_text(const BezierGrid &grid);

/// One file of a series and its time.
struct PvdEntry
{
  double      time;
  std::string file; ///< relative to the folder of the .pvd file
};

/// Content of a .pvd file, the list of a series that ParaView opens.
std::string pvd_text(const std::vector<PvdEntry> &entries);

/// Entries of a .pvd file written by pvd_text(); none if there is no such file.
/// @throws FileError   if a line is not understood
std::vector<PvdEntry> read_pvd(const std::filesystem::path &file);

} // namespace sherd
