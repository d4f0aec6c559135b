#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include <sherd/assembly/penalty_factors.h>
#include <sherd/assembly/weak_edge_terms.h>
#include <sherd/base/collective.h>

namespace sherd
{

template <class Model>
WeakEdgeTerms<Model>::WeakEdgeTerms(const Model &model, const ShellSpace<degree, spacedim> &space,
                                    const std::vector<Tie> &ties, const std::vector<Supports::WeakEdge> &edges)
    : edges_(edges)
{
  if (edges_.empty())
    return;
  const auto      &d         = space.distribution();
  const auto      &surface   = space.surface();
  const double     stiffness = internal::bending_stiffness(model);
  const bool       has_phase = std::remove_cvref_t<decltype(model.crack_density)>::order == 4;
  std::vector<int> active(surface.n_elements(), -1);
  for (std::size_t e = 0; e < d.elements.size(); ++e)
    active[d.elements[e]] = static_cast<int>(e);
  const TiesByPoint by_point(ties, surface.n_control_points());
  collectively(space.environment().comm(), [&] {
    for (std::size_t k = 0; k < edges_.size(); ++k)
      {
        const auto  &edge     = edges_[k];
        const auto   where    = "weak condition on edge \"" + edge.edge + "\"";
        const bool   of_phase = std::holds_alternative<LevelPhase>(edge.condition);
        const double beta     = internal::penalty_factor(
                edge.factor, of_phase ? continuity::phase_penalty_factor : continuity::penalty_factor(degree), where);
        if (std::holds_alternative<HeldNormal>(edge.condition) && stiffness == 0.)
          throw InvalidParameter(where +
                                 ": its normal is held, on a surface without a bending stiffness, which resists "
                                 "no rotation; fix displacements alone");
        if (of_phase ? !has_phase : stiffness == 0.)
          continue;
        for (const auto &side : surface.edge(edge.edge))
          for (auto &piece : edge_geometry(surface, side))
            {
              check_plane(piece, edge);
              if (const int e = active[piece.element]; e >= 0)
                {
                  Cell cell;
                  cell.edge    = static_cast<int>(k);
                  cell.owned   = d.owns[e];
                  cell.scatter = CellScatter<n_fields>(d, piece.points, -1, by_point);
                  add_cell(model, std::move(piece), std::move(cell), beta);
                }
            }
      }
  });
}

template <class Model>
void WeakEdgeTerms<Model>::add_cell(const Model &model, Geometry piece, Cell cell, double beta)
{
  double length = 0., area = 0., factor = 0.; // int dS, int h dS, largest one of the moduli
  for (const auto &q : piece.quadrature)
    {
      const double along = (piece.normal_direction == 0 ? q.A2 : q.A1).norm();
      const double det   = q.A1.squaredNorm() * q.A2.squaredNorm() - std::pow(q.A1.dot(q.A2), 2);
      length += q.dS;
      factor = std::max(factor, model.stiffness(q.position));
      area += q.dS * std::sqrt(det) / along;
    }
  const double h = area / length;
  if (std::holds_alternative<LevelPhase>(edges_[cell.edge].condition))
    {
      std::array<double, degree + 1> eps;
      for (int q = 0; q <= degree; ++q)
        eps[q] = internal::phase_penalty(beta, model.toughness(piece.quadrature[q].position), model.length_scale, h);
      cell.phase_penalty = cell.scatter.to_masters(spacedim, spacedim, phase_symmetry_matrix(piece, eps));
    }
  else
    {
      cell.stiffness = internal::angle_penalty(beta, factor * internal::bending_stiffness(model), h);
      sensitivity_   = std::max(sensitivity_, cell.stiffness / h);
    }
  cell.piece = std::move(piece);
  cells_.push_back(std::move(cell));
}

template <class Model>
void WeakEdgeTerms<Model>::check_plane(const Geometry &piece, const Supports::WeakEdge &edge) const
{
  if constexpr (spacedim == 3)
    if (const auto *symmetric = std::get_if<SymmetricNormal>(&edge.condition))
      for (int q = 0; q <= degree; ++q)
        {
          const double across = turned_normal(piece, q, .5 * std::numbers::pi)[static_cast<int>(symmetric->axis)];
          const double sine   = std::sqrt(std::max(1. - across * across, 0.));
          if (const auto &X = piece.quadrature[q].position; sine > internal::oblique)
            throw InvalidParameter("symmetry of edge \"" + edge.edge + "\": at (" + print(X[0]) + ", " + print(X[1]) +
                                   ", " + print(X[2]) + ") the surface meets its plane of symmetry " +
                                   print(std::round(std::asin(sine) * 1800. / std::numbers::pi) / 10.) +
                                   " degrees off the right angle, expected at most 3; check the axis given as normal");
        }
}

template <class Model>
PieceNormals<WeakEdgeTerms<Model>::degree> WeakEdgeTerms<Model>::target(const Cell &cell, double time,
                                                                        double turn) const
{
  PieceNormals<degree> normals;
  if constexpr (spacedim == 3)
    {
      const double angle = held(cell)->angle(time) + turn;
      for (int q = 0; q <= degree; ++q)
        normals[q] = turned_normal(cell.piece, q, angle);
    }
  return normals;
}

template <class Model>
Point<3> WeakEdgeTerms<Model>::axis(const Cell &cell) const
{
  return Point<3>::Unit(static_cast<int>(std::get<SymmetricNormal>(edges_[cell.edge].condition).axis));
}

template <class Model>
Eigen::VectorXd WeakEdgeTerms<Model>::on_points(const Cell &cell, const ControlValues<spacedim> &f) const
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(cell.n() * n_fields);
  for (int c = 0; c < spacedim; ++c)
    result(Eigen::seqN(c, cell.n(), Eigen::fix<n_fields>)) = cell.scatter.to_masters(c, f.col(c));
  return result;
}

