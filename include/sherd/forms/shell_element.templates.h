#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/forms/shell_element.h>
#include <sherd/fracture/branch.h>

namespace sherd
{

namespace internal
{

/// Force of an element while it is summed up: all fields of one shape function side by side, shape=(n_b).
template <class Model>
struct ForceSum
{
  static constexpr int n_b = ElementVector<Model>::n_b;

  FieldPack sum[n_b] = {};

  void store(ElementVector<Model> &force) const
  {
    for (int c = 0; c < Model::n_fields; ++c)
      for (int b = 0; b < n_b; ++b)
        force.value[c][b] = sum[b][c];
  }
};

/// Adds quadrature point @p q: the coefficients of N and of its derivatives in the weak form, times these.
/// @param total   stress of the damaged surface times dA
template <class Model>
void add_point_force(const Model &model, const ElementData<Model> &data, const ShapeValues<Model::degree> &s,
                     const PointState<Model> &p, const Stress<Model::spacedim> &total, int q, ForceSum<Model> &force)
{
  constexpr int dim       = Model::spacedim;
  const auto   &reference = data.geometry.reference[q];
  const double  dA        = reference.dA;
  const double  l0        = model.length_scale;
  const double  stiffness = data.toughness[q] / (2. * l0) * dA;
  const auto   &A         = reference.contravariant;
  const double  c1        = stiffness * model.crack_density.c1(l0);
  const double  bend      = stiffness * model.crack_density.c2(l0) * p.laplacian;

  FieldPack n{}, n1{}, n2{}, n11{}, n22{}, n12{};
  n[dim]   = model.degradation.first(p.phi) * p.driving * dA + stiffness * (p.phi - 1.);
  n1[dim]  = c1 * (A[0] * p.phi_1 + A[2] * p.phi_2) - bend * reference.laplace_1;
  n2[dim]  = c1 * (A[2] * p.phi_1 + A[1] * p.phi_2) - bend * reference.laplace_2;
  n11[dim] = bend * A[0];
  n22[dim] = bend * A[1];
  n12[dim] = 2. * bend * A[2];

  const Voigt &tau = total.membrane;
  for (int d = 0; d < dim; ++d)
    {
      n[d]  = dA * model.mass * p.inertia[d];
      n1[d] = tau[0] * p.frame.a1[d] + tau[2] * p.frame.a2[d];
      n2[d] = tau[2] * p.frame.a1[d] + tau[1] * p.frame.a2[d];
    }
  if constexpr (dim == 3)
    {
      // M^ab N;ab = M^ab N,ab - (M^ab Gamma^c_ab) N,c
      const Voigt &M  = total.moment;
      const double m1 = contract(M, p.frame.christoffel_1), m2 = contract(M, p.frame.christoffel_2);
      for (int d = 0; d < dim; ++d)
        {
          const double normal = p.frame.normal[d];
          n1[d] -= m1 * normal;
          n2[d] -= m2 * normal;
          n11[d] = M[0] * normal;
          n22[d] = M[1] * normal;
          n12[d] = 2. * M[2] * normal;
        }
    }
  for (int b = 0; b < force.n_b; ++b)
    force.sum[b] += s.value[q][b] * n + s.d1[q][b] * n1 + s.d2[q][b] * n2 + s.d11[q][b] * n11 + s.d22[q][b] * n22 +
                    s.d12[q][b] * n12;
}

/// Derivatives of a shape function: N,1 N,2 N,11 N,22 N,12.
inline constexpr int n_derivatives = 5;

/// A factor for each derivative, side by side in whole registers; the rest holds zeros.
typedef double DerivativePack __attribute__((vector_size(64)));

/// Pairs of components i <= j of the displacement, row by row: (0, 0), (0, 1), ...
template <int spacedim>
inline constexpr int n_pairs = spacedim *(spacedim + 1) / 2;

/// Stiffness of the displacements at one point by derivatives of the shape functions P_r,
///
///   K_AB^ij = sum_rs P_r(A) stiffness[pair(i, j)][r][s] P_s(B)   for i <= j,
///
/// r = 1, 2 only in the plane. The rest follows from symmetry, or from skew symmetry.
template <int spacedim>
using PointStiffness = std::array<std::array<DerivativePack, spacedim == 2 ? 2 : n_derivatives>, n_pairs<spacedim>>;

/// A stress contracted with the strain by displacement component i, sum_r P_r(A) slope[i][r].
template <int spacedim>
using PointSlope = std::array<DerivativePack, spacedim>;

/// Engineering membrane strains of component i of the displacement: (a1_i, 0, a2_i) N,1 + (0, a2_i, a1_i) N,2.
template <int spacedim>
struct MembraneStrain
{
  const SurfaceFrame<spacedim> &frame;

