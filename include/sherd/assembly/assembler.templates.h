#pragma once

#include <algorithm>
#include <limits>

#include <omp.h>

#include <sherd/assembly/assembler.h>
#include <sherd/base/collective.h>

namespace sherd
{

namespace internal
{

/// Control points of an element in the padded work space of the extraction.
inline constexpr int max_element_points = 48;

/// The element matrix on control points, out[c][i][d][j] = sum_ab E^c_ia K^cd_ab E^d_jb for fields c, d of the part.
/// @param Et      transposed extraction of each field, by rows, shape=(n_b, width), zero beyond column n
/// @param right   work space, shape=(n_fields*n_b, n_fields*width)
/// @param out     shape=(n_fields, n, n_fields, width)
template <int width, class Model, Unknowns part>
inline void extract(int n, const double *const *Et, const ElementMatrix<Model, part> &K, double *right, double *out)
{
  constexpr int n_b = ElementMatrix<Model, part>::n_b, n_fields = fields_of(part, Model::spacedim).count;
  constexpr int stride = n_fields * width;
  for (int d = 0; d < n_fields; ++d)
    set_product<width>(n_fields * n_b, n_b, {K.value[0] + d * n_b, K.stride, 1}, Et[d], width, right + d * width,
                       stride);
  for (int c = 0; c < n_fields; ++c)
    set_product<stride>(n, n_b, {Et[c], 1, width}, right + c * n_b * stride, stride, out + c * n * stride, stride);
}

/// row[d] += from[d * width], one row of a block; four fields at once.
template <int n_fields>
inline void add_block_row(const double *from, int width, double *row)
{
  if constexpr (n_fields == 4)
    {
      typedef double Row __attribute__((vector_size(32), aligned(8), may_alias));
      const Row      added = {from[0], from[width], from[2 * width], from[3 * width]};
      *reinterpret_cast<Row *>(row) += added;
    }
  else
    for (int d = 0; d < n_fields; ++d)
      row[d] += from[d * width];
}

} // namespace internal

template <class Model>
Assembler<Model>::Assembler(const Model &model, const ShellSpace<degree, spacedim> &space,
                            std::shared_ptr<const Distribution> distribution, const std::vector<Tie> &ties,
                            const std::vector<Supports::WeakEdge> &weak_edges)
    : model_(&model),
      space_(&space),
      distribution_(std::move(distribution)),
      elements_(space.distribution().elements.size()),
      ties_(space, ties),
      tied_extractions_(ties_.n_elements()),
      scatter_(space.distribution()),
      ranges_(row_ranges(space.distribution(), omp_get_max_threads())),
      shortest_edge_(std::numeric_limits<double>::infinity()),
      largest_stiffness_(0.),
      phase_scale_(distribution_->n_owned(), 0.),
      point_area_(distribution_->n_owned(), 0.),
      interfaces_(model, space, ties),
      weak_edges_(model, space, ties, weak_edges)
{
  const auto &d = space.distribution();
  collectively(distribution_->comm(), [&] {
    std::exception_ptr error;
#pragma omp parallel
    {
      // A field given as a formula is not for several threads; copies of it are independent.
      const Model own = model;
#pragma omp for schedule(static)
      for (std::size_t e = 0; e < elements_.size(); ++e)
        try
          {
            elements_[e] = element_data(own, space.surface(), d.elements[e]);
            if (elements_[e].geometry.extraction.rows() > internal::max_element_points)
              throw InvalidParameter("assembler: " + std::to_string(elements_[e].geometry.extraction.rows()) +
                                     " functions on one element, at most " +
                                     std::to_string(internal::max_element_points) +
                                     " are foreseen; refine more evenly");
          }
        catch (...)
          {
#pragma omp critical
            error = std::current_exception();
          }
    }
    if (error)
      std::rethrow_exception(error);
  });
  for (const auto &tie : ties)
    if (const int a = d.local[tie.point]; a >= 0 && a < distribution_->n_owned())
      tied_unknowns_.push_back({a, tie.field});
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto &data = elements_[e];
      if (const int tied = ties_.index(static_cast<int>(e)); tied >= 0)
        for (int c = 0; c < n_fields; ++c)
          tied_extractions_[tied][c] = ties_.transfer(tied, c) * data.geometry.extraction;
      shortest_edge_ = std::min(shortest_edge_, sherd::shortest_edge(data.geometry));
      largest_stiffness_ =
          std::max(largest_stiffness_, *std::max_element(data.stiffness.begin(), data.stiffness.end()));
      std::optional<ShapeValues<degree>> storage;
      const auto                        &s      = data.geometry.shapes(storage);
      const auto                         points = space.points_of(static_cast<int>(e));
      for (int q = 0; q < n_q; ++q)
        {
          const double dA = data.geometry.reference[q].dA;
          for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i] < distribution_->n_owned())
              for (int b = 0; b < s.n_functions; ++b)
                {
                  const double part = data.geometry.extraction(i, b) * s.value[q][b] * dA;
                  point_area_[points[i]] += part;
                  phase_scale_[points[i]] += part * data.toughness[q] / (2. * model.length_scale);
                }
        }
    }
  MPI_Allreduce(MPI_IN_PLACE, &shortest_edge_, 1, MPI_DOUBLE, MPI_MIN, distribution_->comm());
  MPI_Allreduce(MPI_IN_PLACE, &largest_stiffness_, 1, MPI_DOUBLE, MPI_MAX, distribution_->comm());
}

