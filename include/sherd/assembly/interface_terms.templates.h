#pragma once

#include <variant>

#include <sherd/assembly/interface_terms.h>
#include <sherd/base/collective.h>
#include <sherd/base/print.h>

namespace sherd
{

namespace internal
{

/// c or D that scales the penalty of the angle, theory G.3; 0 in the plane and for membranes.
template <class Model>
double bending_stiffness(const Model &model)
{
  if constexpr (Model::spacedim == 3)
    return model.split.bending().stiffness();
  else
    return 0.;
}

/// beta of theory G.3.
inline double penalty_factor(double given, double otherwise)
{
  if (!(given >= 0. && std::isfinite(given)))
    throw InvalidParameter("continuity by penalty: factor " + print(given) +
                           ", expected a positive one, or 0 for the default of " + print(otherwise));
  return given > 0. ? given : otherwise;
}

} // namespace internal

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
  const double beta_angle =
      penalty ? internal::penalty_factor(penalty->deformation, continuity::penalty_factor(degree)) : multiplier_factor;
  const double beta_phase =
      penalty ? internal::penalty_factor(penalty->phase, continuity::phase_penalty_factor) : multiplier_factor;
  const double stiffness = internal::bending_stiffness(model);
  const bool   has_phase = std::remove_cvref_t<decltype(model.crack_density)>::order == 4;
  const auto  &d         = space.distribution();
  const auto   by_point  = TiesByPoint(ties, space.surface().n_control_points());
  collectively(space.environment().comm(), [&] {
    for (int k = 0; k < space.n_active_interfaces(); ++k)
      {
        auto &cell  = cells_.emplace_back();
        cell.tables = interface_tables(interface_geometry(space.surface(), space.interface_pieces()[d.interfaces[k]]));
        cell.owned  = d.owns_interface[k];
        cell.ties   = by_point.template transfers<n_fields>(cell.tables.points);
        for (const int point : cell.tables.points)
          cell.points.push_back(d.local[point]);
        if (!penalty)
          cell.points.push_back(d.local[space.n_control_points() + d.interfaces[k]]);

        double factor = 0.; // of the moduli; the penalty follows the stiffer side
        for (const auto &point : cell.tables.quadrature)
          factor = std::max(factor, model.stiffness(point.position));
        const double eps = beta_angle * factor * stiffness / cell.tables.size;
        if (stiffness > 0.)
          (penalty ? cell.angle_stiffness : cell.angle_compliance) = penalty ? eps : cell.tables.length / eps;
        if (penalty)
          sensitivity_ = std::max(sensitivity_, eps / cell.tables.size);
        if (has_phase)
          {
            std::array<double, degree + 1> eps_phase;
            for (int q = 0; q <= degree; ++q)
              {
                const auto &point = cell.tables.quadrature[q];
                eps_phase[q]      = beta_phase * model.toughness(point.position) * std::pow(model.length_scale, 3) /
                               (2. * cell.tables.size);
                if (!penalty)
                  cell.phase_compliance += point.dS / eps_phase[q];
              }
            if (penalty)
              cell.phase_penalty = phase_penalty_matrix(cell.tables, eps_phase);
            else
              cell.phase_jump = phase_jump(cell.tables);
            if (cell.ties)
              {
                const auto &R = (*cell.ties)[spacedim];
                if (penalty)
                  cell.phase_penalty = R * cell.phase_penalty * R.transpose();
                else
                  cell.phase_jump = R * cell.phase_jump;
              }
          }

        const auto size = cell.points.size();
        cell.positions.assign(size * size, -1);
        for (std::size_t i = 0; i < size; ++i)
          if (cell.points[i] < n_owned_)
            {
              const auto row = d.graph.row(cell.points[i]);
              for (std::size_t j = 0; j < size; ++j)
                cell.positions[i * size + j] =
                    static_cast<int>(std::lower_bound(row.begin(), row.end(), cell.points[j]) - row.begin());
            }
      }
  });
}

template <class Model>
auto InterfaceTerms<Model>::control_values(const Cell &cell, const Vector &position) const -> ControlValues<spacedim>
{
  ControlValues<spacedim> values(cell.n(), spacedim);
  for (int i = 0; i < cell.n(); ++i)
    for (int c = 0; c < spacedim; ++c)
      values(i, c) = position.local()[cell.points[i] * spacedim + c];
  return values;
}