  /// Contraction of rows (11, 22, 12) with the strain by N,1 or N,2 of component i.
  template <class T>
  auto contract(int derivative, int i, const T &row_11, const T &row_22, const T &row_12) const
  {
    return derivative == 0 ? frame.a1[i] * row_11 + frame.a2[i] * row_12 : frame.a2[i] * row_22 + frame.a1[i] * row_12;
  }

  /// stress^ab e_ab of component i.
  DerivativePack slope(int i, const Voigt &stress) const
  {
    return DerivativePack{contract(0, i, stress[0], stress[1], stress[2]),
                          contract(1, i, stress[0], stress[1], stress[2])};
  }

  /// Row r of the membrane part for a pair of components, with the geometric stiffness tau on its diagonal.
  DerivativePack row(int r, int i, int j, const Voigt4 &D, const Voigt &tau) const
  {
    double entry[2];
    for (int s = 0; s < 2; ++s)
      {
        const double x = contract(s, j, D(0, 0), D(0, 1), D(0, 2));
        const double y = contract(s, j, D(1, 0), D(1, 1), D(1, 2));
        const double z = contract(s, j, D(2, 0), D(2, 1), D(2, 2));
        entry[s]       = contract(r, i, x, y, z) + (i == j ? tau[r == s ? r : 2] : 0.);
      }
    return DerivativePack{entry[0], entry[1]};
  }
};

/// Changes of curvature (11, 22, 2 x 12) along the normal by derivatives: N;ab = N,ab - Gamma^c_ab N,c.
struct CurvatureChange
{
  explicit CurvatureChange(const SurfaceFrame<3> &frame)
  {
    const Voigt &one = frame.christoffel_1, &two = frame.christoffel_2;
    rows[0] = DerivativePack{-one[0], -two[0], 1.};
    rows[1] = DerivativePack{-one[1], -two[1], 0., 1.};
    rows[2] = DerivativePack{-2. * one[2], -2. * two[2], 0., 0., 2.};
  }

  /// sum_i values_i rows_i
  template <class Values>
  DerivativePack contract(const Values &values) const
  {
    return values[0] * rows[0] + values[1] * rows[1] + values[2] * rows[2];
  }

