#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include <Eigen/Geometry>

#include <sherd/forms/loads.h>
#include <sherd/forms/point_state.h>

namespace sherd
{

/// Pressure p0 [force/area] at the quadrature points of one element, shape=(n_q), positive along +n. What acts is
///
///   p = constant + by_phase max(phi, 0).
template <class Model>
struct ElementPressure
{
  static constexpr int n_q = ShapeValues<Model::degree>::n_points;

  std::array<double, n_q> constant; ///< sum of the pressures with PressureRelease::none
  std::array<double, n_q> by_phase; ///< sum of those with PressureRelease::by_phase
};

/// All pressures of @p loads at @p time on one element.
template <class Model>
ElementPressure<Model> element_pressure(const ElementData<Model> &data, const Loads<3> &loads, double time)
{
  ElementPressure<Model> pressure{};
  for (int q = 0; q < pressure.n_q && !loads.pressures().empty(); ++q)
    {
      const auto X = data.geometry.position(q);
      for (const auto &load : loads.pressures())
        (load.release == PressureRelease::none ? pressure.constant : pressure.by_phase)[q] += load.pressure(X, time);
    }
  return pressure;
}

namespace internal
{

/// What a pressure needs at one quadrature point.
struct PressurePoint
{
  Point<3> a1, a2;    ///< tangents
  double   pressure;  ///< p times the quadrature weight
  double   phi_slope; ///< dp/dphi times the quadrature weight
};

template <class Model>
PressurePoint pressure_point(const PointFields<3> &fields, const ElementPressure<Model> &pressure, int q)
{
  const double phi    = fields.phi();
  const double weight = BernsteinTable<Model::degree>::get().weights[q];
  return {point_of<3>(fields.d1), point_of<3>(fields.d2),
          weight * (pressure.constant[q] + pressure.by_phase[q] * std::max(phi, 0.)),
          phi > 0. ? weight * pressure.by_phase[q] : 0.};
}

} // namespace internal

/// Adds the force of a follower pressure to the external force,
///
///   f_A = int p N_A (a_1 x a_2) d^2xi,   p = p(phi),
///
/// per present area and along the present normal n = a_1 x a_2 / |a_1 x a_2|. The pressure does not drive the phase:
/// its row gets nothing.
///
/// Source: theory E.3.
template <class Model>
void add_pressure(const ElementData<Model> &data, const ElementFields<Model> &fields,
                  const ElementPressure<Model> &pressure, ElementVector<Model> &external)
{
  static_assert(Model::spacedim == 3, "a pressure acts on shells in space");
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto     p     = internal::pressure_point(interpolation.at(s, q), pressure, q);
      const Point<3> force = p.pressure * p.a1.cross(p.a2);
      for (int d = 0; d < 3; ++d)
        for (int b = 0; b < s.n_functions; ++b)
          external.value[d][b] += s.value[q][b] * force[d];
    }
}

/// Adds -d f / d(x, phi) of add_pressure, which is what the tangent of (internal - external) gets:
///
///   -d f_A / d x_B   = int p N_A [N_B,1 a_2 - N_B,2 a_1]_x d^2xi,   [v]_x w = v x w,
///   -d f_A / d phi_B = -int p'(phi) N_A (a_1 x a_2) N_B d^2xi,      p' = 0 for phi <= 0.
///
/// The displacement block is the theory's p N_A (a^a (x) n - n (x) a^a) N_B,a da, written without the normal; it is not
/// symmetric, and the phase row is empty.
///
/// @param stiffness   row i*n_b + A, column j*n_b + B, as in element_tangent; has the displacement
///
/// Source: theory E.3.
template <class Model, Unknowns part>
void add_pressure_tangent(const ElementData<Model> &data, const ElementFields<Model> &fields,
                          const ElementPressure<Model> &pressure, ElementMatrix<Model, part> &stiffness)
{
  static_assert(Model::spacedim == 3, "a pressure acts on shells in space");
  static_assert(has_displacement(part), "a pressure does not drive the phase");
  constexpr int n_b    = ElementMatrix<Model>::n_b;
  constexpr int n_q    = ShapeValues<Model::degree>::n_points;
  constexpr int n_u    = 3 * n_b;
  constexpr int pad_u  = padded(n_u);
  constexpr int pad_b  = padded(n_b);
  constexpr int stride = ElementMatrix<Model, part>::stride;

  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);

  alignas(64) double value[n_q][pad_b] = {}; // N
  alignas(64) double axis[n_q][pad_u]  = {}; // p (N,1 a_2 - N,2 a_1), index order [q][component*n_b + b]
  alignas(64) double slope[n_q][pad_u] = {}; // -p' N (a_1 x a_2), likewise
  for (int q = 0; q < n_q; ++q)
    {
      const auto     p     = internal::pressure_point(interpolation.at(s, q), pressure, q);
      const Point<3> force = -p.phi_slope * p.a1.cross(p.a2);
      for (int b = 0; b < n_b; ++b)
        value[q][b] = s.value[q][b];
      for (int d = 0; d < 3; ++d)
        for (int b = 0; b < n_b; ++b)
          {
            axis[q][d * n_b + b]  = p.pressure * (s.d1[q][b] * p.a2[d] - s.d2[q][b] * p.a1[d]);
            slope[q][d * n_b + b] = s.value[q][b] * force[d];
          }
    }

  alignas(64) double turn[n_b][pad_u] = {}; // int N_A axis_B
  add_product<pad_u>(n_b, n_q, {value[0], 1, pad_b}, axis[0], pad_u, turn[0], pad_u);

  double *const K = stiffness.value[0];
  if constexpr (has_phase(part))
    {
      alignas(64) double couple[n_u][pad_b] = {}; // displacement by phase
      add_product<pad_b>(n_u, n_q, {slope[0], 1, pad_u}, value[0], pad_b, couple[0], pad_b);
      for (int k = 0; k < n_u; ++k)
        for (int b = 0; b < n_b; ++b)
          K[k * stride + n_u + b] += couple[k][b];
    }
  for (int d = 0; d < 3; ++d)
    {
      const int i = (d + 1) % 3, j = (d + 2) % 3; // [v]_x has v_d at (j, i) and -v_d at (i, j)
      for (int a = 0; a < n_b; ++a)
        for (int b = 0; b < n_b; ++b)
          {
            K[(j * n_b + a) * stride + i * n_b + b] += turn[a][d * n_b + b];
            K[(i * n_b + a) * stride + j * n_b + b] -= turn[a][d * n_b + b];
          }
    }
}

} // namespace sherd