template <class Model>
Eigen::VectorXd InterfaceTerms<Model>::phase_values(const Cell &cell, const Vector &phase) const
{
  Eigen::VectorXd values(cell.n());
  for (int i = 0; i < cell.n(); ++i)
    values[i] = phase.local()[cell.points[i]];
  return values;
}

template <class Model>
void InterfaceTerms<Model>::add_angle(const Cell &cell, const Vector &position, Part part, Arrays &arrays) const
{
  if constexpr (spacedim == 3)
    {
      if (cell.angle_stiffness == 0. && !cell.has_angle_multiplier())
        return;
      const int    n = cell.n(), multiplier = n * n_fields;
      const auto   x    = control_values(cell, position);
      const double q    = cell.has_multiplier() ? position.local()[cell.points[n] * spacedim] : 0.;
      const auto   free = [&](auto &&f) -> ControlValues<3> { // R^T f
        if (!cell.ties)
          return f;
        ControlValues<3> result(n, 3);
        for (int c = 0; c < 3; ++c)
          result.col(c) = (*cell.ties)[c] * f.col(c);
        return result;
      };
      const auto rows = [&](int c) { return Eigen::seqN(c, n, Eigen::fix<n_fields>); };

      ControlValues<3> gradient = // of the constraint, or the force of the penalty
          free(cell.has_multiplier() ? angle_defect_gradient(cell.tables, x)
                                     : angle_penalty_force(cell.tables, x, cell.angle_stiffness));
      if (part != Part::constraint_rows)
        {
          for (int c = 0; c < 3; ++c)
            arrays.force(rows(c)) += (cell.has_multiplier() ? q : 1.) * gradient.col(c);
          if (cell.has_multiplier())
            arrays.force[multiplier] += angle_defect(cell.tables, x) - cell.angle_compliance * q;
        }
      if (part == Part::force)
        return;
      if (cell.has_multiplier())
        {
          for (int c = 0; c < 3; ++c)
            {
              arrays.tangent(rows(c), multiplier) += gradient.col(c);
              arrays.tangent(multiplier, rows(c)) += gradient.col(c).transpose().eval();
            }
          arrays.tangent(multiplier, multiplier) -= cell.angle_compliance;
        }
      if (part == Part::constraint_rows)
        return;
      const Eigen::MatrixXd K = cell.has_multiplier() ? angle_multiplier_tangent(cell.tables, x, q)
                                                      : angle_penalty_tangent(cell.tables, x, cell.angle_stiffness);
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          {
            Eigen::MatrixXd block = K(Eigen::seqN(c, n, Eigen::fix<3>), Eigen::seqN(d, n, Eigen::fix<3>));
            if (cell.ties)
              block = (*cell.ties)[c] * block * (*cell.ties)[d].transpose();
            arrays.tangent(rows(c), rows(d)) += block;
          }
    }
}

template <class Model>
void InterfaceTerms<Model>::add_phase(const Cell &cell, const Vector &phase, Part part, Arrays &arrays) const
{
  // Tied values are where their ties put them, so that R^T K R phi_free = R^T K phi.
  const int  n = cell.n(), multiplier = n * n_fields + spacedim;
  const auto rows = Eigen::seqN(spacedim, n, Eigen::fix<n_fields>);
  if (part == Part::constraint_rows)
    return;
  const auto phi = phase_values(cell, phase);
  if (cell.phase_penalty.size() > 0)
    {
      arrays.force(rows) += (cell.phase_penalty * phi).eval();
      if (part == Part::force_and_tangent)
        arrays.tangent(rows, rows) += cell.phase_penalty;
    }
  if (cell.has_phase_multiplier())
    {
      const double q = phase.local()[cell.points[n]];
      arrays.force(rows) += q * cell.phase_jump;
      arrays.force[multiplier] += cell.phase_jump.dot(phi) - cell.phase_compliance * q;
      if (part == Part::force_and_tangent)
        {
          arrays.tangent(rows, multiplier) += cell.phase_jump;
          arrays.tangent(multiplier, rows) += cell.phase_jump.transpose().eval();
          arrays.tangent(multiplier, multiplier) -= cell.phase_compliance;
        }
    }
}

