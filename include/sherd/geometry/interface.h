#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <sherd/geometry/patch.h>

namespace sherd
{

/// One side of one patch.
struct Edge
{
  int  patch;
  Side side;
};

/// Two sides that are one curve of the surface. They carry the same functions along the curve with the same weights and
/// control points; which of the two is called first does not matter. A patch may be joined to itself, as at the seam of
/// a closed surface.
struct Interface
{
  Edge first, second;
  bool reversed; ///< the parameter along `second` runs against that along `first`
};

/// "side u_max of patch 2".
std::string describe(const Edge &edge);

namespace internal
{

inline int normal_direction(Side side)
{
  return side == Side::u_min || side == Side::u_max ? 0 : 1;
}
inline bool at_maximum(Side side)
{
  return side == Side::u_max || side == Side::v_max;
}

/// Places along a side as whole numbers: 2^30 for each initial knot span, dyadic inside. All knots come from bisection
/// of the initial ones, so that equal knots of two sides have equal marks, exactly, whatever the ranges of their
/// parameters.
class SideRuler
{
public:
  using Mark = std::int64_t;

  /// @param initial_knots   of the patch along the side, with repetitions
  /// @param reversed        marks count from the other end
  SideRuler(const std::vector<double> &initial_knots, bool reversed);

  /// Mark of a knot. @throws InvalidParameter   if bisection of the initial knots does not lead to it
  Mark mark(double parameter) const;

  /// The knot at a mark, by bisection: bit by bit that of a refinement.
  double parameter(Mark mark) const;

private:
  static constexpr Mark unit = Mark(1) << 30;

  std::vector<double> knots_; ///< distinct
  bool                reversed_;
};

/// One function that does not vanish on a side, by its knots along it.
template <int degree>
struct SideFunction
{
  std::array<SideRuler::Mark, degree + 2> marks; ///< ascending
  int                                     index; ///< in the basis
};

/// The functions that do not vanish on a side, ascending by marks; no two of them have the same.
template <int degree>
std::vector<SideFunction<degree>> side_functions(const LRBasis<degree> &basis, Side side, bool reversed);

/// Mesh lines that bring the functions along @p side closer to those of the side it is joined to: where a function has
/// no equal there, the knots that it lacks; together with the midlines of all its spans (theory H.4) if the other side
/// has those along it. Functions that lack only some of them wait until there are no others. Empty if the sides agree.
/// theory H.6
/// @param own, other   functions of both sides with marks that count in the same direction
template <int degree>
std::vector<MeshLine> closing_lines(const LRBasis<degree> &basis, const Edge &edge, const SideRuler &ruler,
                                    const std::vector<SideFunction<degree>> &own,
                                    const std::vector<SideFunction<degree>> &other, const SpanTarget &target);

} // namespace internal

} // namespace sherd
