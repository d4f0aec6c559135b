#pragma once

#include <array>
#include <span>
#include <vector>

#include <sherd/spline/mesh_line.h>

namespace sherd
{

/// The lines of an LR mesh, collinear ones merged.  theory H.1, H.3
///
/// Each direction keeps its values in ascending order; a value keeps disjoint segments, each with one multiplicity.
/// Overlapping or touching lines merge; where lines overlap the larger multiplicity counts. Values are compared
/// exactly: knots come from bisection of the initial ones.
class LRMesh
{
public:
  /// A part of the line at one value on which the multiplicity is constant.
  struct Segment
  {
    double start, end;
    int    multiplicity;
  };

  /// All parts of the mesh at one value.
  struct Line
  {
    double               value;
    std::vector<Segment> segments; ///< disjoint, ascending; touching ones differ in multiplicity

    /// Smallest multiplicity on [start, end]; 0 if some part of it is not covered.
    int multiplicity(double start, double end) const;
  };

  /// Tensor mesh of two open knot vectors, all lines across the whole domain.
  LRMesh(std::span<const double> knots_u, std::span<const double> knots_v);

  /// Adds lines; where a line exists already the larger of the multiplicities counts.
  void add(std::span<const MeshLine> lines);

  /// Lines with value strictly between @p low and @p high, ascending.
  std::span<const Line> between(Direction direction, double low, double high) const;

  /// Smallest multiplicity of the line at @p value on [@p start, @p end]; 0 if some part of it is not covered.
  int multiplicity(Direction direction, double value, double start, double end) const;

  /// Each maximal segment on which the multiplicity is at least m, for m = 1, 2, ... (but a segment that is the same
  /// for m and m + 1 only once, with m + 1); sorted by direction, value, multiplicity, start.
  std::vector<MeshLine> lines() const;

private:
  std::array<std::vector<Line>, 2> lines_;
};

/// Merges overlapping or touching lines of equal direction, value and multiplicity; sorted by these and start.
std::vector<MeshLine> merged(std::vector<MeshLine> lines);

} // namespace sherd
