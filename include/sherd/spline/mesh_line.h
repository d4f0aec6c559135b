#pragma once

#include <array>

namespace sherd
{

/// Parameter direction of a patch.
enum class Direction
{
  u = 0,
  v = 1
};

/// The other parameter direction.
constexpr Direction across(Direction d)
{
  return d == Direction::u ? Direction::v : Direction::u;
}

/// Axis-parallel line of an LR mesh. Direction u: the line u = value spanning v in [start, end]; direction v: the line
/// v = value spanning u in [start, end]. Splines are C^(degree - multiplicity) across it.  theory H.1
struct MeshLine
{
  Direction direction;
  double    value, start, end;
  int       multiplicity = 1;

  bool operator==(const MeshLine &) const = default;
};

/// Rectangle of the parameter domain, (u, v).
struct Box
{
  std::array<double, 2> min, max;

  std::array<double, 2> size() const { return {max[0] - min[0], max[1] - min[1]}; }

  std::array<double, 2> centre() const { return {0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1])}; }

  double area() const { return (max[0] - min[0]) * (max[1] - min[1]); }

  bool operator==(const Box &) const = default;
};

/// True if @p inner lies in @p outer; compares exactly.
inline bool contains(const Box &outer, const Box &inner)
{
  return outer.min[0] <= inner.min[0] && inner.max[0] <= outer.max[0] && outer.min[1] <= inner.min[1] &&
         inner.max[1] <= outer.max[1];
}

} // namespace sherd
