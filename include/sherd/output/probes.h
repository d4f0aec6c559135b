#pragma once

#include <optional>

#include <sherd/geometry/place.h>
#include <sherd/output/csv_table.h>
#include <sherd/state/snapshot.h>

namespace sherd
{

/// A point to be watched.
template <int spacedim>
struct PointProbe
{
  std::string     name;
  Point<spacedim> X; ///< on the reference surface
};

/// probes.csv: displacement and phi at named points, reactions on named edges.
///
/// Columns `time`, for each point `NAME.ux,NAME.uy[,NAME.uz],NAME.phi`, for each edge `NAME.rx,NAME.ry[,NAME.rz]`.
/// Reactions are the forces that supports and loads of the edge exert on the body [force]; the caller computes them.
template <int spacedim>
class Probes
{
public:
  /// @throws InvalidParameter   a name that is used twice, empty, or holds a comma, quote or line end; a point further
  ///                            than a hundredth of the size of the surface away from it
  template <int degree>
  Probes(const std::filesystem::path &directory, const Surface<degree, spacedim> &surface,
         const std::vector<PointProbe<spacedim>> &points, const std::vector<std::string> &edges);

  /// The same, going on with the rows up to @p time (CsvTable::resume).
  template <int degree>
  static Probes resume(const std::filesystem::path &directory, const Surface<degree, spacedim> &surface,
                       const std::vector<PointProbe<spacedim>> &points, const std::vector<std::string> &edges,
                       double time);

  /// Writes a row. @param reactions   one for each edge, in the order of the constructor
  template <int degree>
  void append(const Surface<degree, spacedim> &surface, const Snapshot<spacedim> &snapshot,
              const std::vector<Point<spacedim>> &reactions);

private:
  Probes(std::vector<SurfacePlace> places, CsvTable table) : places_(std::move(places)), table_(std::move(table)) {}

  std::vector<SurfacePlace> places_;
  CsvTable                  table_;
};

} // namespace sherd