  DerivativePack rows[3];
};

/// A tangent and its transpose are equal where the stress derives from an energy.
enum class Symmetry
{
  symmetric,
  skew
};

/// Symmetric or skew part of a tangent.
inline Tangent<2> part(const Tangent<2> &D, Symmetry symmetry)
{
  const double sign = symmetry == Symmetry::symmetric ? .5 : -.5;
  return {.5 * D.membrane + sign * D.membrane.transpose()};
}
inline Tangent<3> part(const Tangent<3> &D, Symmetry symmetry)
{
  const double sign     = symmetry == Symmetry::symmetric ? .5 : -.5;
  const Voigt4 coupling = .5 * D.coupling + sign * D.moment_coupling.transpose();
  return {.5 * D.membrane + sign * D.membrane.transpose(), coupling, 2. * sign * coupling.transpose(),
          .5 * D.bending + sign * D.bending.transpose()};
}

/// Whether a tangent differs from its transpose by more than rounding.
inline bool is_unsymmetric(const Voigt4 &A, const Voigt4 &B)
{
  double difference = 0.;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      difference = std::max(difference, std::abs(A(i, j) - B(j, i)));
  return difference > 1e-12 * A.cwiseAbs().maxCoeff();
}
inline bool is_unsymmetric(const Tangent<2> &D)
{
  return is_unsymmetric(D.membrane, D.membrane);
}
inline bool is_unsymmetric(const Tangent<3> &D)
{
  return is_unsymmetric(D.membrane, D.membrane) || is_unsymmetric(D.bending, D.bending) ||
         is_unsymmetric(D.coupling, D.moment_coupling);
}

/// @param D         dA c^abcd, its symmetric or skew part
/// @param total     dA tau^ab, of the geometric stiffness
/// @param symmetry  of D
inline PointStiffness<2> point_stiffness(const SurfaceFrame<2> &frame, const Tangent<2> &D, const Stress<2> &total,
                                         Symmetry)
{
  const MembraneStrain<2> strain{frame};
  PointStiffness<2>       stiffness;
  for (int i = 0, pair = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j, ++pair)
      for (int r = 0; r < 2; ++r)
        stiffness[pair][r] = strain.row(r, i, j, D.membrane, total.membrane);
  return stiffness;
}

/// The geometric part of bending is, with p^c = N,c n and u^c = M^ab N;ab a^c + 1/2 (b_ab M^ab) a^cd N,d n,
/// -(p^c u^c + u^c p^c), c = 1, 2 (theory E.2).
inline PointStiffness<3> point_stiffness(const SurfaceFrame<3> &frame, const Tangent<3> &D, const Stress<3> &total,
                                         Symmetry symmetry)
{
  const double            sign = symmetry == Symmetry::symmetric ? 1. : -1.;
  const MembraneStrain<3> strain{frame};
  const CurvatureChange   change(frame);
  const Voigt            &a         = frame.metric.contravariant;
  const Point<3>         &n         = frame.normal;
  const Point<3>          dual[2]   = {frame.dual_1, frame.dual_2};
  const double            bM        = contract(frame.curvature, total.moment);
  const DerivativePack    m         = change.contract(total.moment); // M^ab N;ab = m_s P_s
  const DerivativePack    metric[2] = {{bM * a[0], bM * a[2]}, {bM * a[2], bM * a[1]}};

  // Membrane stress by change of curvature, for each strain by N,c of component i; change of curvature by itself.
  DerivativePack coupling[3], bending[3], mixed[2][3];
  for (int k = 0; k < 3; ++k)
    {
      coupling[k] = change.contract(D.coupling.row(k));
      bending[k]  = change.contract(D.bending.row(k));
    }
  for (int c = 0; c < 2; ++c)
    for (int i = 0; i < 3; ++i)
      mixed[c][i] = strain.contract(c, i, coupling[0], coupling[1], coupling[2]);
  DerivativePack Q[n_derivatives];
  for (int r = 0; r < n_derivatives; ++r)
    Q[r] = change.rows[0][r] * bending[0] + change.rows[1][r] * bending[1] + change.rows[2][r] * bending[2];

  PointStiffness<3> stiffness;
  for (int i = 0, pair = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++pair)
      {
        const double nn = n[i] * n[j];
        for (int r = 0; r < n_derivatives; ++r)
          {
            const double   y[2] = {sign * n[i] * mixed[0][j][r] - n[j] * dual[0][i] * m[r],
                                   sign * n[i] * mixed[1][j][r] - n[j] * dual[1][i] * m[r]};
            DerivativePack row  = nn * Q[r] + DerivativePack{y[0], y[1]};
            if (r < 2)
              row += n[j] * mixed[r][i] - n[i] * dual[r][j] * m - nn * metric[r] +
                     strain.row(r, i, j, D.membrane, total.membrane);
            stiffness[pair][r] = row;
          }
      }
  return stiffness;
}

inline PointSlope<2> point_slope(const SurfaceFrame<2> &frame, const Stress<2> &stress)
{
  const MembraneStrain<2> strain{frame};
  return {strain.slope(0, stress.membrane), strain.slope(1, stress.membrane)};
}

inline PointSlope<3> point_slope(const SurfaceFrame<3> &frame, const Stress<3> &stress)
{
  const MembraneStrain<3> strain{frame};
  const DerivativePack    m = CurvatureChange(frame).contract(stress.moment);
  PointSlope<3>           slope;
  for (int i = 0; i < 3; ++i)
    slope[i] = strain.slope(i, stress.membrane) + frame.normal[i] * m;
  return slope;
}

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
/// displacements. In the plane the displacements have first derivatives only.
template <class Model>
struct DerivativeTables : TableSizes<Model>
{
  using Sizes = TableSizes<Model>;
  using Sizes::dim, Sizes::n_b, Sizes::n_points, Sizes::pairs, Sizes::pad_b;

