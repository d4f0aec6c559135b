#pragma once

namespace sherd
{

/// What readers of geometry files do with patches of a lower degree than that of the surface.
enum class LowerDegree
{
  refuse, ///< an error
  /// Raises the degree without changing the surface (to rounding). Functions across the knots of the file stay as
  /// smooth as they were: a knot between elements of degree 1 becomes a C0 line, for split_at_c0_lines() to cut at.
  elevate
};

} // namespace sherd
