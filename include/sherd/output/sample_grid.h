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

/// The eight neighbours in the order N, NE, E, SE, S, SW, W, NW.
inline constexpr Sample sample_neighbours[8] = {{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}};

/// The broken samples of a lattice of n_i x n_j points, each with its depth below the threshold,
/// 255 (threshold - phi) / threshold rounded into 1..255. Everything else, and everything outside, has depth 0.
///
/// Stored as tiles of 64 x 64 bytes where something is set, so that size and cost follow the samples, not the lattice.
class SampleGrid
{
public:
  SampleGrid(int n_i, int n_j)
      : n_i_(n_i),
        n_j_(n_j),
        tiles_per_row_(((n_i + 1) >> shift) + 1),
        tile_(static_cast<std::size_t>(tiles_per_row_) * (((n_j + 1) >> shift) + 1), 0),
        depth_(tile_size, 0)
  {
  }

  int n_i() const { return n_i_; }
  int n_j() const { return n_j_; }

  /// Marks a sample that is not marked yet. @pre 0 <= i < n_i, 0 <= j < n_j, depth > 0
  void set(Sample s, std::uint8_t depth)
  {
    auto &tile = tile_[tile_index(s)];
    if (tile == 0)
      {
        tile = depth_.size();
        depth_.resize(depth_.size() + tile_size, 0);
      }
    depth_[tile + inside_tile(s)] = depth;
    samples_.push_back(s);
  }

  /// Clears a sample that was set; it stays in the list.
  void erase(Sample s) { depth_[tile_[tile_index(s)] + inside_tile(s)] = 0; }

  /// Depth of a sample of the lattice or of its border. @pre -1 <= i <= n_i, -1 <= j <= n_j
  std::uint8_t depth(Sample s) const { return depth_[tile_[tile_index(s)] + inside_tile(s)]; }

  /// Depth anywhere, 0 outside the lattice.
  std::uint8_t depth_or_zero(Sample s) const
  {
    return s.i < 0 || s.i >= n_i_ || s.j < 0 || s.j >= n_j_ ? std::uint8_t(0) : depth(s);
  }

  /// Which of the eight neighbours are set, bit k for sample_neighbours[k]. @pre s in the lattice
  unsigned neighbour_mask(Sample s) const
  {
    const unsigned x = (s.i + 1) & mask, y = (s.j + 1) & mask;
    unsigned       result = 0;
    if (x > 0 && x < mask && y > 0 && y < mask)
      {
        const auto *p = &depth_[tile_[tile_index(s)] + inside_tile(s)];
        for (int k = 0; k < 8; ++k)
          result |= unsigned(p[sample_neighbours[k].j * (1 << shift) + sample_neighbours[k].i] != 0) << k;
      }
    else
      for (int k = 0; k < 8; ++k)
        result |= unsigned(depth({s.i + sample_neighbours[k].i, s.j + sample_neighbours[k].j}) != 0) << k;
    return result;
  }

  /// The samples in the order they were set.
  const std::vector<Sample> &samples() const { return samples_; }

private:
  static constexpr int         shift     = 6;
  static constexpr unsigned    mask      = (1u << shift) - 1;
  static constexpr std::size_t tile_size = 1u << (2 * shift);

  // The border of unset samples shifts indices by one.
  std::size_t tile_index(Sample s) const
  {
    return static_cast<std::size_t>((s.j + 1) >> shift) * tiles_per_row_ + ((s.i + 1) >> shift);
  }

  static std::size_t inside_tile(Sample s) { return (((s.j + 1) & mask) << shift) | ((s.i + 1) & mask); }

  int                       n_i_, n_j_, tiles_per_row_;
  std::vector<std::size_t>  tile_; ///< start of each tile in depth_; the first tile of depth_ is empty for good
  std::vector<std::uint8_t> depth_;
  std::vector<Sample>       samples_;
};

/// Thins the broken set to 8-connected lines of one sample width that have the same components and holes, and ends
/// about half a band width before those of the set.  theory L
///
/// Two-pass parallel thinning (Guo and Hall 1989), then one-by-one removal of samples whose removal keeps the
/// topology and that are not ends. Deterministic. The cost is proportional to the number of samples.
/// @return the remaining samples in ascending order
std::vector<Sample> thin(SampleGrid grid);

} // namespace sherd
