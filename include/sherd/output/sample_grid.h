#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace sherd
{

/// A point of a sample lattice: index along u, index along v.
struct Sample
{
  int i, j;

  auto operator<=>(const Sample &) const = default;
};

/// The broken samples of a lattice of n_i x n_j points, each with its depth below the threshold,
/// 255 (threshold - phi) / threshold rounded into 1..255. Everything else, and everything outside, has depth 0.
///
/// A dense array of bytes, bordered by zeros, beside the list of what is set.
class SampleGrid
{
public:
  SampleGrid(int n_i, int n_j)
      : n_i_(n_i), n_j_(n_j), stride_(n_i + 2), depth_((static_cast<std::size_t>(n_i) + 2) * (n_j + 2), 0)
  {}

  int n_i() const { return n_i_; }
  int n_j() const { return n_j_; }

  /// Marks a sample that is not marked yet. @pre 0 <= i < n_i, 0 <= j < n_j, depth > 0
  void set(Sample s, std::uint8_t depth)
  {
    depth_[index(s)] = depth;
    samples_.push_back(s);
  }

  /// Clears a sample; it stays in the list.
  void erase(Sample s) { depth_[index(s)] = 0; }

  /// Depth of a sample of the lattice or of its border. @pre -1 <= i <= n_i, -1 <= j <= n_j
  std::uint8_t depth(Sample s) const { return depth_[index(s)]; }

  /// Depth anywhere, 0 outside the lattice.
  std::uint8_t depth_or_zero(Sample s) const
  {
    return s.i < 0 || s.i >= n_i_ || s.j < 0 || s.j >= n_j_ ? std::uint8_t(0) : depth(s);
  }

  /// The samples in the order they were set.
  const std::vector<Sample> &samples() const { return samples_; }

private:
  std::size_t index(Sample s) const { return static_cast<std::size_t>(s.j + 1) * stride_ + (s.i + 1); }

  int                       n_i_, n_j_;
  std::size_t               stride_;
  std::vector<std::uint8_t> depth_;
  std::vector<Sample>       samples_;
};

/// The eight neighbours in the order N, NE, E, SE, S, SW, W, NW.
inline constexpr Sample sample_neighbours[8] = {{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}};

/// Thins the broken set to 8-connected lines of one sample width that have the same components and holes, and ends
/// about half a band width before those of the set.  theory L
///
/// Two-pass parallel thinning (Guo and Hall 1989), then one-by-one removal of samples whose removal keeps the
/// topology and that are not ends. Deterministic. The cost is proportional to the number of samples.
/// @return the remaining samples in ascending order
std::vector<Sample> thin(SampleGrid grid);

} // namespace sherd
