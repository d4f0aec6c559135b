#pragma once

#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/assembly/interface_terms.h>
#include <sherd/assembly/load_values.h>
#include <sherd/assembly/scatter.h>
#include <sherd/assembly/tied_elements.h>
#include <sherd/assembly/weak_edge_terms.h>
#include <sherd/forms/element_energies.h>
#include <sherd/forms/orientation.h>
#include <sherd/forms/shell_element.h>
#include <sherd/geometry/edge_geometry.h>
#include <sherd/material/wave_speeds.h>
#include <sherd/state/state.h>

namespace sherd
{

/// The fields at the levels at which a time integrator balances momentum and phase (theory F.1).
struct BalanceLevel
{
  const Vector &position;     ///< x at n + alpha_f, block spacedim
  const Vector &acceleration; ///< a at n + alpha_m, block spacedim
  const Vector &phase;        ///< phi at n + 1, block 1

  /// Psi+ of the position, Assembler::active_energy, where it is known: then what needs it alone does not ask the
  /// material for it.
  const QuadratureField *active_energy = nullptr;
};

/// Elements with a quadrature point that may lie on the false branch (theory C.2).
struct SuspectElements
{
  std::vector<int> active;             ///< active elements of this rank
  double           largest_phase = 0.; ///< on this rank
};

/// The element loop: brings the weak forms of a model to distributed vectors and matrices, those on interfaces and
/// edges too.
///
/// Caches the geometry, the toughness and the stiffness of the active elements, so it belongs to one mesh and one
/// distribution: make a new one after each refinement. Threads: OMP_NUM_THREADS. The results do not depend on their
/// number.
template <class Model>
class Assembler
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;
  static constexpr int n_q      = ElementData<Model>::n_q;

  /// Model and space have to outlive the assembler. What acts on tied control values acts on their masters; their own
  /// rows and columns are empty but for a 1 on the diagonal. Collective.
  /// @param ties         of the surface of @p space
  /// @param weak_edges   Supports::weak_edges()
  /// @throws InvalidParameter   a degenerate element, a toughness or stiffness not positive; from InterfaceTerms
  ///                            and WeakEdgeTerms: on all ranks
  Assembler(const Model &model, const ShellSpace<degree, spacedim> &space,
            std::shared_ptr<const Distribution> distribution, const std::vector<Tie> &ties = {},
            const std::vector<Supports::WeakEdge> &weak_edges = {});

  const Model                               &model() const { return *model_; }
  const ShellSpace<degree, spacedim>        &space() const { return *space_; }
  const std::shared_ptr<const Distribution> &distribution() const { return distribution_; }

  /// Shortest element edge of the whole reference surface [length], theory F.3.
  double shortest_edge() const { return shortest_edge_; }

  /// Largest factor of the moduli at a quadrature point of the whole surface.
  double largest_stiffness() const { return largest_stiffness_; }

  /// Wave speeds of the undamaged surface where it is stiffest: they bound steps and speeds everywhere (theory F.3).
  WaveSpeeds fastest_waves() const
  {
    return wave_speeds(largest_stiffness_ * model_->split.bulk(), largest_stiffness_ * model_->split.shear(),
                       model_->mass);
  }

  /// int Gc/(2 l0) N_A dA of every owned control point, the scale of its phase residual (theory F.2), shape=(n_owned).
  const std::vector<double> &phase_scale() const { return phase_scale_; }

  /// int N_A dA of every owned control point [length^2], shape=(n_owned).
  const std::vector<double> &point_area() const { return point_area_; }

  /// Continuity across interfaces. Its multipliers are points without mass; what is said by control point here is 0
  /// for them.
  const InterfaceTerms<Model> &interfaces() const { return interfaces_; }

  /// Softens them where the sheet is broken at @p phase, InterfaceTerms::soften(): to be told at the start of each
  /// step.
  void soften_interfaces(const Vector &phase) { interfaces_.soften(*model_, phase); }

  /// Weak conditions on edges, at the time of the loads that go with a call.
  const WeakEdgeTerms<Model> &weak_edges() const { return weak_edges_; }

  /// Forces that penalties on interfaces and edges make of a rounding error of the coordinates, per length of that
  /// error [force/length]. Of this rank.
  double sensitivity() const { return std::max(interfaces_.sensitivity(), weak_edges_.sensitivity()); }

  /// Matrix with the graph of the space for the unknowns of a part, zero.
  Matrix make_matrix(Unknowns part = Unknowns::all) const
  {
    return Matrix(distribution_, space_->distribution().graph, fields_of(part, spacedim).count);
  }

  /// Internal and inertial forces and the phase residual on the owned control points, block n_fields.
  void force(const BalanceLevel &level, const QuadratureField &history, Vector &force) const;

  /// The same with loads: also the external force on the owned control points, block n_fields.
  void force(const BalanceLevel &level, const QuadratureField &history, const LoadValues<Model> &loads, Vector &force,
             Vector &external) const;

  /// Internal forces and the tangent; mass_weight * M is added to its displacement block.
  void linearise(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                 PhaseTangent phase_tangent, Vector &force, Matrix &matrix) const;

  /// The same with loads: the external force on the owned control points, block n_fields, and the tangent of
  /// (internal - external).
  void linearise(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                 PhaseTangent phase_tangent, const LoadValues<Model> &loads, Vector &force, Vector &external,
                 Matrix &matrix) const;

