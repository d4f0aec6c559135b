#pragma once

#include <algorithm>
#include <array>

#include <sherd/forms/element_arrays.h>
#include <sherd/forms/point_stiffness.h>

/// Tables of several quadrature points, whose products with the shape functions are the tangent of an element (theory
/// E.2).
namespace sherd::internal
{

/// Sizes of the tables of an element. Each row of a right table holds several runs of n_b columns side by side, so that
/// one product fills whole vector registers. Runs are written from left to right in whole registers, each over the
/// zeros that the one before it left behind itself.
template <class Model>
struct TableSizes
{
  static constexpr int dim   = Model::spacedim;
  static constexpr int n_b   = ElementMatrix<Model>::n_b;
  static constexpr int n_q   = ShapeValues<Model::degree>::n_points;
  static constexpr int pairs = n_pairs<dim>;
  static constexpr int pad_b = padded(n_b);
  static constexpr int packs = pad_b / pack_size;

  /// Quadrature points at a time: as many as keep the tables in the first cache.
  static constexpr int n_points = Model::degree == 2 ? n_q : Model::degree == 3 ? 8 : 5;
  static_assert(n_q % n_points == 0);

  static constexpr int columns(int runs) { return padded(runs * n_b); }
  static constexpr int stride(int runs) { return padded((runs - 1) * n_b + pad_b); }
};

/// Shape functions of some quadrature points, left factors of the products.
template <class Model>
struct ShapeTables : TableSizes<Model>
{
  using TableSizes<Model>::n_b, TableSizes<Model>::n_points, TableSizes<Model>::pad_b, TableSizes<Model>::packs;

  /// One point in registers.
  struct AtPoint
  {
    Pack value[packs], derivative[n_derivatives][packs];

    void store_value(double weight, double *out) const
    {
      for (int k = 0; k < packs; ++k)
        *reinterpret_cast<Pack *>(out + k * pack_size) = weight * value[k];
    }

    /// out = sum_r weights_r P_r over the first @p count derivatives: a run of n_b columns and zeros behind it.
    template <int count>
    void store(const DerivativePack &weights, double *out) const
    {
      for (int k = 0; k < packs; ++k)
        {
          Pack sum = weights[0] * derivative[0][k];
          for (int r = 1; r < count; ++r)
            sum += weights[r] * derivative[r][k];
          *reinterpret_cast<Pack *>(out + k * pack_size) = sum;
        }
    }
  };

  alignas(64) double value[n_points][pad_b];                     ///< N
  alignas(64) double derivative[n_derivatives][n_points][pad_b]; ///< P_r

  /// Of polynomial elements, computed once.
  static const ShapeTables &polynomial(int first_point)
  {
    static const auto tables = [] {
      std::array<ShapeTables, TableSizes<Model>::n_q / n_points> all;
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i].load(polynomial_shape_values<Model::degree>(), static_cast<int>(i) * n_points);
      return all;
    }();
    return tables[first_point / n_points];
  }

  const ShapeTables &load(const ShapeValues<Model::degree> &s, int first_point)
  {
    const auto copy = [](const std::array<double, n_b> &from, double *to) {
      std::copy(from.begin(), from.end(), to);
      std::fill(to + n_b, to + pad_b, 0.);
    };
    for (int k = 0; k < n_points; ++k)
      {
        const int q = first_point + k;
        copy(s.value[q], value[k]);
        copy(s.d1[q], derivative[0][k]);
        copy(s.d2[q], derivative[1][k]);
        copy(s.d11[q], derivative[2][k]);
        copy(s.d22[q], derivative[3][k]);
        copy(s.d12[q], derivative[4][k]);
      }
    return *this;
  }

  AtPoint at(int k) const
  {
    AtPoint p;
    for (int i = 0; i < packs; ++i)
      {
        p.value[i] = *reinterpret_cast<const Pack *>(value[k] + i * pack_size);
        for (int r = 0; r < n_derivatives; ++r)
          p.derivative[r][i] = *reinterpret_cast<const Pack *>(derivative[r][k] + i * pack_size);
      }
    return p;
  }
};

/// What the tangent has by derivatives of shape functions on both sides: runs of the phase and of each pair of
/// displacements, as far as the part has them. In the plane the displacements have first derivatives only.
template <class Model, Unknowns part>
struct DerivativeTables : TableSizes<Model>
{
  using Sizes = TableSizes<Model>;
  using Sizes::dim, Sizes::n_b, Sizes::n_points, Sizes::pairs, Sizes::pad_b;

  static constexpr int of_phase  = has_phase(part) ? 1 : 0; // runs
  static constexpr int of_first  = of_phase + (has_displacement(part) ? pairs : 0);
  static constexpr int of_second = dim == 2 ? of_phase : of_first;
  static constexpr int stride = Sizes::stride(of_first), stride_second = Sizes::stride(std::max(of_second, 1));
  static_assert(stride >= Sizes::columns(of_first));

