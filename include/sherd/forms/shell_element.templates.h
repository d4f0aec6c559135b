#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/forms/shell_element.h>
#include <sherd/fracture/branch.h>

namespace sherd
{

namespace internal
{

/// Adds the contribution of one quadrature point to the element force.
template <class Model>
void add_point_force(const Model &model, const ElementData<Model> &data, const ShapeValues<Model::degree> &s,
                     const PointState<Model> &p, const double *laplace, int q, ElementVector<Model> &force)
{
  constexpr int n_b       = ElementVector<Model>::n_b;
  constexpr int dim       = Model::spacedim;
  const auto   &reference = data.geometry.reference[q];
  const double  dA        = reference.dA;
  const double  l0        = model.length_scale;
  const double  stiffness = data.toughness[q] / (2. * l0) * dA;

  const auto       stress = degraded_stress(p.response, model.degradation.value(p.phi));
  const Voigt     &tau    = stress.membrane;
  const Point<dim> t1     = dA * (tau[0] * p.frame.a1 + tau[2] * p.frame.a2);
  const Point<dim> t2     = dA * (tau[2] * p.frame.a1 + tau[1] * p.frame.a2);
  for (int d = 0; d < dim; ++d)
    {
      const double inertia = dA * model.mass * p.inertia[d];
      for (int b = 0; b < n_b; ++b)
        force.value[d][b] += s.d1[q][b] * t1[d] + s.d2[q][b] * t2[d] + s.value[q][b] * inertia;
    }
  if constexpr (dim == 3)
    {
      // M^ab N;ab = M^ab N,ab - (M^ab Gamma^c_ab) N,c
      const Voigt  M  = dA * stress.moment;
      const double m1 = contract(M, p.frame.christoffel_1), m2 = contract(M, p.frame.christoffel_2);
      for (int b = 0; b < n_b; ++b)
        {
          const double moment =
              M[0] * s.d11[q][b] + M[1] * s.d22[q][b] + 2. * M[2] * s.d12[q][b] - m1 * s.d1[q][b] - m2 * s.d2[q][b];
          for (int d = 0; d < dim; ++d)
            force.value[d][b] += moment * p.frame.normal[d];
        }
    }

  const auto  &A      = reference.contravariant;
  const double source = model.degradation.first(p.phi) * p.driving * dA + stiffness * (p.phi - 1.);
  const double c1     = stiffness * model.crack_density.c1(l0);
  const double flux_1 = c1 * (A[0] * p.phi_1 + A[2] * p.phi_2);
  const double flux_2 = c1 * (A[2] * p.phi_1 + A[1] * p.phi_2);
  const double bend   = stiffness * model.crack_density.c2(l0) * p.laplacian;
  for (int b = 0; b < n_b; ++b)
    force.value[dim][b] += source * s.value[q][b] + flux_1 * s.d1[q][b] + flux_2 * s.d2[q][b] + bend * laplace[b];
}

/// Strains that a model has: membrane (11, 22, 12) and, in space, change of curvature.
template <int spacedim>
inline constexpr int n_strains = spacedim == 2 ? 3 : 6;

template <int spacedim>
using StrainVector = Eigen::Matrix<double, n_strains<spacedim>, 1>;

template <int spacedim>
using StrainMatrix = Eigen::Matrix<double, n_strains<spacedim>, n_strains<spacedim>>;

inline StrainVector<2> stack(const Stress<2> &stress)
{
  return stress.membrane;
}
inline StrainVector<3> stack(const Stress<3> &stress)
{
  StrainVector<3> all;
  all << stress.membrane, stress.moment;
  return all;
}

inline StrainMatrix<2> stack(const Tangent<2> &tangent)
{
  return tangent.membrane;
}
inline StrainMatrix<3> stack(const Tangent<3> &tangent)
{
  StrainMatrix<3> all;
  all << tangent.membrane, tangent.coupling, tangent.moment_coupling, tangent.bending;
  return all;
}

/// N;ab = N,ab - Gamma^c_ab N,c of the deformed surface, components (11, 22, 12).
template <int degree>
inline Voigt covariant_second_derivative(const ShapeValues<degree> &s, const SurfaceFrame<3> &frame, int q, int b)
{
  return Voigt(s.d11[q][b], s.d22[q][b], s.d12[q][b]) - frame.christoffel_1 * s.d1[q][b] -
         frame.christoffel_2 * s.d2[q][b];
}

/// Strains by displacement at one quadrature point, by rows of width @p pad: engineering strains of (11, 22, 12), then
/// in space b_11, b_22 and 2 b_12. Column d*n_b + b is component d of the displacement of shape function b.
template <int degree, int spacedim, int pad>
inline void strain_rows(const ShapeValues<degree> &s, const SurfaceFrame<spacedim> &frame, int q, double (*rows)[pad])
{
  constexpr int n_b = ShapeValues<degree>::n_functions;
  for (int d = 0; d < spacedim; ++d)
    for (int b = 0; b < n_b; ++b)
      {
        rows[0][d * n_b + b] = s.d1[q][b] * frame.a1[d];
        rows[1][d * n_b + b] = s.d2[q][b] * frame.a2[d];
        rows[2][d * n_b + b] = s.d1[q][b] * frame.a2[d] + s.d2[q][b] * frame.a1[d];
      }
  if constexpr (spacedim == 3)
    for (int b = 0; b < n_b; ++b)
      {
        const Voigt second = covariant_second_derivative(s, frame, q, b);
        for (int d = 0; d < spacedim; ++d)
          {
            rows[3][d * n_b + b] = second[0] * frame.normal[d];
            rows[4][d * n_b + b] = second[1] * frame.normal[d];
            rows[5][d * n_b + b] = 2. * second[2] * frame.normal[d];
          }
      }
}

/// Rows of the geometric part of the bending tangent (theory E.2), left and weighted right: with p^c = N,c n and
/// u^c = M^ab N;ab a^c + 1/2 (b_ab M^ab) a^cd N,d n it is -(p^c u^c + u^c p^c), c = 1, 2.
/// @param M   dA M_0^ab of the damaged surface
template <int degree, int pad>
inline void bending_geometry_rows(const ShapeValues<degree> &s, const SurfaceFrame<3> &frame, const Voigt &M, int q,
                                  double (*left)[pad], double (*right)[pad])
{
  constexpr int n_b  = ShapeValues<degree>::n_functions;
  const double  half = .5 * contract(frame.curvature, M);
  const Voigt  &a    = frame.metric.contravariant;
  for (int b = 0; b < n_b; ++b)
    {
      const double n1 = s.d1[q][b], n2 = s.d2[q][b];
      const double moment = contract(M, covariant_second_derivative(s, frame, q, b));
      const double h1 = half * (a[0] * n1 + a[2] * n2), h2 = half * (a[2] * n1 + a[1] * n2);
      for (int d = 0; d < 3; ++d)
        {
          const int    k  = d * n_b + b;
          const double n  = frame.normal[d];
          const double u1 = moment * frame.dual_1[d] + h1 * n, u2 = moment * frame.dual_2[d] + h2 * n;
          left[0][k]  = n1 * n;
          left[1][k]  = n2 * n;
          left[2][k]  = u1;
          left[3][k]  = u2;
          right[0][k] = -u1;
          right[1][k] = -u2;
          right[2][k] = -n1 * n;
          right[3][k] = -n2 * n;
        }
    }
}

} // namespace internal

template <class Model>
void element_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                   const double *history, ElementVector<Model> &force)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  force                                       = {};
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto laplace = shape_laplacians(s, data.geometry.reference[q], q);
      const auto p       = evaluate_point(model, data, s, fields, laplace.data(), history[q], q);
      internal::add_point_force(model, data, s, p, laplace.data(), q, force);
    }
}