template <class Model>
auto Assembler<Model>::extraction(int active, int field) const -> const ExtractionMatrix<degree> &
{
  const int tied = ties_.index(active);
  return tied < 0 ? elements_[active].geometry.extraction : tied_extractions_[tied][field];
}

template <class Model>
ElementFields<Model> Assembler<Model>::fields(int active, const Vector &position, const Vector &rate,
                                              const Vector &phase) const
{
  constexpr int        n_b    = ElementFields<Model>::n_b;
  const auto           points = space_->points_of(active);
  const auto          &E      = elements_[active].geometry.extraction;
  const auto           x = position.local(), a = rate.local(), phi = phase.local();
  ElementFields<Model> f{};
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double *row = E.data() + i * n_b;
      for (int d = 0; d < spacedim; ++d)
        {
          const double xi = x[points[i] * spacedim + d];
          const double ai = a[points[i] * spacedim + d];
          for (int b = 0; b < n_b; ++b)
            {
              f.position[d][b] += row[b] * xi;
              f.acceleration[d][b] += row[b] * ai;
            }
        }
      for (int b = 0; b < n_b; ++b)
        f.phase[b] += row[b] * phi[points[i]];
    }
  return f;
}

template <class Model>
template <Unknowns part>
void Assembler<Model>::scatter_force(int active, const ElementVector<Model> &f, const RowRange &range,
                                     Vector &force) const
{
  constexpr auto fields = fields_of(part, spacedim);
  const auto     points = space_->points_of(active);
  auto           out    = force.local();
  for (int c = fields.first; c < fields.first + fields.count; ++c)
    {
      const auto &E = extraction(active, c);
      for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i] >= range.begin && points[i] < range.end)
          {
            double sum = 0.;
            for (int b = 0; b < f.n_b; ++b)
              sum += E(i, b) * f.value[c][b];
            out[points[i] * n_fields + c] += sum;
          }
    }
}