  static constexpr int of_first = 1 + pairs, of_second = dim == 2 ? 1 : of_first;
  static constexpr int stride = Sizes::stride(of_first), stride_second = Sizes::stride(of_second);
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
        shapes.template store<n_derivatives>(phase[r], first[r][k]);
        for (int pair = 0; pair < pairs; ++pair)
          shapes.template store<dim == 2 ? 2 : n_derivatives>(displacement[pair][r], first[r][k] + (1 + pair) * n_b);
      }
    for (int r = 0; r < 3; ++r)
      {
        shapes.template store<n_derivatives>(phase[2 + r], second[r][k]);
        if constexpr (dim == 3)
          for (int pair = 0; pair < pairs; ++pair)
            shapes.template store<n_derivatives>(displacement[pair][2 + r], second[r][k] + (1 + pair) * n_b);
      }
  }

  void multiply(const ShapeTables<Model> &shapes)
  {
    const auto left = [&](int derivative) { return Strided{shapes.derivative[derivative][0], 1, pad_b}; };
    // In space both tables are as wide as each other and one behind the other.
    constexpr int depth = dim == 2 ? 2 * n_points : n_derivatives * n_points;
    add_product<Sizes::columns(of_first)>(n_b, depth, left(0), first[0][0], stride, sum[0], stride);
    if constexpr (dim == 2)
      add_product<Sizes::columns(of_second)>(n_b, 3 * n_points, left(2), second[0][0], stride_second, sum[0], stride);
  }

  const double *phase_row(int a) const { return sum[a]; }
  const double *pair_row(int a, int pair) const { return sum[a] + (1 + pair) * n_b; }
};

/// What the tangent has by shape functions on one side: runs of the phase, the mass, the stress by strain and the
/// driving force by strain, the latter two for each component of the displacement.
template <class Model>
struct ValueTables : TableSizes<Model>
{
  using Sizes = TableSizes<Model>;
  using Sizes::dim, Sizes::n_b, Sizes::n_points, Sizes::pad_b;

  static constexpr int runs = 2 + 2 * dim, stride = Sizes::stride(runs);
  static_assert(stride >= Sizes::columns(runs));

  alignas(64) double value[n_points][stride];
  alignas(64) double sum[n_b][stride] = {};

  void set(int k, const typename ShapeTables<Model>::AtPoint &shapes, double phase, double mass,
           const PointSlope<dim> &coupling, const PointSlope<dim> &driving)
  {
    constexpr int count = dim == 2 ? 2 : n_derivatives;
    shapes.store_value(phase, value[k]);
    shapes.store_value(mass, value[k] + n_b);
    for (int i = 0; i < dim; ++i)
      shapes.template store<count>(coupling[i], value[k] + (2 + i) * n_b);
    for (int i = 0; i < dim; ++i)
      shapes.template store<count>(driving[i], value[k] + (2 + dim + i) * n_b);
  }

  void multiply(const ShapeTables<Model> &shapes)
  {
    add_product<Sizes::columns(runs)>(n_b, n_points, {shapes.value[0], 1, pad_b}, value[0], stride, sum[0], stride);
  }

  const double *phase_row(int a) const { return sum[a]; }
  const double *mass_row(int a) const { return sum[a] + n_b; }
  const double *coupling_row(int a) const { return sum[a] + 2 * n_b; }        ///< by components, then functions
  const double *driving_row(int a) const { return sum[a] + (2 + dim) * n_b; } ///< the same
};