template <class Model>
void element_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                     const double *history, double mass_weight, PhaseTangent phase_tangent, ElementVector<Model> &force,
                     ElementMatrix<Model> &matrix)
{
  constexpr int dim    = Model::spacedim;
  constexpr int n_b    = ElementMatrix<Model>::n_b;
  constexpr int n_q    = ShapeValues<Model::degree>::n_points;
  constexpr int n_u    = dim * n_b;
  constexpr int pad_u  = padded(n_u);
  constexpr int pad_b  = padded(n_b);
  constexpr int stride = ElementMatrix<Model>::stride;

  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s  = data.geometry.shapes(storage);
  const double                              l0 = model.length_scale;

  // Each integral is a product of tables that stack the quadrature points: left rows times weighted right rows.
  constexpr int      n_e                       = internal::n_strains<dim>;
  constexpr int      n_r                       = dim == 2 ? n_e : n_e + 4;
  alignas(64) double strain[n_r * n_q][pad_u]  = {}; // strains by displacement; geometric rows of bending
  alignas(64) double stress[n_r * n_q][pad_u]  = {}; // dA tangent strain; the same, weighted
  alignas(64) double slope[3 * n_q][pad_b]     = {}; // N,1  N,2  N
  alignas(64) double geometric[3 * n_q][pad_b] = {}; // dA tau^ab N,b and the weighted mass
  alignas(64) double force_u[n_q][pad_u]       = {}; // dA g' (tau+, M+) strain: displacement by phase
  alignas(64) double driving_u[n_q][pad_u]     = {}; // the same from the derivative of H: phase by displacement
  alignas(64) double value[n_q][pad_b]         = {}; // N
  alignas(64) double phase_l[4 * n_q][pad_b]   = {}; // N  N,1  N,2  lap N
  alignas(64) double phase_r[4 * n_q][pad_b]   = {}; // the same, weighted

  force  = {};
  matrix = {};
  for (int q = 0; q < n_q; ++q)
    {
      const auto laplace = shape_laplacians(s, data.geometry.reference[q], q);
      const auto p       = evaluate_point(model, data, s, fields, laplace.data(), history[q], q);
      internal::add_point_force(model, data, s, p, laplace.data(), q, force);

      const auto  &reference = data.geometry.reference[q];
      const double dA        = reference.dA;
      const double g         = model.degradation.value(p.phi);
      const double g1        = model.degradation.first(p.phi);
      const auto   total     = dA * degraded_stress(p.response, g);
      const Voigt &tau       = total.membrane;
      const auto   D         = internal::stack(dA * degraded_tangent(p.response, g));
      const auto   active    = internal::stack(dA * g1 * p.response.stress_active);
      const bool   loading   = model.irreversibility.is_loading(history[q], p.response.energy_active);
      const auto   driving   = internal::stack((loading ? dA * g1 : 0.) * p.response.driving);

      double(*const e)[pad_u] = strain + n_r * q;
      double(*const f)[pad_u] = stress + n_r * q;
      internal::strain_rows<Model::degree, dim>(s, p.frame, q, e);
      for (int i = 0; i < n_e; ++i)
        for (int j = 0; j < n_e; ++j)
          for (int k = 0; k < pad_u; ++k)
            f[i][k] += D(i, j) * e[j][k];
      for (int i = 0; i < n_e; ++i)
        for (int k = 0; k < pad_u; ++k)
          {
            force_u[q][k] += active[i] * e[i][k];
            driving_u[q][k] += driving[i] * e[i][k];
          }
      if constexpr (dim == 3)
        internal::bending_geometry_rows<Model::degree>(s, p.frame, total.moment, q, e + n_e, f + n_e);

      const double stiffness = data.toughness[q] / (2. * l0) * dA;
      const double Gc        = data.toughness[q];
      const double kappa     = dA * (phase_tangent == PhaseTangent::consistent
                                         ? branch::stiffness(model.degradation, p.driving, p.phi, Gc, l0)
                                         : branch::switched_stiffness(model.degradation, p.driving, p.phi, Gc, l0));
      const double c1        = stiffness * model.crack_density.c1(l0);
      const double c2        = stiffness * model.crack_density.c2(l0);
      const auto  &A         = reference.contravariant;
      const double m         = mass_weight * model.mass * dA;
      for (int b = 0; b < n_b; ++b)
        {
          const double n = s.value[q][b], n1 = s.d1[q][b], n2 = s.d2[q][b];
          value[q][b]             = n;
          slope[3 * q][b]         = n1;
          slope[3 * q + 1][b]     = n2;
          slope[3 * q + 2][b]     = n;
          geometric[3 * q][b]     = tau[0] * n1 + tau[2] * n2;
          geometric[3 * q + 1][b] = tau[2] * n1 + tau[1] * n2;
          geometric[3 * q + 2][b] = m * n;
          phase_l[4 * q][b]       = n;
          phase_l[4 * q + 1][b]   = n1;
          phase_l[4 * q + 2][b]   = n2;
          phase_l[4 * q + 3][b]   = laplace[b];
          phase_r[4 * q][b]       = kappa * n;
          phase_r[4 * q + 1][b]   = c1 * (A[0] * n1 + A[2] * n2);
          phase_r[4 * q + 2][b]   = c1 * (A[2] * n1 + A[1] * n2);
          phase_r[4 * q + 3][b]   = c2 * laplace[b];
        }
    }

  double *const K = matrix.value[0];
  add_transposed_product<pad_u>(n_u, n_r * n_q, strain[0], pad_u, stress[0], pad_u, K, stride);
  add_transposed_product<pad_b>(n_u, n_q, force_u[0], pad_u, value[0], pad_b, K + n_u, stride);
  add_transposed_product<pad_u>(n_b, n_q, value[0], pad_b, driving_u[0], pad_u, K + n_u * stride, stride);
  add_transposed_product<pad_b>(n_b, 4 * n_q, phase_l[0], pad_b, phase_r[0], pad_b, K + n_u * stride + n_u, stride);

  alignas(64) double same[n_b][pad_b] = {}; // what all components of the displacement share
  add_transposed_product<pad_b>(n_b, 3 * n_q, slope[0], pad_b, geometric[0], pad_b, same[0], pad_b);
  for (int d = 0; d < dim; ++d)
    for (int a = 0; a < n_b; ++a)
      for (int b = 0; b < n_b; ++b)
        K[(d * n_b + a) * stride + d * n_b + b] += same[a][b];
}

} // namespace sherd