template <class Model>
Eigen::VectorXd WeakEdgeTerms<Model>::force(const Cell &cell, const Vector &position, const Vector &phase,
                                            double time) const
{
  // Tied values are where their ties put them, so that R^T K R phi_free = R^T K phi.
  if (cell.phase_penalty.size() > 0)
    {
      Eigen::VectorXd result = Eigen::VectorXd::Zero(cell.n() * n_fields);
      result(Eigen::seqN(spacedim, cell.n(), Eigen::fix<n_fields>)) =
          cell.phase_penalty * cell.scatter.phase(phase, cell.n());
      return result;
    }
  if constexpr (spacedim == 3)
    {
      const auto x = cell.scatter.position(position, cell.n());
      return on_points(cell, held(cell) ? held_normal_force(cell.piece, x, cell.stiffness, target(cell, time))
                                        : symmetry_force(cell.piece, x, cell.stiffness, axis(cell)));
    }
  return {};
}

template <class Model>
Eigen::MatrixXd WeakEdgeTerms<Model>::tangent(const Cell &cell, const Vector &position, double time) const
{
  const auto      n      = cell.n();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n * n_fields, n * n_fields);
  const auto      rows   = [&](int c) { return Eigen::seqN(c, n, Eigen::fix<n_fields>); };
  if (cell.phase_penalty.size() > 0)
    result(rows(spacedim), rows(spacedim)) = cell.phase_penalty;
  else if constexpr (spacedim == 3)
    {
      const auto            x = cell.scatter.position(position, n);
      const Eigen::MatrixXd K = held(cell) ? held_normal_tangent(cell.piece, x, cell.stiffness, target(cell, time))
                                           : symmetry_tangent(cell.piece, x, cell.stiffness, axis(cell));
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          result(rows(c), rows(d)) =
              cell.scatter.to_masters(c, d, K(Eigen::seqN(c, n, Eigen::fix<3>), Eigen::seqN(d, n, Eigen::fix<3>)));
    }
  return result;
}

template <class Model>
void WeakEdgeTerms<Model>::add_force(const Vector &position, const Vector &phase, double time, Unknowns part,
                                     Vector &force) const
{
  for (const auto &cell : cells_)
    if (cell.acts_on(part))
      cell.scatter.add(this->force(cell, position, phase, time), force);
}

template <class Model>
void WeakEdgeTerms<Model>::linearise(const Vector &position, const Vector &phase, double time, Unknowns part,
                                     Vector &force, Matrix &matrix) const
{
  for (const auto &cell : cells_)
    if (cell.acts_on(part))
      {
        cell.scatter.add(this->force(cell, position, phase, time), force);
        cell.scatter.add(tangent(cell, position, time), part, matrix);
      }
}

template <class Model>
void WeakEdgeTerms<Model>::add_force_rate(const Vector &position, double time, Vector &rate) const
{
  if constexpr (spacedim == 3)
    for (const auto &cell : cells_)
      if (held(cell))
        {
          // The force is linear in the target, whose derivative by the angle is the target a quarter turn ahead. The
          // derivative of the angle is a difference, exact for angles in proportion to time.
          const double step  = 1e-5 * std::max(1., std::abs(time));
          const auto  &angle = held(cell)->angle;
          const double speed = (angle(time + step) - angle(time - step)) / (2. * step);
          const auto   x     = cell.scatter.position(position, cell.n());
          cell.scatter.add(on_points(cell, held_normal_force(cell.piece, x, speed * cell.stiffness,
                                                             target(cell, time, .5 * std::numbers::pi))),
                           rate);
        }
}

template <class Model>
double WeakEdgeTerms<Model>::energy(const Vector &position, const Vector &phase, double time) const
{
  double sum = 0.;
  for (const auto &cell : cells_)
    if (cell.owned)
      {
        if (cell.phase_penalty.size() > 0)
          {
            const auto phi = cell.scatter.phase(phase, cell.n());
            sum += .5 * phi.dot(cell.phase_penalty * phi);
          }
        else if constexpr (spacedim == 3)
          {
            const auto x = cell.scatter.position(position, cell.n());
            sum += held(cell) ? held_normal_energy(cell.piece, x, cell.stiffness, target(cell, time))
                              : symmetry_energy(cell.piece, x, cell.stiffness, axis(cell));
          }
      }
  return sum;
}

template <class Model>
double WeakEdgeTerms<Model>::work(const Vector &position, double from, double to) const
{
  double sum = 0.;
  if constexpr (spacedim == 3)
    for (const auto &cell : cells_)
      if (cell.owned && held(cell))
        {
          const auto x = cell.scatter.position(position, cell.n());
          sum += held_normal_energy(cell.piece, x, cell.stiffness, target(cell, to)) -
                 held_normal_energy(cell.piece, x, cell.stiffness, target(cell, from));
        }
  return sum;
}

} // namespace sherd