  /// Forces with loads of the unknowns of a part alone: other rows of @p force get 0. The phase has no external force;
  /// for it @p external is left as it is. Give the level its active energy where the phase changes more often than the
  /// position.
  template <Unknowns part>
  void part_force(const BalanceLevel &level, const QuadratureField &history, const LoadValues<Model> &loads,
                  Vector &force, Vector &external) const;

  /// The same and the tangent by these unknowns, in a make_matrix(part): half of the system where displacement and
  /// phase are solved for in turn.
  template <Unknowns part>
  void linearise_part(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                      PhaseTangent phase_tangent, const LoadValues<Model> &loads, Vector &force, Vector &external,
                      Matrix &matrix) const;

  /// Psi+ at the quadrature points of the active elements [energy/area].
  QuadratureField active_energy(const BalanceLevel &level) const;

  /// M in the displacement block, 1 on the diagonal of the phase and of multipliers.
  void mass_matrix(Matrix &matrix) const;

  /// The same in a make_matrix(part). @tparam part   has the displacement
  template <Unknowns part>
  void part_mass_matrix(Matrix &matrix) const;

  /// Loads of one time. Collective.
  /// @throws InvalidParameter   an edge that does not exist, a point load away from the surface
  LoadValues<Model> evaluate(const Loads<spacedim> &loads, double time) const;

  /// External force of a deformed surface on the owned control points, block n_fields.
  void external_force(const BalanceLevel &level, const LoadValues<Model> &loads, Vector &force) const;

  /// Energies of a state at a time, summed over ranks. Collective.
  Energies energies(const Vector &position, const Vector &velocity, const Vector &phase, double time = 0.) const;

  /// Work that the history withholds in a step from phase @p previous to the level's, summed over ranks (theory D).
  /// @p history is that of the end of the step, committed(level, ...). Collective.
  double withheld_work(const BalanceLevel &level, const Vector &previous, const QuadratureField &history) const;

  /// Work of the inertial force over a step, M a . dx, summed over ranks. Collective.
  double inertial_work(const Vector &acceleration, const Vector &displacement) const;

  /// The memory after a step, by the irreversibility rule of the model: max(H, Psi+) of the level for a history.
  QuadratureField committed(const BalanceLevel &level, const QuadratureField &history) const;

  /// Largest remembered H over the onset of damage (theory C.2) at a quadrature point of each active element,
  /// shape=(n_active). Rules without a history remember none.
  std::vector<double> intensity(const QuadratureField &history) const;

  /// Elements with suspect quadrature points, theory C.2 1. Local.
  SuspectElements suspects(const BalanceLevel &level, const QuadratureField &history) const;

  /// Number of owned active elements that turn inside out from position @p before to @p after (keeps_orientation).
  int n_turned(const Vector &before, const Vector &after) const;

  /// Of every owned active element.
  std::vector<ElementDensities> densities(const Vector &position, const Vector &phase) const;

  /// Position X of quadrature point @p q of active element @p e.
  Point<spacedim> quadrature_position(int e, int q) const { return elements_[e].geometry.position(q); }

private:
  using Extractions = std::array<ExtractionMatrix<degree>, n_fields>;

  ElementFields<Model> fields(int active, const Vector &position, const Vector &rate, const Vector &phase) const;
  /// Psi+ at the quadrature points of an element: that of the level, or by the fields there.
  std::array<double, n_q>         active_energy(int active, const ElementFields<Model> &fields,
                                                const BalanceLevel &level) const;
  const ExtractionMatrix<degree> &extraction(int active, int field) const;
  ControlValues<spacedim>         control_values(int active, const Vector &position) const;
  RowRange                        all_rows() const { return {0, distribution_->n_owned(), {}}; }
  template <Unknowns part = Unknowns::all>
  void scatter_force(int active, const ElementVector<Model> &f, const RowRange &range, Vector &force) const;
  template <Unknowns part>
  void scatter_matrix(int active, const ElementMatrix<Model, part> &k, const RowRange &range, Matrix &matrix) const;
  void scatter_point_force(int active, ControlValues<spacedim> f, Vector &force) const;
  void scatter_point_matrix(int active, Eigen::MatrixXd k, Matrix &matrix) const;
  void add_edge_moments(const Vector &position, const LoadValues<Model> &loads, Vector &external) const;
  void add_edge_moment_tangents(const Vector &position, const LoadValues<Model> &loads, Matrix &matrix) const;

  const Model                        *model_;
  const ShellSpace<degree, spacedim> *space_;
  std::shared_ptr<const Distribution> distribution_;
  std::vector<ElementData<Model>>     elements_;
  TiedElements<degree, spacedim>      ties_;
  std::vector<Extractions>            tied_extractions_; ///< by the index of ties_
  std::vector<std::pair<int, int>>    tied_unknowns_;    ///< owned local control point, field
  ScatterMap                          scatter_;
  std::vector<RowRange>               ranges_;
  double                              shortest_edge_, largest_stiffness_;
  std::vector<double>                 phase_scale_, point_area_;
  InterfaceTerms<Model>               interfaces_;
  WeakEdgeTerms<Model>                weak_edges_;
};

} // namespace sherd

#include <sherd/assembly/assembler.templates.h>
#include <sherd/assembly/assembler_state.templates.h>
#include <sherd/assembly/assembler_loads.templates.h>