template <class Model>
auto InterfaceTerms<Model>::arrays(const Cell &cell, const Vector &position, const Vector &phase, Part part) const
    -> Arrays
{
  const auto size = static_cast<Eigen::Index>(cell.points.size()) * n_fields;
  Arrays     result;
  if (part != Part::constraint_rows)
    result.force = Eigen::VectorXd::Zero(size);
  if (part != Part::force)
    result.tangent = Eigen::MatrixXd::Zero(size, size);
  add_angle(cell, position, part, result);
  add_phase(cell, phase, part, result);
  if (part != Part::force && cell.has_multiplier())
    for (int c = 0; c < n_fields; ++c)
      if (double &diagonal = result.tangent(cell.n() * n_fields + c, cell.n() * n_fields + c); diagonal == 0.)
        diagonal = 1.;
  return result;
}

template <class Model>
void InterfaceTerms<Model>::scatter(const Cell &cell, const Eigen::VectorXd &from, Vector &force) const
{
  for (std::size_t i = 0; i < cell.points.size(); ++i)
    if (cell.points[i] < n_owned_)
      for (int c = 0; c < n_fields; ++c)
        force.local()[cell.points[i] * n_fields + c] += from[i * n_fields + c];
}

template <class Model>
void InterfaceTerms<Model>::scatter(const Cell &cell, const Eigen::MatrixXd &from, Matrix &matrix) const
{
  const auto size = cell.points.size();
  for (std::size_t i = 0; i < size; ++i)
    if (const int point = cell.points[i]; point < n_owned_)
      for (int c = 0; c < n_fields; ++c)
        {
          double *row = matrix.values().data() + matrix.row_start(point) + c * matrix.row_length(point);
          for (std::size_t j = 0; j < size; ++j)
            for (int d = 0; d < n_fields; ++d)
              row[cell.positions[i * size + j] * n_fields + d] += from(i * n_fields + c, j * n_fields + d);
        }
}

template <class Model>
void InterfaceTerms<Model>::add_force(const Vector &position, const Vector &phase, Vector &force) const
{
  for (const auto &cell : cells_)
    scatter(cell, arrays(cell, position, phase, Part::force).force, force);
}

template <class Model>
void InterfaceTerms<Model>::linearise(const Vector &position, const Vector &phase, Vector &force, Matrix &matrix) const
{
  for (const auto &cell : cells_)
    {
      const auto result = arrays(cell, position, phase, Part::force_and_tangent);
      scatter(cell, result.force, force);
      scatter(cell, result.tangent, matrix);
    }
}

template <class Model>
void InterfaceTerms<Model>::constrain_acceleration(const Vector &position, Matrix &mass) const
{
  for (const int point : multipliers_)
    if (point < n_owned_)
      for (int c = 0; c < n_fields; ++c)
        mass.diagonal(point, c) = 0.;
  for (const auto &cell : cells_)
    if (cell.has_multiplier())
      scatter(cell, arrays(cell, position, position, Part::constraint_rows).tangent, mass);
}

template <class Model>
void InterfaceTerms<Model>::set_identity(Matrix &matrix) const
{
  for (const int point : multipliers_)
    if (point < n_owned_)
      for (int c = 0; c < n_fields; ++c)
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
            if (cell.angle_stiffness > 0.)
              sum += angle_penalty_energy(cell.tables, control_values(cell, position), cell.angle_stiffness);
            if (cell.has_angle_multiplier())
              {
                const double q = position.local()[cell.points.back() * spacedim];
                sum += q * (angle_defect(cell.tables, control_values(cell, position)) - .5 * cell.angle_compliance * q);
              }
          }
        const auto phi = phase_values(cell, phase);
        if (cell.phase_penalty.size() > 0)
          sum += .5 * phi.dot(cell.phase_penalty * phi);
        if (cell.has_phase_multiplier())
          {
            const double q = phase.local()[cell.points.back()];
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
    if (cell.has_multiplier() && cell.points.back() < n_owned_)
      {
        const auto row   = residual.local().subspan(cell.points.back() * n_fields, n_fields);
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