/// Tables of the tangent of one element and their sums.
template <class Model>
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

  /// Adds a point.
  /// @param D       dA c^abcd and so on
  /// @param total   stress times dA
  void set(int k, const SurfaceFrame<dim> &frame, const Tangent<dim> &D, const Stress<dim> &total,
           const std::array<DerivativePack, n_derivatives> &phase_stiffness, double phase_value, double mass,
           const PointSlope<dim> &coupling, const PointSlope<dim> &driving)
  {
    const auto shapes = shapes_->at(k);
    values_.set(k, shapes, phase_value, mass, coupling, driving);
    const bool unsymmetric = is_unsymmetric(D);
    symmetric_.set(k, shapes, phase_stiffness,
                   point_stiffness(frame, unsymmetric ? part(D, Symmetry::symmetric) : D, total, Symmetry::symmetric));
    if (unsymmetric)
      {
        if (!skew_here_)
          skew_tables_.clear_points();
        if (!has_skew_)
          skew_tables_.clear_sum();
        skew_here_ = has_skew_ = true;
        skew_tables_.set(k, shapes, {},
                         point_stiffness(frame, part(D, Symmetry::skew), Stress<dim>::zero(), Symmetry::skew));
      }
  }

  void multiply()
  {
    values_.multiply(*shapes_);
    symmetric_.multiply(*shapes_);
    if (skew_here_)
      skew_tables_.multiply(*shapes_);
  }

  void store(ElementMatrix<Model> &matrix) const
  {
    constexpr int n_u = dim * n_b;
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
  const ElementGeometry<Model::degree, Model::spacedim> *geometry_;
  const ShapeTables<Model>                              *shapes_ = nullptr;

  ShapeTables<Model>      rational_shapes_;
  ValueTables<Model>      values_;
  DerivativeTables<Model> symmetric_, skew_tables_;
  bool                    skew_here_ = false; ///< at a point of those set since begin()
  bool                    has_skew_  = false; ///< at any point
};

/// Stiffness of the phase by derivatives, dA Gc/(2 l0) (c1 A^ab N,a N,b + c2 lap N lap N).
inline std::array<DerivativePack, n_derivatives> phase_stiffness(const ReferenceQuadraturePoint &reference, double c1,
                                                                 double c2)
{
  const auto                               &A   = reference.contravariant;
  const DerivativePack                      lap = {-reference.laplace_1, -reference.laplace_2, A[0], A[1], 2. * A[2]};
  std::array<DerivativePack, n_derivatives> rows;
  for (int r = 0; r < n_derivatives; ++r)
    rows[r] = c2 * lap[r] * lap;
  rows[0] += DerivativePack{c1 * A[0], c1 * A[2]};
  rows[1] += DerivativePack{c1 * A[2], c1 * A[1]};
  return rows;
}

} // namespace internal

template <class Model>
void element_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                   const double *history, ElementVector<Model> &force)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  internal::ForceSum<Model>                 sum;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto p     = evaluate_point(model, data, interpolation.at(s, q), history[q], q);
      const auto total = data.geometry.reference[q].dA * degraded_stress(p.response, model.degradation.value(p.phi));
      internal::add_point_force(model, data, s, p, total, q, sum);
    }
  sum.store(force);
}

template <class Model>
void element_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                     const double *history, double mass_weight, PhaseTangent phase_tangent, ElementVector<Model> &force,
                     ElementMatrix<Model> &matrix)
{
  using Tables = internal::TangentTables<Model>;
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  internal::ForceSum<Model>                 sum;
  Tables                                    tables(data.geometry);
  const double                              l0 = model.length_scale;

  for (int first_point = 0; first_point < s.n_points; first_point += Tables::n_points)
    {
      tables.begin(s, first_point);
      for (int k = 0; k < Tables::n_points; ++k)
        {
          const int    q       = first_point + k;
          const auto   p       = evaluate_point(model, data, interpolation.at(s, q), history[q], q);
          const double dA      = data.geometry.reference[q].dA;
          const double Gc      = data.toughness[q];
          const double g       = model.degradation.value(p.phi);
          const double g1      = model.degradation.first(p.phi);
          const auto   total   = dA * degraded_stress(p.response, g);
          const bool   loading = model.irreversibility.is_loading(history[q], p.response.energy_active);
          internal::add_point_force(model, data, s, p, total, q, sum);

          const double stiffness = Gc / (2. * l0) * dA;
          const double kappa     = dA * (phase_tangent == PhaseTangent::consistent
                                             ? branch::stiffness(model.degradation, p.driving, p.phi, Gc, l0)
                                             : branch::switched_stiffness(model.degradation, p.driving, p.phi, Gc, l0));
          tables.set(k, p.frame, dA * degraded_tangent(p.response, g), total,
                     internal::phase_stiffness(data.geometry.reference[q], stiffness * model.crack_density.c1(l0),
                                               stiffness * model.crack_density.c2(l0)),
                     kappa, mass_weight * model.mass * dA,
                     internal::point_slope(p.frame, dA * g1 * p.response.stress_active),
                     internal::point_slope(p.frame, (loading ? dA * g1 : 0.) * p.response.driving));
        }
      tables.multiply();
    }
  sum.store(force);
  tables.store(matrix);
}

} // namespace sherd
