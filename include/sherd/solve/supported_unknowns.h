#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/base/collective.h>
#include <sherd/base/print.h>
#include <sherd/forms/unknowns.h>
#include <sherd/space/local_ties.h>

namespace sherd
{

/// The supports of a mesh as solvers use them: unknowns that do not move freely, where they go, and tied unknowns.
template <int degree, int spacedim>
class SupportedUnknowns
{
public:
  static constexpr int n_fields = fields_per_point<spacedim>;

  /// @p supports and @p space have to outlive this object; make a new one after each refinement.
  /// @throws as constraints and ties
  SupportedUnknowns(const Supports &supports, const ShellSpace<degree, spacedim> &space)
      : supports_(&supports),
        space_(&space),
        constraints_(constraints(supports, space)),
        ties_(sherd::ties(supports, space.surface())),
        local_ties_(ties_, space.distribution().local),
        held_(space.distribution().owned.size() * n_fields, 0)
  {
    const int n_owned = static_cast<int>(space.distribution().owned.size());
    for (const auto &c : constraints_)
      if (c.point < n_owned)
        held_[c.point * n_fields + c.component] = 1;
    fixed_ = held_;
    for (const auto &tie : local_ties_.list())
      if (tie.point < n_owned)
        fixed_[tie.point * n_fields + tie.field] = 1;
  }

  /// Ties of the surface.
  const std::vector<Tie> &ties() const { return ties_; }

  /// 1 for an owned unknown that a support holds or that is tied: it has no equation, shape=(n_owned * n_fields).
  const std::vector<char> &fixed() const { return fixed_; }

  /// Whether a support holds owned unknown @p k.
  bool is_held(std::size_t k) const { return held_[k]; }

  /// Displacements from @p position to where the supports are at @p time, tied unknowns included; zero for all others.
  /// Block spacedim, with ghosts.
  Vector moves(const Vector &position, double time) const
  {
    Vector moves = position;
    moves.fill(0.);
    for (const auto &c : constraints_)
      {
        const auto [p, i] = space_->surface().locate_point(static_cast<int>(position.distribution().global(c.point)));
        const double target =
            space_->surface().patch(p).control_points(i, c.component) + supports_->list()[c.support].displacement(time);
        const int k      = c.point * spacedim + c.component;
        moves.local()[k] = target - position.local()[k];
      }
    local_ties_.apply(moves.local(), spacedim);
    return moves;
  }

  /// Gives tied unknowns the values of their masters; @p increment has n_fields values a control point, or those of the
  /// displacement.
  void complete(Vector &increment) const { local_ties_.apply(increment.local(), increment.block_size()); }

  /// The same for a phase field.
  void complete_phase(Vector &phase) const { local_ties_.apply(phase.local(), 1, spacedim); }

  /// Gives a velocity, block spacedim, what the supports ask for: zero where they hold the surface at rest, and that of
  /// their masters to tied unknowns. Where a support moves the surface it stays as it is: integrators take the rates
  /// from the path of the support. Ghosts are up to date afterwards. Collective.
  void complete_velocity(Vector &velocity) const
  {
    velocity.update_ghosts();
    for (const auto &c : constraints_)
      if (supports_->list()[c.support].at_rest)
        velocity.local()[c.point * spacedim + c.component] = 0.;
    local_ties_.apply(velocity.local(), spacedim);
  }

  /// Collective. @throws InvalidParameter   unless complete_velocity() changes nothing but rounding errors; on all
  /// ranks
  void check_velocity(const Vector &velocity) const
  {
    Vector completed = velocity;
    complete_velocity(completed);
    double size = 0.;
    for (const double v : velocity.owned())
      size = std::max(size, std::abs(v));
    MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPI_DOUBLE, MPI_MAX, velocity.distribution().comm());
    collectively(velocity.distribution().comm(), [&] {
      for (std::size_t i = 0; i < velocity.owned().size(); ++i)
        if (std::abs(velocity.local()[i] - completed.local()[i]) > rounding * size)
          throw InvalidParameter(violation(static_cast<int>(i), velocity.local()[i], completed.local()[i]));
    });
  }

private:
  static constexpr double rounding = 1e-9; ///< relative to the largest velocity

  /// What is wrong with entry @p i of a velocity.
  std::string violation(int i, double given, double expected) const
  {
    const int   component = i % spacedim;
    const auto  X         = space_->surface().control_points().row(space_->distribution().owned[i / spacedim]).eval();
    std::string at        = print(X[0]) + ", " + print(X[1]);
    std::string who       = "a tie of a symmetric edge";
    if constexpr (spacedim == 3)
      at += ", " + print(X[2]);
    for (const auto &c : constraints_)
      if (c.point == i / spacedim && c.component == component)
        who = "the support of " + describe(supports_->list()[c.support].region);
    return std::string("initial velocity: component ") + "xyz"[component] + " is " + print(given) +
           " at the control point (" + at + "), expected " + print(expected) + " by " + who +
           "; give a velocity that obeys supports and ties, or let complete_velocity() of the solver change it there";
  }

  const Supports                     *supports_;
  const ShellSpace<degree, spacedim> *space_;
  std::vector<Constraint>             constraints_;
  std::vector<Tie>                    ties_;
  LocalTies                           local_ties_;
  std::vector<char>                   held_, fixed_;
};

/// Empties the rows of @p fixed unknowns but for the diagonal, so that they take the value of the right-hand side over
/// the diagonal. @param fixed   shape=(n_owned * block_size)
void decouple_rows(Matrix &matrix, const std::vector<char> &fixed);

/// The same in a matrix of the fields @p range of a control point. @param fixed   shape=(n_owned * n_fields)
void decouple_rows(Matrix &matrix, const std::vector<char> &fixed, int n_fields, FieldRange range);

/// Sum of @p force, block n_fields, over the control points of a named edge, shape=(spacedim). Sides of one name that
/// meet in a corner count it once. Collective. @throws InvalidParameter   unknown edge
template <int degree, int spacedim>
Point<spacedim> edge_force(const ShellSpace<degree, spacedim> &space, const Vector &force, const std::string &edge)
{
  Point<spacedim> sum = Point<spacedim>::Zero();
  for (const int point : points_of(Region(edge), space.surface()))
    if (const int a = space.distribution().local[point]; a >= 0 && a < force.distribution().n_owned())
      for (int c = 0; c < spacedim; ++c)
        sum[c] += force.local()[a * force.block_size() + c];
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), spacedim, MPI_DOUBLE, MPI_SUM, force.distribution().comm());
  return sum;
}

} // namespace sherd
