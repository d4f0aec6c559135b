#pragma once

#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/assembly/cell_scatter.h>
#include <sherd/forms/weak_edge.h>
#include <sherd/space/shell_space.h>
#include <sherd/space/supports.h>

namespace sherd
{

/// Conditions along edges by penalty, as Supports::weak_edges names them: a normal that is held or turned, one that
/// stays in a plane of symmetry, a phase field that is level across the edge. The factors are those of interfaces.
///
/// A normal is kept where the shell has a bending stiffness, the phase where its density is of fourth order; elsewhere
/// the natural conditions are those of a plane of symmetry, and nothing is added.
///
/// The loops over edges are serial; they are few. Source: theory G.3, G.5.
template <class Model>
class WeakEdgeTerms
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;

  /// @param ties   of the surface of @p space
  /// @throws InvalidParameter   an edge that does not exist, a negative factor; a normal that is held on a surface
  ///                            without a bending stiffness; a plane of symmetry that the surface does not meet at
  ///                            right angles: on all ranks
  WeakEdgeTerms(const Model &model, const ShellSpace<degree, spacedim> &space, const std::vector<Tie> &ties,
                const std::vector<Supports::WeakEdge> &edges);

  /// Adds the forces on the owned control points at @p time, block n_fields, in the rows of the part.
  void add_force(const Vector &position, const Vector &phase, double time, Unknowns part, Vector &force) const;

  /// The same and the tangent by the unknowns of the part.
  void linearise(const Vector &position, const Vector &phase, double time, Unknowns part, Vector &force,
                 Matrix &matrix) const;

  /// Adds the derivative of the forces by time.
  void add_force_rate(const Vector &position, double time, Vector &rate) const;

  /// Energy of the penalties on the pieces that this rank owns.
  double energy(const Vector &position, const Vector &phase, double time) const;

  /// Work that turning edges do on the surface between two times, held at @p position, on the pieces that this rank
  /// owns: the change of the energy of the penalties.
  double work(const Vector &position, double from, double to) const;

  /// As InterfaceTerms::sensitivity: the largest eps/h [force/length] of this rank.
  double sensitivity() const { return sensitivity_; }

private:
  using HeldNormal      = Supports::WeakEdge::HeldNormal;
  using SymmetricNormal = Supports::WeakEdge::SymmetricNormal;
  using LevelPhase      = Supports::WeakEdge::LevelPhase;
  using Geometry        = EdgeGeometry<degree, spacedim>;

  /// One element's part of an edge.
  struct Cell
  {
    Geometry              piece;
    CellScatter<n_fields> scatter;
    int                   edge;           ///< index into edges_
    bool                  owned;          ///< counts its energy
    double                stiffness = 0.; ///< eps of the normal [force]
    Eigen::MatrixXd       phase_penalty;  ///< shape=(n, n), with ties on both sides; or empty

    Eigen::Index n() const { return static_cast<Eigen::Index>(piece.points.size()); }
    bool acts_on(Unknowns part) const { return phase_penalty.size() > 0 ? has_phase(part) : has_displacement(part); }
  };

  void                 add_cell(const Model &model, Geometry piece, Cell cell, double beta);
  void                 check_plane(const Geometry &piece, const Supports::WeakEdge &edge) const;
  PieceNormals<degree> target(const Cell &cell, double time, double turn = 0.) const;
  Point<3>             axis(const Cell &cell) const;
  Eigen::VectorXd      force(const Cell &cell, const Vector &position, const Vector &phase, double time) const;
  Eigen::MatrixXd      tangent(const Cell &cell, const Vector &position, double time) const;
  Eigen::VectorXd      on_points(const Cell &cell, const ControlValues<spacedim> &f) const;
  const HeldNormal    *held(const Cell &cell) const { return std::get_if<HeldNormal>(&edges_[cell.edge].condition); }

  std::vector<Supports::WeakEdge> edges_;
  std::vector<Cell>               cells_;
  double                          sensitivity_ = 0.;
};

} // namespace sherd

#include <sherd/assembly/weak_edge_terms.templates.h>
