#pragma once

#include <filesystem>

#include <sherd/geometry/surface.h>
#include <sherd/state/snapshot.h>

namespace sherd
{

/// One patch in the form of fields.h5; all arrays row by row.
struct PatchArrays
{
  std::vector<double> knots;          ///< shape=(n_functions, 2, degree + 2), first u then v
  std::vector<double> gamma, weights; ///< shape=(n_functions)
  std::vector<double> control_points; ///< shape=(n_functions, spacedim)
  std::vector<double> elements;       ///< shape=(n_elements, 4): u_min, v_min, u_max, v_max
  std::vector<int>    points;         ///< row of each function in the arrays of a frame, shape=(n_functions)
};

/// The solution as splines, DIR/fields.h5: the mesh whenever it has changed, the coefficients of every frame,
/// compressed without loss. doc/output.md describes the layout. Serial: for the rank that holds the snapshot. A frame
/// is added to a copy that replaces the file, so that what is there stays readable whenever the program ends.
class FieldsFile
{
public:
  /// Starts a file anew. @throws FileError   if it cannot be written
  FieldsFile(const std::filesystem::path &directory, int degree, int spacedim);

  /// Goes on behind the frames up to @p time; later ones and their meshes are removed. Starts anew if there is no file.
  /// @throws FileError   if the file is of another degree or dimension, or cannot be read
  static FieldsFile resume(const std::filesystem::path &directory, int degree, int spacedim, double time);

  /// Appends a frame, and the mesh before it if it differs from that of the frame before.
  /// @throws DimensionMismatch   if the surface is of another degree or dimension, or the snapshot does not fit it
  /// @throws FileError           if it cannot be written
  template <int degree, int spacedim>
  void write(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot);

  int n_frames() const { return n_frames_; }

private:
  FieldsFile() = default;

  void append(const std::vector<PatchArrays> &patches, double time, const std::vector<double> &position,
              const std::vector<double> &velocity, const std::vector<double> &phase);
  void check(int degree, int spacedim, std::size_t n_points, std::size_t n_position, std::size_t n_velocity,
             std::size_t n_phase) const;

  std::filesystem::path    file_;
  int                      degree_ = 0, spacedim_ = 0, n_frames_ = 0, n_meshes_ = 0;
  std::vector<std::size_t> mesh_; ///< fingerprint of the last mesh written
};

} // namespace sherd