template <class Model>
template <Unknowns part>
void Assembler<Model>::scatter_matrix(int active, const ElementMatrix<Model, part> &k, const RowRange &range,
                                      Matrix &matrix) const
{
  constexpr int n_b       = ElementMatrix<Model>::n_b;
  constexpr int n_scalar  = fields_of(part, spacedim).count; // rows of a block
  const auto    points    = space_->points_of(active);
  const int     n         = static_cast<int>(points.size());
  const auto    positions = scatter_.positions(active);
  double *const values    = matrix.values().data();

  // Most elements have no more functions than a tensor mesh; where meshes of different size meet there are some more.
  constexpr int tensor  = padded(n_b);
  constexpr int wider   = padded(n_b + 8);
  constexpr int widest  = internal::max_element_points;
  const int     width   = n <= tensor ? tensor : n <= wider ? wider : widest;
  const auto    extract = width == tensor  ? internal::extract<tensor, Model, part>
                          : width == wider ? internal::extract<wider, Model, part>
                                           : internal::extract<widest, Model, part>;

  const int          n_distinct = ties_.index(active) < 0 ? 1 : n_scalar;
  alignas(64) double transposed[n_scalar][n_b * widest];
  const double      *Et[n_scalar];
  for (int c = 0; c < n_scalar; ++c)
    Et[c] = transposed[c % n_distinct];
  for (int c = 0; c < n_distinct; ++c)
    {
      const auto &E = extraction(active, fields_of(part, spacedim).first + c);
      std::fill_n(transposed[c], n_b * width, 0.);
      for (int i = 0; i < n; ++i)
        for (int b = 0; b < n_b; ++b)
          transposed[c][b * width + i] = E(i, b);
    }

  alignas(64) double right[n_scalar * n_b * n_scalar * widest];
  alignas(64) double out[n_scalar * widest * n_scalar * widest];
  extract(n, Et, k, right, out);
  for (int c = 0; c < n_scalar; ++c)
    for (int i = 0; i < n; ++i)
      if (points[i] >= range.begin && points[i] < range.end)
        {
          double       *row  = values + matrix.row_start(points[i]) + c * matrix.row_length(points[i]);
          const int    *at   = positions.data() + i * n;
          const double *from = out + (c * n + i) * n_scalar * width;
          for (int j = 0; j < n; ++j)
            internal::add_block_row<n_scalar>(from + j, width, row + at[j] * n_scalar);
        }
}

template <class Model>
void Assembler<Model>::force(const BalanceLevel &level, const QuadratureField &history, Vector &force) const
{
  Vector none = force;
  this->force(level, history, {}, force, none);
}

template <class Model>
void Assembler<Model>::force(const BalanceLevel &level, const QuadratureField &history, const LoadValues<Model> &loads,
                             Vector &force, Vector &external) const
{
  part_force<Unknowns::all>(level, history, loads, force, external);
}

template <class Model>
template <Unknowns part>
void Assembler<Model>::part_force(const BalanceLevel &level, const QuadratureField &history,
                                  const LoadValues<Model> &loads, Vector &force, Vector &external) const
{
  force.fill(0.);
#pragma omp parallel for schedule(static, 1)
  for (std::size_t r = 0; r < ranges_.size(); ++r)
    for (const int e : ranges_[r].elements)
      {
        const auto           f = fields(e, level.position, level.acceleration, level.phase);
        ElementVector<Model> vector;
        if constexpr (part == Unknowns::phase)
          element_phase_force(*model_, elements_[e], f, history[e], active_energy(e, f, level).data(), vector);
        else
          element_force<part>(*model_, elements_[e], f, history[e], vector);
        scatter_force<part>(e, vector, ranges_[r], force);
      }
  interfaces_.add_force(level.position, level.phase, part, force);
  weak_edges_.add_force(level.position, level.phase, loads.time, part, force);
  if constexpr (has_displacement(part))
    external_force(level, loads, external);
}

template <class Model>
void Assembler<Model>::linearise(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                                 PhaseTangent phase_tangent, Vector &force, Matrix &matrix) const
{
  Vector none = force;
  linearise(level, history, mass_weight, phase_tangent, {}, force, none, matrix);
}

