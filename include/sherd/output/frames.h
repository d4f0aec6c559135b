#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>

#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/surface.h>
#include <sherd/output/replace_file.h>
#include <sherd/output/vtu.h>
#include <sherd/state/snapshot.h>

namespace sherd
{

/// A value per element for the frames, for example an energy density.
struct ElementField
{
  std::string         name;
  std::vector<double> values; ///< shape=(n_elements)
};

/// The deformed surface with its fields as Bezier cells: points x (z = 0 in the plane) with their weights; point data
/// phi, displacement x - X and velocity as Bezier coefficients; cell data level, how often the largest element of the
/// patch has been halved, if there are several patches their number, and @p fields. Control points on common edges of
/// equal elements are one point of the grid.
/// @throws DimensionMismatch   if snapshot or fields do not fit the surface
template <int degree, int spacedim>
BezierGrid bezier_grid(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot,
                       const std::vector<ElementField> &fields = {});

/// Writes bezier_grid() to @p file, replacing it in one step. For the rank that holds the snapshot.
/// @throws FileError   if it cannot be written
template <int degree, int spacedim>
void write_frame(const std::filesystem::path &file, const Surface<degree, spacedim> &surface,
                 const Snapshot<spacedim> &snapshot, const std::vector<ElementField> &fields = {})
{
  replace_file(file, vtu_text(bezier_grid(surface, snapshot, fields)));
}

/// Numbers the frames of a run: DIR/frames/000000.vtu, 000001.vtu, ... and DIR/frames.pvd with their times.
class FrameWriter
{
public:
  explicit FrameWriter(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// Goes on behind the frames up to @p time that DIR/frames.pvd names; later ones will be overwritten.
  static FrameWriter resume(std::filesystem::path directory, double time)
  {
    FrameWriter writer(std::move(directory));
    writer.entries_ = read_pvd(writer.directory_ / "frames.pvd");
    std::erase_if(writer.entries_, [&](const auto &entry) { return entry.time > time; });
    return writer;
  }

  int n_frames() const { return static_cast<int>(entries_.size()); }

  /// Writes the next frame, then the list that names it.
  template <int degree, int spacedim>
  void write(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot,
             const std::vector<ElementField> &fields = {})
  {
    char name[32];
    std::snprintf(name, sizeof(name), "frames/%06d.vtu", n_frames());
    write_frame(directory_ / name, surface, snapshot, fields);
    entries_.push_back({snapshot.time, name});
    replace_file(directory_ / "frames.pvd", pvd_text(entries_));
  }

private:
  std::filesystem::path directory_;
  std::vector<PvdEntry> entries_;
};

} // namespace sherd
