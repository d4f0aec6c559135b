#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include <sherd/assembly/interface_terms.h>
#include <sherd/assembly/penalty_factors.h>
#include <sherd/base/collective.h>

namespace sherd
{

template <class Model>
InterfaceTerms<Model>::InterfaceTerms(const Model &model, const ShellSpace<degree, spacedim> &space,
                                      const std::vector<Tie> &ties)
    : length_scale_(model.length_scale), n_owned_(static_cast<int>(space.distribution().owned.size()))
{
  is_multiplier_.assign(space.distribution().owned.size() + space.distribution().ghosts.size(), 0);
  for (int id = space.n_control_points(); id < space.n_points(); ++id)
    if (const int point = space.distribution().local[id]; point >= 0)
      {
        multipliers_.push_back(point);
        is_multiplier_[point] = 1;
      }
  const auto *penalty = std::get_if<continuity::Penalty>(&space.continuity());
  if (std::holds_alternative<continuity::None>(space.continuity()))
    return;
  const char  *where = "continuity by penalty";
  const double beta_angle =
      penalty ? internal::penalty_factor(penalty->deformation, continuity::penalty_factor(degree), where)
              : multiplier_factor;
  const double beta_phase =
      penalty ? internal::penalty_factor(penalty->phase, continuity::phase_penalty_factor, where) : multiplier_factor;
  const double stiffness = internal::bending_stiffness(model);
  const auto  &d         = space.distribution();
  const auto   by_point  = TiesByPoint(ties, space.surface().n_control_points());
  collectively(space.environment().comm(), [&] {
    for (int k = 0; k < space.n_active_interfaces(); ++k)
      {
        auto     &cell       = cells_.emplace_back();
        const int multiplier = penalty ? -1 : space.n_control_points() + d.interfaces[k];
        cell.tables  = interface_tables(interface_geometry(space.surface(), space.interface_pieces()[d.interfaces[k]]));
        cell.owned   = d.owns_interface[k];
        cell.scatter = CellScatter<n_fields>(d, cell.tables.points, multiplier, by_point);
        cell.multiplier = penalty ? -1 : d.local[multiplier];

        double factor = 0.; // of the moduli; the penalty follows the stiffer side
        for (const auto &point : cell.tables.quadrature)
          factor = std::max(factor, model.stiffness(point.position));
        const double eps = internal::angle_penalty(beta_angle, factor * stiffness, cell.tables.size);
        if (stiffness > 0.)
          {
            cell.intact_stiffness = eps;
            cell.lasting          = internal::lasting_bending(model, cell.tables.size);
          }
        if (penalty)
          sensitivity_ = std::max(sensitivity_, eps / cell.tables.size);
        if (std::remove_cvref_t<decltype(model.crack_density)>::order == 4)
          set_phase_terms(model, cell, beta_phase);
      }
  });
}

template <class Model>
void InterfaceTerms<Model>::set_phase_terms(const Model &model, Cell &cell, double beta) const
{
  std::array<double, degree + 1> eps;
  for (int q = 0; q <= degree; ++q)
    {
      const auto &point = cell.tables.quadrature[q];
      eps[q] = internal::phase_penalty(beta, model.toughness(point.position), model.length_scale, cell.tables.size);
      if (cell.has_multiplier())
        cell.phase_compliance += point.dS / eps[q];
    }
  if (cell.has_multiplier())
    cell.phase_jump = cell.scatter.to_masters(spacedim, phase_jump(cell.tables));
  else
    cell.phase_penalty = cell.scatter.to_masters(spacedim, spacedim, phase_penalty_matrix(cell.tables, eps));
}

template <class Model>
void InterfaceTerms<Model>::soften(const Model &model, const Vector &phase)
{
  constexpr double broken = 1e-6; // of a penalty
  for (auto &cell : cells_)
    if (cell.has_angle_terms())
      {
        const double least =
            cell.has_multiplier() ? broken * continuity::penalty_factor(degree) / multiplier_factor : broken;
        const auto phi = cell.scatter.phase(phase, cell.n());
        double     sum = 0.;
        for (const auto &point : cell.tables.quadrature)
          sum += point.dS * std::max(0., model.degradation.value(point.value.dot(phi)));
        cell.softening = cell.lasting + (1. - cell.lasting) * sum / cell.tables.length + least;
      }
}

template <class Model>
void InterfaceTerms<Model>::add_angle(const Cell &cell, const Vector &position, Wanted wanted, Arrays &arrays) const
{
  if constexpr (spacedim == 3)
    {
      if (!cell.has_angle_terms())
        return;
      const auto   n = cell.n(), multiplier = n * n_fields;
      const auto   x    = cell.scatter.position(position, n);
      const double q    = cell.has_multiplier() ? position.local()[cell.multiplier * spacedim] : 0.;
      const auto   rows = [&](int c) { return Eigen::seqN(c, n, Eigen::fix<n_fields>); };

      ControlValues<3> gradient = // of the constraint, or the force of the penalty
          cell.has_multiplier() ? angle_defect_gradient(cell.tables, x)
                                : angle_penalty_force(cell.tables, x, cell.angle_stiffness());
      for (int c = 0; c < 3; ++c)
        gradient.col(c) = cell.scatter.to_masters(c, gradient.col(c));
      if (wanted != Wanted::constraint_rows)
        {
          for (int c = 0; c < 3; ++c)
            arrays.force(rows(c)) += (cell.has_multiplier() ? q : 1.) * gradient.col(c);
          if (cell.has_multiplier())
            arrays.force[multiplier] += angle_defect(cell.tables, x) - cell.angle_compliance() * q;
        }
      if (wanted == Wanted::force)
        return;
      if (cell.has_multiplier())
        {
          for (int c = 0; c < 3; ++c)
            {
              arrays.tangent(rows(c), multiplier) += gradient.col(c);
              arrays.tangent(multiplier, rows(c)) += gradient.col(c).transpose().eval();
            }
          arrays.tangent(multiplier, multiplier) -= cell.angle_compliance();
        }
      if (wanted == Wanted::constraint_rows)
        return;
      const Eigen::MatrixXd K = cell.has_multiplier() ? angle_multiplier_tangent(cell.tables, x, q)
                                                      : angle_penalty_tangent(cell.tables, x, cell.angle_stiffness());
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          arrays.tangent(rows(c), rows(d)) +=
              cell.scatter.to_masters(c, d, K(Eigen::seqN(c, n, Eigen::fix<3>), Eigen::seqN(d, n, Eigen::fix<3>)));
    }
}

template <class Model>
void InterfaceTerms<Model>::add_phase(const Cell &cell, const Vector &phase, Wanted wanted, Arrays &arrays) const
{
  // Tied values are where their ties put them, so that R^T K R phi_free = R^T K phi.
  const auto n = cell.n(), multiplier = n * n_fields + spacedim;
  const auto rows = Eigen::seqN(spacedim, n, Eigen::fix<n_fields>);
  if (wanted == Wanted::constraint_rows)
    return;
  const auto phi = cell.scatter.phase(phase, cell.n());
  if (cell.phase_penalty.size() > 0)
    {
      arrays.force(rows) += (cell.phase_penalty * phi).eval();
      if (wanted == Wanted::force_and_tangent)
        arrays.tangent(rows, rows) += cell.phase_penalty;
    }
  if (cell.has_phase_multiplier())
    {
      const double q = phase.local()[cell.multiplier];
      arrays.force(rows) += q * cell.phase_jump;
      arrays.force[multiplier] += cell.phase_jump.dot(phi) - cell.phase_compliance * q;
      if (wanted == Wanted::force_and_tangent)
        {
          arrays.tangent(rows, multiplier) += cell.phase_jump;
          arrays.tangent(multiplier, rows) += cell.phase_jump.transpose().eval();
          arrays.tangent(multiplier, multiplier) -= cell.phase_compliance;
        }
    }
}

template <class Model>
auto InterfaceTerms<Model>::arrays(const Cell &cell, const Vector &position, const Vector &phase, Unknowns part,
                                   Wanted wanted) const -> Arrays
{
  const auto size = static_cast<Eigen::Index>(cell.scatter.points().size()) * n_fields;
  Arrays     result;
  if (wanted != Wanted::constraint_rows)
    result.force = Eigen::VectorXd::Zero(size);
  if (wanted != Wanted::force)
    result.tangent = Eigen::MatrixXd::Zero(size, size);
  if (has_displacement(part))
    add_angle(cell, position, wanted, result);
  if (has_phase(part))
    add_phase(cell, phase, wanted, result);
  if (wanted != Wanted::force && cell.has_multiplier())
    for (int c = 0; c < n_fields; ++c)
      if (double &diagonal = result.tangent(cell.n() * n_fields + c, cell.n() * n_fields + c); diagonal == 0.)
        diagonal = 1.;
  return result;
}

template <class Model>
void InterfaceTerms<Model>::add_force(const Vector &position, const Vector &phase, Unknowns part, Vector &force) const
{
  for (const auto &cell : cells_)
    cell.scatter.add(arrays(cell, position, phase, part, Wanted::force).force, force);
}

template <class Model>
void InterfaceTerms<Model>::linearise(const Vector &position, const Vector &phase, Unknowns part, Vector &force,
                                      Matrix &matrix) const
{
  for (const auto &cell : cells_)
    {
      const auto result = arrays(cell, position, phase, part, Wanted::force_and_tangent);
      cell.scatter.add(result.force, force);
      cell.scatter.add(result.tangent, part, matrix);
    }
}

template <class Model>
void InterfaceTerms<Model>::constrain_acceleration(const Vector &position, Unknowns part, Matrix &mass) const
{
  for (const int point : multipliers_)
    if (point < n_owned_)
      for (int c = 0; c < mass.block_size(); ++c)
        mass.diagonal(point, c) = 0.;
  for (const auto &cell : cells_)
    if (cell.has_multiplier())
      cell.scatter.add(arrays(cell, position, position, part, Wanted::constraint_rows).tangent, part, mass);
}

template <class Model>
void InterfaceTerms<Model>::set_identity(Matrix &matrix) const
{
  for (const int point : multipliers_)
    if (point < n_owned_)
      for (int c = 0; c < matrix.block_size(); ++c)
        matrix.diagonal(point, c) = 1.;
}

template <class Model>
double InterfaceTerms<Model>::energy(const Vector &position, const Vector &phase) const
{
  double sum = 0.;
  for (const auto &cell : cells_)
    if (cell.owned)
      {
        if constexpr (spacedim == 3)
          {
            if (cell.has_angle_terms() && !cell.has_multiplier())
              sum +=
                  angle_penalty_energy(cell.tables, cell.scatter.position(position, cell.n()), cell.angle_stiffness());
            if (cell.has_angle_multiplier())
              {
                const double q = position.local()[cell.multiplier * spacedim];
                sum += q * (angle_defect(cell.tables, cell.scatter.position(position, cell.n())) -
                            .5 * cell.angle_compliance() * q);
              }
          }
        const auto phi = cell.scatter.phase(phase, cell.n());
        if (cell.phase_penalty.size() > 0)
          sum += .5 * phi.dot(cell.phase_penalty * phi);
        if (cell.has_phase_multiplier())
          {
            const double q = phase.local()[cell.multiplier];
            sum += q * (cell.phase_jump.dot(phi) - .5 * cell.phase_compliance * q);
          }
      }
  return sum;
}

template <class Model>
auto InterfaceTerms<Model>::defects(const Vector &residual) const -> Defects
{
  Defects result;
  for (const auto &cell : cells_)
    if (cell.has_multiplier() && cell.multiplier < n_owned_)
      {
        const auto row   = residual.local().subspan(cell.multiplier * n_fields, n_fields);
        const auto raise = [](double &largest, double value) {
          if (!(value <= largest)) // so that what is not a number stays
            largest = value;
        };
        if (cell.has_angle_multiplier())
          raise(result.angle, std::abs(row[0]) / cell.tables.length);
        if (cell.has_phase_multiplier())
          raise(result.phase, length_scale_ * std::abs(row[spacedim]) / cell.tables.length);
      }
  return result;
}

} // namespace sherd