template <class Model>
void Assembler<Model>::linearise(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                                 PhaseTangent phase_tangent, const LoadValues<Model> &loads, Vector &force,
                                 Vector &external, Matrix &matrix) const
{
  linearise_part<Unknowns::all>(level, history, mass_weight, phase_tangent, loads, force, external, matrix);
}

template <class Model>
template <Unknowns part>
void Assembler<Model>::linearise_part(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                                      PhaseTangent phase_tangent, const LoadValues<Model> &loads, Vector &force,
                                      Vector &external, Matrix &matrix) const
{
  force.fill(0.);
  matrix.set_zero();
  if constexpr (has_displacement(part))
    external.fill(0.);
#pragma omp parallel for schedule(static, 1)
  for (std::size_t r = 0; r < ranges_.size(); ++r)
    for (const int e : ranges_[r].elements)
      {
        const auto                 f = fields(e, level.position, level.acceleration, level.phase);
        ElementVector<Model>       vector;
        ElementMatrix<Model, part> tangent;
        if constexpr (part == Unknowns::phase)
          element_phase_tangent(*model_, elements_[e], f, history[e], active_energy(e, f, level).data(), phase_tangent,
                                vector, tangent);
        else
          element_tangent(*model_, elements_[e], f, history[e], mass_weight, phase_tangent, vector, tangent);
        if constexpr (spacedim == 3 && has_displacement(part))
          if (!loads.pressure.empty())
            {
              ElementVector<Model> pressure = {};
              add_pressure(elements_[e], f, loads.pressure[e], pressure);
              add_pressure_tangent(elements_[e], f, loads.pressure[e], tangent);
              scatter_force(e, pressure, ranges_[r], external);
            }
        scatter_force<part>(e, vector, ranges_[r], force);
        scatter_matrix(e, tangent, ranges_[r], matrix);
      }
  interfaces_.linearise(level.position, level.phase, part, force, matrix);
  weak_edges_.linearise(level.position, level.phase, loads.time, part, force, matrix);
  constexpr auto fields = fields_of(part, spacedim);
  for (const auto &[a, field] : tied_unknowns_)
    if (fields.contains(field))
      matrix.diagonal(a, field - fields.first) = 1.;
  if constexpr (has_displacement(part))
    {
      if (loads.dead)
        axpy(1., *loads.dead, external);
      add_edge_moments(level.position, loads, external);
      add_edge_moment_tangents(level.position, loads, matrix);
    }
}

template <class Model>
void Assembler<Model>::mass_matrix(Matrix &matrix) const
{
  part_mass_matrix<Unknowns::all>(matrix);
}

template <class Model>
template <Unknowns part>
void Assembler<Model>::part_mass_matrix(Matrix &matrix) const
{
  static_assert(has_displacement(part), "the phase has no mass");
  constexpr int n_b = ElementMatrix<Model>::n_b;
  matrix.set_zero();
  for (const auto &range : ranges_)
    for (const int e : range.elements)
      {
        std::optional<ShapeValues<degree>> storage;
        const auto                        &s = elements_[e].geometry.shapes(storage);
        ElementMatrix<Model, part>         m = {};
        for (int q = 0; q < n_q; ++q)
          for (int d = 0; d < spacedim; ++d)
            for (int a = 0; a < n_b; ++a)
              for (int b = 0; b < n_b; ++b)
                m.value[d * n_b + a][d * n_b + b] +=
                    model_->mass * elements_[e].geometry.reference[q].dA * s.value[q][a] * s.value[q][b];
        scatter_matrix(e, m, range, matrix);
      }
  if constexpr (has_phase(part))
    for (int a = 0; a < distribution_->n_owned(); ++a)
      matrix.diagonal(a, spacedim) = 1.;
  interfaces_.set_identity(matrix);
  for (const auto &[a, field] : tied_unknowns_)
    if (field < matrix.block_size())
      matrix.diagonal(a, field) = 1.;
}

} // namespace sherd
