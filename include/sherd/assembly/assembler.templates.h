#pragma once

#include <limits>
#include <numeric>

#include <omp.h>

#include <sherd/assembly/assembler.h>
#include <sherd/base/collective.h>

namespace sherd
{

namespace internal
{

/// Control points of an element in the padded work space of the extraction.
inline constexpr int max_element_points = 48;

/// out[i][j] = sum_ab E_ia K_ab E_jb for one pair of fields: the element matrix on control points.
/// @param Et   transposed extraction, by rows, shape=(n_b, width), zero beyond column n
/// @param out  by rows, shape=(n, width)
template <int n_b, int width>
inline void extract_block(int n, const double *Et, const double *K, int stride_k, double *out)
{
  // right = K E^T, then out = E right; both as A^T B with A = K^T and A = E^T.
  double transposed[n_b * n_b];
  for (int a = 0; a < n_b; ++a)
    for (int b = 0; b < n_b; ++b)
      transposed[b * n_b + a] = K[a * stride_k + b];
  alignas(64) double right[n_b * width] = {};
  add_transposed_product<n_b, width>(n_b, transposed, n_b, Et, width, right, width);
  std::fill_n(out, n * width, 0.);
  for (int i = 0; i + 3 <= n; i += 3)
    add_rows<3, width / 4>(n_b, Et + i, width, right, width, out + i * width, width);
  for (int i = n / 3 * 3; i < n; ++i)
    add_rows<1, width / 4>(n_b, Et + i, width, right, width, out + i * width, width);
}

} // namespace internal

template <class Model>
Assembler<Model>::Assembler(const Model &model, const ShellSpace<degree, spacedim> &space,
                            std::shared_ptr<const Distribution> distribution)
    : model_(&model),
      space_(&space),
      distribution_(std::move(distribution)),
      elements_(space.distribution().elements.size()),
      scatter_(space.distribution()),
      ranges_(row_ranges(space.distribution(), omp_get_max_threads())),
      shortest_edge_(std::numeric_limits<double>::infinity()),
      phase_scale_(distribution_->n_owned(), 0.),
      point_area_(distribution_->n_owned(), 0.)
{
  const auto &d = space.distribution();
  collectively(distribution_->comm(), [&] {
    std::exception_ptr error;
#pragma omp parallel
    {
      // A toughness given as a formula is not for several threads; copies of it are independent.
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
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto &data = elements_[e];
      shortest_edge_   = std::min(shortest_edge_, sherd::shortest_edge(data.geometry));
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
void Assembler<Model>::scatter_force(int active, const ElementVector<Model> &f, const RowRange &range,
                                     Vector &force) const
{
  const auto  points = space_->points_of(active);
  const auto &E      = elements_[active].geometry.extraction;
  auto        out    = force.local();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i] >= range.begin && points[i] < range.end)
      for (int c = 0; c < n_fields; ++c)
        {
          double sum = 0.;
          for (int b = 0; b < f.n_b; ++b)
            sum += E(i, b) * f.value[c][b];
          out[points[i] * n_fields + c] += sum;
        }
}

template <class Model>
void Assembler<Model>::scatter_matrix(int active, const ElementMatrix<Model> &k, const RowRange &range,
                                      Matrix &matrix) const
{
  constexpr int n_b       = ElementMatrix<Model>::n_b;
  const auto    points    = space_->points_of(active);
  const int     n         = static_cast<int>(points.size());
  const auto   &E         = elements_[active].geometry.extraction;
  const auto    positions = scatter_.positions(active);
  double *const values    = matrix.values().data();

  // Degree 2 has 9 to 12 functions on the usual element, degree 3 16 to 24.
  constexpr int      widest           = internal::max_element_points;
  const int          width            = n <= 12 ? 12 : n <= 24 ? 24 : widest;
  const auto         block_of         = width == 12   ? internal::extract_block<n_b, 12>
                                        : width == 24 ? internal::extract_block<n_b, 24>
                                                      : internal::extract_block<n_b, widest>;
  alignas(64) double Et[n_b * widest] = {};
  alignas(64) double block[widest * widest];
  for (int i = 0; i < n; ++i)
    for (int b = 0; b < n_b; ++b)
      Et[b * width + i] = E(i, b);

  for (int c = 0; c < n_fields; ++c)
    for (int d = 0; d < n_fields; ++d)
      {
        block_of(n, Et, k.value[c * n_b] + d * n_b, k.stride, block);
        for (int i = 0; i < n; ++i)
          if (points[i] >= range.begin && points[i] < range.end)
            {
              double    *row = values + matrix.row_start(points[i]) + c * matrix.row_length(points[i]) + d;
              const int *at  = positions.data() + i * n;
              for (int j = 0; j < n; ++j)
                row[at[j] * n_fields] += block[i * width + j];
            }
      }
}

template <class Model>
void Assembler<Model>::force(const BalanceLevel &level, const QuadratureField &history, Vector &force) const
{
  force.fill(0.);
#pragma omp parallel for schedule(static, 1)
  for (std::size_t r = 0; r < ranges_.size(); ++r)
    for (const int e : ranges_[r].elements)
      {
        const auto           f = fields(e, level.position, level.acceleration, level.phase);
        ElementVector<Model> vector;
        element_force(*model_, elements_[e], f, history[e], vector);
        scatter_force(e, vector, ranges_[r], force);
      }
}

template <class Model>
void Assembler<Model>::linearise(const BalanceLevel &level, const QuadratureField &history, double mass_weight,
                                 PhaseTangent phase_tangent, Vector &force, Matrix &matrix) const
{
  force.fill(0.);
  matrix.set_zero();
#pragma omp parallel for schedule(static, 1)
  for (std::size_t r = 0; r < ranges_.size(); ++r)
    for (const int e : ranges_[r].elements)
      {
        const auto           f = fields(e, level.position, level.acceleration, level.phase);
        ElementVector<Model> vector;
        ElementMatrix<Model> tangent;
        element_tangent(*model_, elements_[e], f, history[e], mass_weight, phase_tangent, vector, tangent);
        scatter_force(e, vector, ranges_[r], force);
        scatter_matrix(e, tangent, ranges_[r], matrix);
      }
}

template <class Model>
void Assembler<Model>::mass_matrix(Matrix &matrix) const
{
  constexpr int n_b = ElementMatrix<Model>::n_b;
  matrix.set_zero();
  for (const auto &range : ranges_)
    for (const int e : range.elements)
      {
        std::optional<ShapeValues<degree>> storage;
        const auto                        &s = elements_[e].geometry.shapes(storage);
        ElementMatrix<Model>               m = {};
        for (int q = 0; q < n_q; ++q)
          for (int d = 0; d < spacedim; ++d)
            for (int a = 0; a < n_b; ++a)
              for (int b = 0; b < n_b; ++b)
                m.value[d * n_b + a][d * n_b + b] +=
                    model_->mass * elements_[e].geometry.reference[q].dA * s.value[q][a] * s.value[q][b];
        scatter_matrix(e, m, range, matrix);
      }
  auto values = matrix.values();
  for (int a = 0; a < distribution_->n_owned(); ++a)
    {
      const auto row = matrix.graph().row(a);
      const auto k   = std::lower_bound(row.begin(), row.end(), a) - row.begin();
      values[matrix.row_start(a) + spacedim * matrix.row_length(a) + k * n_fields + spacedim] = 1.;
    }
}

template <class Model>
void Assembler<Model>::add_loads(const Loads<spacedim> &loads, double time, Vector &force) const
{
  const auto &local = space_->distribution().local;
  auto        out   = force.local();
  const auto  add   = [&](int a, double weight, const Point<spacedim> &f) {
    if (a >= 0 && a < distribution_->n_owned())
      for (int d = 0; d < spacedim; ++d)
        out[a * n_fields + d] += weight * f[d];
  };
  for (const auto &load : loads.tractions())
    for (const auto &edge : space_->surface().edge(load.edge))
      for (const auto &piece : edge_geometry(space_->surface(), edge))
        for (const auto &q : piece.quadrature)
          {
            const auto t = load.traction(q.position, time);
            for (std::size_t i = 0; i < piece.points.size(); ++i)
              add(local[piece.points[i]], q.value[i] * q.dS, t);
          }
  for (const auto &body_force : loads.body_forces())
    for (std::size_t e = 0; e < elements_.size(); ++e)
      {
        const auto                        &g = elements_[e].geometry;
        std::optional<ShapeValues<degree>> storage;
        const auto                        &s      = g.shapes(storage);
        const auto                         points = space_->points_of(static_cast<int>(e));
        for (int q = 0; q < n_q; ++q)
          {
            const auto f = body_force(g.position(q), time);
            for (std::size_t i = 0; i < points.size(); ++i)
              {
                double value = 0.;
                for (int b = 0; b < s.n_functions; ++b)
                  value += g.extraction(i, b) * s.value[q][b];
                add(points[i], value * g.reference[q].dA, f);
              }
          }
      }
}

template <class Model>
Energies Assembler<Model>::energies(const Vector &position, const Vector &velocity, const Vector &phase) const
{
  const auto           &owns = space_->distribution().owns;
  std::vector<Energies> part(elements_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (owns[e])
      part[e] = element_energies(*model_, elements_[e], fields(static_cast<int>(e), position, velocity, phase));
  Energies sum;
  for (const auto &energies : part)
    sum += energies;
  double values[] = {sum.active, sum.passive, sum.kinetic, sum.fracture};
  MPI_Allreduce(MPI_IN_PLACE, values, 4, MPI_DOUBLE, MPI_SUM, distribution_->comm());
  return {values[0], values[1], values[2], values[3]};
}

template <class Model>
double Assembler<Model>::withheld_work(const BalanceLevel &level, const Vector &previous,
                                       const QuadratureField &history) const
{
  const auto         &owns = space_->distribution().owns;
  std::vector<double> part(elements_.size(), 0.);
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (owns[e])
      {
        const auto now    = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
        const auto before = fields(static_cast<int>(e), level.position, level.acceleration, previous);
        part[e]           = element_withheld_work(*model_, elements_[e], now, before.phase, history[e]);
      }
  double sum = std::accumulate(part.begin(), part.end(), 0.);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, distribution_->comm());
  return sum;
}

template <class Model>
QuadratureField Assembler<Model>::committed(const BalanceLevel &level, const QuadratureField &history) const
{
  QuadratureField result = history;
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto f      = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
      const auto energy = element_active_energy(*model_, elements_[e], f);
      for (int q = 0; q < n_q; ++q)
        result[e][q] = model_->irreversibility.trial(history[e][q], energy[q]);
    }
  return result;
}

template <class Model>
std::vector<double> Assembler<Model>::intensity(const QuadratureField &history) const
{
  std::vector<double> result(elements_.size(), 0.);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int q = 0; q < n_q; ++q)
      result[e] = std::max(result[e], history[e][q] / branch::onset(model_->degradation, elements_[e].toughness[q],
                                                                    model_->length_scale));
  return result;
}

template <class Model>
SuspectElements Assembler<Model>::suspects(const BalanceLevel &level, const QuadratureField &history) const
{
  SuspectElements result;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto f         = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
      const auto phase     = element_phase<Model>(elements_[e], f);
      const auto bound     = *std::max_element(phase.begin(), phase.end());
      result.largest_phase = std::max(result.largest_phase, bound);
      if (bound <= branch::suspect_phase)
        continue;
      const auto energy = element_active_energy(*model_, elements_[e], f);
      for (int q = 0; q < n_q; ++q)
        if (branch::is_suspect(model_->degradation, model_->irreversibility.trial(history[e][q], energy[q]), phase[q],
                               elements_[e].toughness[q], model_->length_scale))
          {
            result.active.push_back(static_cast<int>(e));
            break;
          }
    }
  return result;
}

template <class Model>
std::vector<typename Assembler<Model>::ElementDensities> Assembler<Model>::densities(const Vector &position,
                                                                                     const Vector &phase) const
{
  std::vector<ElementDensities> result;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (space_->distribution().owns[e])
      {
        const auto f    = fields(static_cast<int>(e), position, position, phase);
        const auto sum  = element_energies(*model_, elements_[e], f);
        double     area = 0.;
        for (const auto &q : elements_[e].geometry.reference)
          area += q.dA;
        result.push_back({sum.elastic() / area, sum.fracture / area});
      }
  return result;
}

} // namespace sherd
