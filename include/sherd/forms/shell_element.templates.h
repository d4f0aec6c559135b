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

  const Voigt      tau = degraded_stress(p.response, model.degradation.value(p.phi)).membrane;
  const Point<dim> t1  = dA * (tau[0] * p.a1 + tau[2] * p.a2);
  const Point<dim> t2  = dA * (tau[2] * p.a1 + tau[1] * p.a2);
  for (int d = 0; d < dim; ++d)
    {
      const double inertia = dA * model.mass * p.inertia[d];
      for (int b = 0; b < n_b; ++b)
        force.value[d][b] += s.d1[q][b] * t1[d] + s.d2[q][b] * t2[d] + s.value[q][b] * inertia;
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
  alignas(64) double strain[3 * n_q][pad_u]    = {}; // engineering strain of (11, 22, 12) by displacement
  alignas(64) double stress[3 * n_q][pad_u]    = {}; // dA c strain
  alignas(64) double slope[3 * n_q][pad_b]     = {}; // N,1  N,2  N
  alignas(64) double geometric[3 * n_q][pad_b] = {}; // dA tau^ab N,b and the weighted mass
  alignas(64) double force_u[n_q][pad_u]       = {}; // dA g' tau+^ab N,a a_b: displacement by phase
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
      const Voigt  tau       = dA * degraded_stress(p.response, g).membrane;
      const Voigt4 c         = dA * degraded_tangent(p.response, g).membrane;
      const Voigt  tau_plus  = dA * g1 * p.response.stress_active.membrane;
      const bool   loading   = model.irreversibility.is_loading(history[q], p.response.energy_active);
      const Voigt  tau_drive = loading ? Voigt(dA * g1 * p.response.driving.membrane) : Voigt(Voigt::Zero());

      double(&e)[3 * n_q][pad_u] = strain;
      for (int d = 0; d < dim; ++d)
        for (int b = 0; b < n_b; ++b)
          {
            e[3 * q][d * n_b + b]     = s.d1[q][b] * p.a1[d];
            e[3 * q + 1][d * n_b + b] = s.d2[q][b] * p.a2[d];
            e[3 * q + 2][d * n_b + b] = s.d1[q][b] * p.a2[d] + s.d2[q][b] * p.a1[d];
          }
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < pad_u; ++k)
          stress[3 * q + i][k] = c(i, 0) * e[3 * q][k] + c(i, 1) * e[3 * q + 1][k] + c(i, 2) * e[3 * q + 2][k];
      for (int k = 0; k < pad_u; ++k)
        {
          force_u[q][k] = tau_plus[0] * e[3 * q][k] + tau_plus[1] * e[3 * q + 1][k] + tau_plus[2] * e[3 * q + 2][k];
          driving_u[q][k] =
              tau_drive[0] * e[3 * q][k] + tau_drive[1] * e[3 * q + 1][k] + tau_drive[2] * e[3 * q + 2][k];
        }

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
  add_transposed_product<n_u, pad_u>(3 * n_q, strain[0], pad_u, stress[0], pad_u, K, stride);
  add_transposed_product<n_u, pad_b>(n_q, force_u[0], pad_u, value[0], pad_b, K + n_u, stride);
  add_transposed_product<n_b, pad_u>(n_q, value[0], pad_b, driving_u[0], pad_u, K + n_u * stride, stride);
  add_transposed_product<n_b, pad_b>(4 * n_q, phase_l[0], pad_b, phase_r[0], pad_b, K + n_u * stride + n_u, stride);

  alignas(64) double same[n_b][pad_b] = {}; // what all components of the displacement share
  add_transposed_product<n_b, pad_b>(3 * n_q, slope[0], pad_b, geometric[0], pad_b, same[0], pad_b);
  for (int d = 0; d < dim; ++d)
    for (int a = 0; a < n_b; ++a)
      for (int b = 0; b < n_b; ++b)
        K[(d * n_b + a) * stride + d * n_b + b] += same[a][b];
}

} // namespace sherd
