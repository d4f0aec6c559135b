#pragma once

#include <limits>
#include <string>

/// Intervals of allowed values.
namespace sherd
{

/// Whether an end of an interval belongs to it.
enum class End
{
  excluded,
  included
};

/// An interval; contains no NaN, and infinity only if that end is included.
struct Range
{
  double min     = -std::numeric_limits<double>::infinity();
  double max     = std::numeric_limits<double>::infinity();
  End    min_end = End::excluded, max_end = End::excluded;

  bool contains(double value) const
  {
    return (min_end == End::included ? value >= min : value > min) &&
           (max_end == End::included ? value <= max : value < max);
  }

  /// "(-1, 0.5]", with square brackets where the end belongs to the interval.
  std::string text() const;
};

/// Common intervals by name.
namespace range
{
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Every finite value.
inline Range any()
{
  return {};
}
inline Range positive()
{
  return {0., infinity};
}
inline Range non_negative()
{
  return {0., infinity, End::included};
}
inline Range at_least(double min)
{
  return {min, infinity, End::included};
}
/// (min, max)
inline Range open(double min, double max)
{
  return {min, max};
}
/// [min, max]
inline Range closed(double min, double max)
{
  return {min, max, End::included, End::included};
}
/// (min, max]
inline Range left_open(double min, double max)
{
  return {min, max, End::excluded, End::included};
}
/// [min, max)
inline Range right_open(double min, double max)
{
  return {min, max, End::included, End::excluded};
}
} // namespace range

} // namespace sherd