  alignas(64) double first[2][n_points][stride];         ///< index order [derivative][point][column]
  alignas(64) double second[3][n_points][stride_second]; ///< the same
  alignas(64) double sum[n_b][stride];                   ///< of products with the shape functions

  void clear_sum() { std::fill_n(sum[0], n_b * stride, 0.); }
  void clear_points()
  {
    std::fill_n(first[0][0], 2 * n_points * stride, 0.);
    std::fill_n(second[0][0], 3 * n_points * stride_second, 0.);
  }

  /// @param phase   stiffness of the phase by derivatives, as PointStiffness
  void set(int k, const typename ShapeTables<Model>::AtPoint &shapes,
           const std::array<DerivativePack, n_derivatives> &phase, const PointStiffness<dim> &displacement)
  {
    for (int r = 0; r < 2; ++r)
      {
        if constexpr (has_phase(part))
          shapes.template store<n_derivatives>(phase[r], first[r][k]);
        if constexpr (has_displacement(part))
          for (int pair = 0; pair < pairs; ++pair)
            shapes.template store<dim == 2 ? 2 : n_derivatives>(displacement[pair][r],
                                                                first[r][k] + (of_phase + pair) * n_b);
      }
    for (int r = 0; r < 3; ++r)
      {
        if constexpr (has_phase(part))
          shapes.template store<n_derivatives>(phase[2 + r], second[r][k]);
        if constexpr (dim == 3 && has_displacement(part))
          for (int pair = 0; pair < pairs; ++pair)
            shapes.template store<n_derivatives>(displacement[pair][2 + r], second[r][k] + (of_phase + pair) * n_b);
      }
  }

  void multiply(const ShapeTables<Model> &shapes)
  {
    const auto left = [&](int derivative) { return Strided{shapes.derivative[derivative][0], 1, pad_b}; };
    // In space both tables are as wide as each other and one behind the other.
    constexpr int depth = dim == 2 ? 2 * n_points : n_derivatives * n_points;
    add_product<Sizes::columns(of_first)>(n_b, depth, left(0), first[0][0], stride, sum[0], stride);
    if constexpr (dim == 2 && has_phase(part))
      add_product<Sizes::columns(of_second)>(n_b, 3 * n_points, left(2), second[0][0], stride_second, sum[0], stride);
  }

  const double *phase_row(int a) const { return sum[a]; }
  const double *pair_row(int a, int pair) const { return sum[a] + (of_phase + pair) * n_b; }
};

/// What the tangent has by shape functions on one side: runs of the phase, the mass, the stress by strain and the
/// driving force by strain, the latter two for each component of the displacement, as far as the part has them.
template <class Model, Unknowns part>
struct ValueTables : TableSizes<Model>
{
  using Sizes = TableSizes<Model>;
  using Sizes::dim, Sizes::n_b, Sizes::n_points, Sizes::pad_b;

  static constexpr int of_phase = has_phase(part) ? 1 : 0, of_mass = has_displacement(part) ? 1 : 0; // runs
  static constexpr int first_slope = of_phase + of_mass;
  static constexpr int runs = first_slope + (part == Unknowns::all ? 2 * dim : 0), stride = Sizes::stride(runs);
  static_assert(stride >= Sizes::columns(runs));

  alignas(64) double value[n_points][stride];
  alignas(64) double sum[n_b][stride] = {};

  void set(int k, const typename ShapeTables<Model>::AtPoint &shapes, double phase, double mass,
           const PointSlope<dim> &coupling, const PointSlope<dim> &driving)
  {
    constexpr int count = dim == 2 ? 2 : n_derivatives;
    if constexpr (has_phase(part))
      shapes.store_value(phase, value[k]);
    if constexpr (has_displacement(part))
      shapes.store_value(mass, value[k] + of_phase * n_b);
    if constexpr (part == Unknowns::all)
      {
        for (int i = 0; i < dim; ++i)
          shapes.template store<count>(coupling[i], value[k] + (first_slope + i) * n_b);
        for (int i = 0; i < dim; ++i)
          shapes.template store<count>(driving[i], value[k] + (first_slope + dim + i) * n_b);
      }
  }

  void multiply(const ShapeTables<Model> &shapes)
  {
    add_product<Sizes::columns(runs)>(n_b, n_points, {shapes.value[0], 1, pad_b}, value[0], stride, sum[0], stride);
  }

  const double *phase_row(int a) const { return sum[a]; }
  const double *mass_row(int a) const { return sum[a] + of_phase * n_b; }
  const double *coupling_row(int a) const { return sum[a] + first_slope * n_b; } ///< by components, then functions
  const double *driving_row(int a) const { return sum[a] + (first_slope + dim) * n_b; } ///< the same
};

