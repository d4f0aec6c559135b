#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <sherd/base/print.h>
#include <sherd/solve/static_solver.h>

namespace sherd
{

/// Follows an equilibrium path r(x, lambda) = 0 through limit points of load and displacement.
///
/// A step of length s solves r = 0 together with |x - x_n|^2 = s^2 by Newton's method on both (bordered by elimination:
/// with K du = r and K dt = dr/dlambda the change of the load factor is
/// dlambda = -((|Dx|^2 - s^2)/2 + Dx . du) / (Dx . dt), Dx = x - x_n). It starts along the tangent of the path, on the
/// side that continues the step before. |.| is the root mean square over the surface, [length].
///
/// Source: Riks 1979, Crisfield 1981, with the constraint linearised.
template <class Model>
class ArcLength
{
public:
  using StateType = typename StaticSolver<Model>::StateType;

  /// @p solver has to outlive this object and be rebuilt for the mesh of @p start, an equilibrium.
  ArcLength(StaticSolver<Model> &solver, const StateType &start, const ArcLengthSettings &settings)
      : solver_(&solver), settings_(settings), state_(start), previous_(start.distribution, solver.n_fields)
  {
  }

  /// The last point; its time is the load factor.
  const StateType &state() const { return state_; }

  /// Goes one step along the path; returns the iterations of the corrector. Collective.
  /// @throws NoConvergence   when the shortest step fails
  int advance()
  {
    for (;;)
      {
        std::string failure;
        try
          {
            if (const int iterations = attempt(failure); iterations > 0)
              {
                length_ *= std::clamp(std::sqrt(settings_.wanted_iterations / double(iterations)), .5, 1.5);
                length_ = std::min(length_, settings_.largest * first_length_);
                return iterations;
              }
          }
        catch (const NoConvergence &error)
          {
            if (length_ == 0.)
              throw;
            failure = error.what();
          }
        length_ *= .5;
        if (length_ < settings_.smallest * first_length_)
          throw NoConvergence("arc length: no equilibrium beyond load factor " + print(state_.time) +
                              " with a step of " + print(2. * length_) + " (" + failure + ")");
      }
  }

private:
  /// One step of the present length; the number of iterations, or 0 and why there is none.
  int attempt(std::string &failure)
  {
    StateType next = state_;
    solver_->linearise(next);
    const Vector direction = solver_->load_direction(next);
    const Vector tangent   = solver_->solve_tangent(std::span<const Vector>(&direction, 1)).front();
    const double speed     = std::sqrt(product(tangent, tangent));
    if (!(speed > 0.))
      throw InvalidParameter("arc length: nothing moves when the load factor changes; loads or supports have to be "
                             "proportional to it, in a case file to t");
    if (length_ == 0.)
      length_ = first_length_ = settings_.first_factor * speed;
    const double along = product(tangent, previous_);
    const double first = std::copysign(length_ / speed, along == 0. ? 1. : along);

    Vector change = tangent;
    scale(first, change);
    solver_->advance(next, tangent, first);
    next.time += first;
    for (int i = 1; i <= settings_.max_iterations; ++i)
      {
        const auto   r      = solver_->linearise(next);
        const double square = product(change, change);
        if (!(first * product(change, tangent) > 0.))
          {
            failure = "the corrector turned back";
            return 0;
          }
        if (!std::isfinite(r.norm))
          {
            failure = "the residual is not finite";
            return 0;
          }
        if (r.norm <= r.allowed && std::abs(square - length_ * length_) <= 1e-6 * length_ * length_)
          {
            next.step = state_.step + 1;
            state_    = std::move(next);
            previous_ = std::move(change);
            return i;
          }
        const std::array<Vector, 2> rhs{r.free, solver_->load_direction(next)};
        const auto                  increments = solver_->solve_tangent(rhs);
        const double                factor =
            -(.5 * (square - length_ * length_) + product(change, increments[0])) / product(change, increments[1]);
        for (const auto &[increment, weight] : {std::pair(&increments[0], 1.), std::pair(&increments[1], factor)})
          {
            solver_->advance(next, *increment, weight);
            axpy(weight, *increment, change);
          }
        next.time += factor;
      }
    failure = "the corrector did not converge in " + std::to_string(settings_.max_iterations) + " iterations";
    return 0;
  }

  /// int u . v dA / int dA of two displacements.
  double product(const Vector &u, const Vector &v) const
  {
    constexpr int n_fields = StaticSolver<Model>::n_fields;
    const auto   &area     = solver_->assembler().point_area();
    double        sums[2]  = {0., 0.};
    for (std::size_t a = 0; a < area.size(); ++a)
      {
        sums[1] += area[a];
        for (int c = 0; c < StaticSolver<Model>::spacedim; ++c)
          sums[0] += area[a] * u.local()[a * n_fields + c] * v.local()[a * n_fields + c];
      }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, u.distribution().comm());
    return sums[0] / sums[1];
  }

  StaticSolver<Model> *solver_;
  ArcLengthSettings    settings_;
  StateType            state_;
  Vector               previous_; ///< displacement of the last step
  double               length_ = 0., first_length_ = 0.;
};

} // namespace sherd
