#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sherd/assembly/assembler.h>
#include <sherd/solve/static_settings.h>
#include <sherd/solve/supported_unknowns.h>

namespace sherd
{

/// What an attempt at one equilibrium came to.
template <int degree, int spacedim>
struct EquilibriumResult
{
  /// The equilibrium; its time is the load factor. Nothing if there is none.
  std::optional<State<degree, spacedim>> state;
  std::string                            failure;        ///< why there is none
  int                                    iterations = 0; ///< of Newton
  std::vector<double>                    residuals;      ///< relative to the tolerance
};

/// Static equilibrium of a shell at a given load factor lambda, which takes the place of time in loads and supports:
///
///   r(x, lambda) = f_ext(x, lambda) - f_int(x) = 0 on the free unknowns.
///
/// The phase field is held as it is: this solver is for shells that deform without cracking further. Loads and supports
/// have to be affine in lambda: their values at 0 and 1 say everything.
///
/// The arguments of the constructor have to outlive the solver. All members are collective.
template <class Model>
class StaticSolver
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  static constexpr int n_fields = Model::n_fields;
  using StateType               = State<degree, spacedim>;
  using Result                  = EquilibriumResult<degree, spacedim>;

  StaticSolver(const Model &model, const ShellSpace<degree, spacedim> &space, const Supports &supports,
               const Loads<spacedim> &loads, const StaticSettings &settings);

  /// Prepares for the present mesh of the space and the distribution of @p state. Call it first and after refinement.
  /// @throws InvalidParameter   loads or supports that are not affine in the load factor
  void rebuild(const StateType &state);

  const Assembler<Model>                    &assembler() const { return *assembler_; }
  const ShellSpace<degree, spacedim>        &space() const { return *space_; }
  const StaticSettings                      &settings() const { return settings_; }
  const SupportedUnknowns<degree, spacedim> &supported() const { return *supported_; }

  /// Linear response: one step of Newton's method from @p start to load factor @p factor.
  /// @throws NoConvergence   from the linear solver, for example a shell that is not held
  StateType solve_linear(const StateType &start, double factor);

  /// Newton's method with line search from @p start at load factor @p factor.
  Result solve(const StateType &start, double factor);

  /// Residual at a state, with the tangent left in the solver.
  struct Residual
  {
    Vector free;    ///< r where unknowns are free, zero elsewhere, block n_fields
    double norm;    ///< of free
    double allowed; ///< norm that counts as converged
  };
  Residual linearise(const StateType &state);

  /// Residual alone.
  Residual residual(const StateType &state);

  /// Solves K dx_i = rhs_i with the tangent of the last linearise(); rows of supported unknowns give diag dx = rhs.
  /// Increments satisfy the ties. Call it once after each linearise().
  std::vector<Vector> solve_tangent(std::span<const Vector> rhs);

  /// d r / d lambda at @p state where unknowns are free, and in the rows of supported unknowns what makes them move
  /// with their supports: the right-hand side of the tangent of the path. Call it between linearise and solve_tangent.
  Vector load_direction(const StateType &state) const;

  /// Adds scale * increment (block n_fields) to the position.
  void advance(StateType &state, const Vector &increment, double scale) const;

  /// Sum of the internal forces on a named edge at the last residual: what its supports and loads exert.
  Point<spacedim> reaction(const std::string &edge) const { return edge_force(*space_, *internal_, edge); }

private:
  LoadValues<Model> loads_at(double factor) const { return interpolate(factor, *unloaded_, *loaded_); }
  void              check_affine(const StateType &state) const;
  Residual          measure(const StateType &state, const Vector &internal, const Vector &external) const;

  const Model                        *model_;
  const ShellSpace<degree, spacedim> *space_;
  const Supports                     *supports_;
  const Loads<spacedim>              *loads_;
  StaticSettings                      settings_;

  std::optional<SupportedUnknowns<degree, spacedim>> supported_;
  std::optional<Assembler<Model>>                    assembler_;
  std::optional<Matrix>                              matrix_;
  LinearSolver                                       linear_solver_;
  std::optional<LoadValues<Model>>                   unloaded_, loaded_; ///< at load factors 0 and 1
  std::optional<Vector>                              at_rest_;           ///< zero acceleration
  std::vector<char>                                  fixed_;             ///< also the phase
  std::optional<Vector>                              internal_;          ///< of the last residual
};

} // namespace sherd

#include <sherd/solve/static_solver.templates.h>
