#pragma once

#include <sherd/assembly/assembler.h>
#include <sherd/base/print.h>
#include <sherd/geometry/place.h>

namespace sherd
{

namespace internal
{

/// Diagonal of the box around the control points.
template <int degree, int spacedim>
double surface_size(const Surface<degree, spacedim> &surface)
{
  const auto X = surface.control_points();
  return (X.colwise().maxCoeff() - X.colwise().minCoeff()).norm();
}

} // namespace internal

template <class Model>
LoadValues<Model> Assembler<Model>::evaluate(const Loads<spacedim> &loads, double time) const
{
  const auto       &surface = space_->surface();
  const auto       &d       = space_->distribution();
  LoadValues<Model> values;
  values.time = time;
  std::vector<int> active(surface.n_elements(), -1);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    active[d.elements[e]] = static_cast<int>(e);

  if (!loads.tractions().empty() || !loads.surface_loads().empty() || !loads.point_loads().empty())
    values.dead.emplace(distribution_, n_fields);
  for (const auto &load : loads.tractions())
    for (const auto &edge : surface.edge(load.edge))
      for (const auto &piece : edge_geometry(surface, edge))
        if (const int e = active[piece.element]; e >= 0)
          {
            ControlValues<spacedim> f = ControlValues<spacedim>::Zero(piece.points.size(), spacedim);
            for (const auto &q : piece.quadrature)
              f += Eigen::Map<const Eigen::VectorXd>(q.value.data(), q.value.size()) *
                   (q.dS * load.traction(q.position, time)).transpose();
            scatter_point_force(e, f, *values.dead);
          }
  for (const auto &surface_load : loads.surface_loads())
    for (std::size_t e = 0; e < elements_.size(); ++e)
      {
        const auto                        &g = elements_[e].geometry;
        std::optional<ShapeValues<degree>> storage;
        const auto                        &s = g.shapes(storage);
        ElementVector<Model>               f = {};
        for (int q = 0; q < n_q; ++q)
          {
            const Point<spacedim> density = g.reference[q].dA * surface_load(g.position(q), time);
            for (int c = 0; c < spacedim; ++c)
              for (int b = 0; b < s.n_functions; ++b)
                f.value[c][b] += s.value[q][b] * density[c];
          }
        scatter_force(static_cast<int>(e), f, all_rows(), *values.dead);
      }
  for (const auto &load : loads.point_loads())
    {
      const auto place = closest_place(surface, load.position);
      if (const double distance = (position(surface, place) - load.position).norm();
          !(distance <= 1e-3 * internal::surface_size(surface)))
        throw InvalidParameter("point load: its position lies " + print(distance) +
                               " away from the reference surface, whose size is " +
                               print(internal::surface_size(surface)) + "; expected a point on it");
      const auto at = sherd::evaluate(surface, place);
      const int  element =
          surface.element_offset(place.patch) + surface.patch(place.patch).basis.element_at(place.u, place.v);
      if (const int e = active[element]; e >= 0)
        scatter_point_force(
            e, Eigen::Map<const Eigen::VectorXd>(at.value.data(), at.value.size()) * load.force(time).transpose(),
            *values.dead);
    }

  if constexpr (spacedim == 3)
    {
      if (!loads.pressures().empty())
        for (const auto &data : elements_)
          values.pressure.push_back(element_pressure(data, loads, time));
      for (const auto &load : loads.edge_moments())
        for (const auto &edge : surface.edge(load.edge))
          for (auto &piece : edge_geometry(surface, edge))
            if (const int e = active[piece.element]; e >= 0)
              {
                PieceMoment<degree> moment;
                for (int q = 0; q <= degree; ++q)
                  moment[q] = load.moment(piece.quadrature[q].position, time);
                values.moments.push_back({e, std::move(piece), moment});
              }
    }
  return values;
}

template <class Model>
void Assembler<Model>::external_force(const BalanceLevel &level, const LoadValues<Model> &loads, Vector &force) const
{
  force.fill(0.);
  if constexpr (spacedim == 3)
    if (!loads.pressure.empty())
      {
#pragma omp parallel for schedule(static, 1)
        for (std::size_t r = 0; r < ranges_.size(); ++r)
          for (const int e : ranges_[r].elements)
            {
              const auto           f        = fields(e, level.position, level.acceleration, level.phase);
              ElementVector<Model> pressure = {};
              add_pressure(elements_[e], f, loads.pressure[e], pressure);
              scatter_force(e, pressure, ranges_[r], force);
            }
      }
  if (loads.dead)
    axpy(1., *loads.dead, force);
  add_edge_moments(level.position, loads, force);
}

template <class Model>
void Assembler<Model>::add_edge_moments(const Vector &position, const LoadValues<Model> &loads, Vector &external) const
{
  if constexpr (spacedim == 3)
    for (const auto &load : loads.moments)
      scatter_point_force(load.active,
                          edge_moment_force(load.piece, control_values(load.active, position), load.moment), external);
}

template <class Model>
void Assembler<Model>::add_edge_moment_tangents(const Vector &position, const LoadValues<Model> &loads,
                                                Matrix &matrix) const
{
  if constexpr (spacedim == 3)
    for (const auto &load : loads.moments)
      scatter_point_matrix(
          load.active, -edge_moment_tangent(load.piece, control_values(load.active, position), load.moment), matrix);
}

template <class Model>
auto Assembler<Model>::control_values(int active, const Vector &position) const -> ControlValues<spacedim>
{
  const auto              points = space_->points_of(active);
  ControlValues<spacedim> values(points.size(), spacedim);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int d = 0; d < spacedim; ++d)
      values(i, d) = position.local()[points[i] * spacedim + d];
  return values;
}

template <class Model>
void Assembler<Model>::scatter_point_force(int active, ControlValues<spacedim> f, Vector &force) const
{
  const auto points = space_->points_of(active);
  if (const int tied = ties_.index(active); tied >= 0)
    for (int c = 0; c < spacedim; ++c)
      f.col(c) = (ties_.transfer(tied, c) * f.col(c)).eval();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i] < distribution_->n_owned())
      for (int c = 0; c < spacedim; ++c)
        force.local()[points[i] * n_fields + c] += f(i, c);
}

template <class Model>
void Assembler<Model>::scatter_point_matrix(int active, Eigen::MatrixXd k, Matrix &matrix) const
{
  const auto points    = space_->points_of(active);
  const int  n         = static_cast<int>(points.size());
  const auto positions = scatter_.positions(active);
  const auto entries   = [&](int c, int d) {
    return k(Eigen::seqN(c, n, Eigen::fix<spacedim>), Eigen::seqN(d, n, Eigen::fix<spacedim>));
  };
  for (int c = 0; c < spacedim; ++c)
    for (int d = 0; d < spacedim; ++d)
      {
        Eigen::MatrixXd block = entries(c, d);
        if (const int tied = ties_.index(active); tied >= 0)
          block = ties_.transfer(tied, c) * block * ties_.transfer(tied, d).transpose();
        for (int i = 0; i < n; ++i)
          if (points[i] < distribution_->n_owned())
            {
              double *row = matrix.values().data() + matrix.row_start(points[i]) + c * matrix.row_length(points[i]) + d;
              for (int j = 0; j < n; ++j)
                row[positions[i * n + j] * matrix.block_size()] += block(i, j);
            }
      }
}

} // namespace sherd