/// Tables of the tangent of one element by the unknowns of a part and their sums.
template <class Model, Unknowns part>
class TangentTables : TableSizes<Model>
{
public:
  using Sizes = TableSizes<Model>;
  using Sizes::dim, Sizes::n_b, Sizes::n_points;

  explicit TangentTables(const ElementGeometry<Model::degree, Model::spacedim> &geometry) : geometry_(&geometry)
  {
    symmetric_.clear_sum();
  }

  /// Starts with n_points points from @p first_point on. @param s   shape functions of the element
  void begin(const ShapeValues<Model::degree> &s, int first_point)
  {
    shapes_ =
        geometry_->denominator ? &rational_shapes_.load(s, first_point) : &ShapeTables<Model>::polynomial(first_point);
    skew_here_ = false;
  }

  /// Adds a point of the phase alone.
  void set(int k, const std::array<DerivativePack, n_derivatives> &phase_stiffness,
           double phase_value) requires(part == Unknowns::phase)
  {
    const auto shapes = shapes_->at(k);
    values_.set(k, shapes, phase_value, 0., {}, {});
    symmetric_.set(k, shapes, phase_stiffness, {});
  }

  /// Adds a point. What the part does not have is not used.
  /// @param D       dA c^abcd and so on
  /// @param total   stress times dA
  void set(int k, const SurfaceFrame<dim> &frame, const Tangent<dim> &D, const Stress<dim> &total,
           const std::array<DerivativePack, n_derivatives> &phase_stiffness, double phase_value, double mass,
           const PointSlope<dim> &coupling, const PointSlope<dim> &driving) requires(has_displacement(part))
  {
    const auto shapes      = shapes_->at(k);
    const bool unsymmetric = is_unsymmetric(D);
    values_.set(k, shapes, phase_value, mass, coupling, driving);
    symmetric_.set(
        k, shapes, phase_stiffness,
        point_stiffness(frame, unsymmetric ? part_of(D, Symmetry::symmetric) : D, total, Symmetry::symmetric));
    if (unsymmetric)
      {
        if (!skew_here_)
          skew_tables_.clear_points();
        if (!has_skew_)
          skew_tables_.clear_sum();
        skew_here_ = has_skew_ = true;
        skew_tables_.set(k, shapes, {},
                         point_stiffness(frame, part_of(D, Symmetry::skew), Stress<dim>::zero(), Symmetry::skew));
      }
  }

  void multiply()
  {
    values_.multiply(*shapes_);
    symmetric_.multiply(*shapes_);
    if (skew_here_)
      skew_tables_.multiply(*shapes_);
  }

  void store(ElementMatrix<Model, part> &matrix) const
  {
    if constexpr (has_displacement(part))
      store_displacement(matrix);
    constexpr int n_u = has_displacement(part) ? dim * n_b : 0;
    if constexpr (has_phase(part))
      for (int a = 0; a < n_b; ++a)
        {
          double *row = matrix.value[n_u + a];
          for (int k = 0; k < n_u; ++k)
            {
              matrix.value[k][n_u + a] = values_.coupling_row(a)[k];
              row[k]                   = values_.driving_row(a)[k];
            }
          for (int b = 0; b < n_b; ++b)
            row[n_u + b] = values_.phase_row(a)[b] + symmetric_.phase_row(a)[b];
        }
    for (auto &row : matrix.value)
      std::fill(row + matrix.size, row + matrix.stride, 0.);
  }

private:
  void store_displacement(ElementMatrix<Model, part> &matrix) const
  {
    for (int i = 0, pair = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j, ++pair)
        for (int a = 0; a < n_b; ++a)
          {
            const double *entries = symmetric_.pair_row(a, pair);
            double       *row     = matrix.value[i * n_b + a] + j * n_b;
            if (i == j)
              for (int b = 0; b < n_b; ++b)
                row[b] = entries[b] + values_.mass_row(a)[b];
            else
              for (int b = 0; b < n_b; ++b)
                row[b] = matrix.value[j * n_b + b][i * n_b + a] = entries[b];
          }
    if (has_skew_)
      for (int i = 0, pair = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j, ++pair)
          for (int a = 0; a < n_b; ++a)
            for (int b = 0; b < n_b; ++b)
              {
                const double entry = skew_tables_.pair_row(a, pair)[b];
                matrix.value[i * n_b + a][j * n_b + b] += entry;
                if (i != j)
                  matrix.value[j * n_b + b][i * n_b + a] -= entry;
              }
  }

  const ElementGeometry<Model::degree, Model::spacedim> *geometry_;
  const ShapeTables<Model>                              *shapes_ = nullptr;

  ShapeTables<Model>            rational_shapes_;
  ValueTables<Model, part>      values_;
  DerivativeTables<Model, part> symmetric_, skew_tables_;
  bool                          skew_here_ = false; ///< at a point of those set since begin()
  bool                          has_skew_  = false; ///< at any point
};

} // namespace sherd::internal
