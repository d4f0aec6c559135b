#pragma once

#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/assembly/cell_scatter.h>
#include <sherd/forms/interface_angle.h>
#include <sherd/forms/interface_phase.h>
#include <sherd/space/shell_space.h>

namespace sherd
{

/// Continuity across the interfaces of a surface, by penalty or by multipliers as the space says (theory G): of the
/// angle between patches where the shell has a bending stiffness, of the phase field where its density is of fourth
/// order.
///
/// A multiplier point has a block of n_fields entries. Entry 0 of its position is the multiplier q of the angle, its
/// phase value is that of the phase; the others are not used and have the equation dx = 0. Multipliers are slightly
/// compliant, K_qq = -int dS/eps with eps of theory G.3 for beta = 1e8: the penalty of that factor, reached without its
/// condition number. So constraints may depend on each other, as they do in corners (theory G.4). Where the sheet is
/// broken the angle keeps as much of its stiffness as the sheet does of its bending, see soften().
///
/// The loops over interfaces are serial; they are few.
template <class Model>
class InterfaceTerms
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;

  /// beta that the compliance of multipliers stands for.
  static constexpr double multiplier_factor = 1e8;

  /// @param ties   of the surface of @p space
  /// @throws InvalidParameter   a toughness that is not positive: on all ranks
  InterfaceTerms(const Model &model, const ShellSpace<degree, spacedim> &space, const std::vector<Tie> &ties);

  /// Lets go of the angle as far as the sheet is broken at @p phase: eps (p + (1 - p) g + r) with the mean of g(phi)
  /// over a piece, the share p of bending that a crack leaves, and r = 1e-6 for penalties and 1e-6 beta_0 / 1e8 for
  /// multipliers, beta_0 the default factor of penalties (theory G.4). A sheet that has nothing to resist a moment with
  /// would be turned over.
  void soften(const Model &model, const Vector &phase);

  /// Adds the forces on the owned control points and the residuals of owned multipliers, block n_fields, in the rows of
  /// the part.
  void add_force(const Vector &position, const Vector &phase, Unknowns part, Vector &force) const;

  /// The same and the tangent by the unknowns of the part.
  void linearise(const Vector &position, const Vector &phase, Unknowns part, Vector &force, Matrix &matrix) const;

  /// Gives a mass matrix the rows and columns of the multipliers that keep accelerations of a surface at rest
  /// compatible with the angles. @param part   of the matrix; has the displacement
  void constrain_acceleration(const Vector &position, Unknowns part, Matrix &mass) const;

  /// Sets 1 on the diagonal of every entry of the multipliers.
  void set_identity(Matrix &matrix) const;

  /// Energy of the penalties, or int q g dS less that of the compliance, on the pieces that this rank owns.
  double energy(const Vector &position, const Vector &phase) const;

  /// Largest mean defects of the constraints over the pieces of this rank; zero without multipliers.
  struct Defects
  {
    double angle = 0.; ///< |r_q| / length of the piece
    double phase = 0.; ///< l0 |r_q| / length of the piece
  };
  Defects defects(const Vector &residual) const;

  /// Local points that are multipliers, ghosts included.
  const std::vector<int> &multipliers() const { return multipliers_; }

  /// Whether a local point is a multiplier.
  bool is_multiplier(int local) const { return is_multiplier_[local]; }

  /// Forces that penalties make of a rounding error of the coordinates, per length of that error: the largest eps/h
  /// [force/length] of this rank.
  double sensitivity() const { return sensitivity_; }

private:
  struct Cell
  {
    InterfaceTables<degree, spacedim> tables;
    CellScatter<n_fields>             scatter;
    int                               multiplier = -1; ///< local point
    bool                              owned;
    double                            intact_stiffness = 0.; ///< eps of the angle; 0: nothing asks for it
    double                            lasting          = 0.; ///< share p of it that a crack leaves
    double                            softening        = 1.; ///< share of eps that the sheet as it is has
    double                            phase_compliance = 0.; ///< -K_qq of the phase
    Eigen::MatrixXd                   phase_penalty;         ///< shape=(n, n) or empty
    Eigen::VectorXd                   phase_jump;            ///< shape=(n) or empty

    Eigen::Index n() const { return static_cast<Eigen::Index>(tables.points.size()); }
    bool         has_multiplier() const { return multiplier >= 0; }
    bool         has_angle_terms() const { return intact_stiffness > 0.; }
    bool         has_angle_multiplier() const { return has_multiplier() && has_angle_terms(); }
    bool         has_phase_multiplier() const { return phase_compliance > 0.; }
    double       angle_stiffness() const { return softening * intact_stiffness; }       ///< eps of a penalty
    double       angle_compliance() const { return tables.length / angle_stiffness(); } ///< -K_qq of a multiplier
  };

  /// Arrays of a piece on its points, index point * n_fields + field.
  struct Arrays
  {
    Eigen::VectorXd force;
    Eigen::MatrixXd tangent;
  };
  enum class Wanted
  {
    force,
    force_and_tangent,
    constraint_rows ///< those of the angle in the tangent
  };

  void   set_phase_terms(const Model &model, Cell &cell, double beta) const;
  Arrays arrays(const Cell &cell, const Vector &position, const Vector &phase, Unknowns part, Wanted wanted) const;
  void   add_angle(const Cell &cell, const Vector &position, Wanted wanted, Arrays &arrays) const;
  void   add_phase(const Cell &cell, const Vector &phase, Wanted wanted, Arrays &arrays) const;

  double            length_scale_;
  int               n_owned_;
  std::vector<Cell> cells_;
  std::vector<int>  multipliers_;
  std::vector<char> is_multiplier_; ///< shape=(n_local)
  double            sensitivity_ = 0.;
};

} // namespace sherd

#include <sherd/assembly/interface_terms.templates.h>
