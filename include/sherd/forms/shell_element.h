#pragma once

#include <array>

#include <sherd/forms/brittle_shell.h>
#include <sherd/forms/element_arrays.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/kinematics/surface_frame.h>

namespace sherd
{

/// Which stiffness the phase has in the tangent.
enum class PhaseTangent
{
  consistent, ///< kappa = g'' H + Gc/(2 l0)
  switched    ///< max(|kappa|, 0.02 Gc/(2 l0)): positive, so that Newton leaves the false branch (theory C.2)
};

namespace internal
{

/// sum_b values_b coefficients[d][b] for each component d.
template <int spacedim, int n_b>
inline Point<spacedim> interpolate(const std::array<double, n_b> &values, const double (&coefficients)[spacedim][n_b])
{
  Point<spacedim> sum;
  for (int d = 0; d < spacedim; ++d)
    {
      double component = 0.;
      for (int b = 0; b < n_b; ++b)
        component += values[b] * coefficients[d][b];
      sum[d] = component;
    }
  return sum;
}

inline ReferencePoint<2> reference_point(std::integral_constant<int, 2>, const ReferenceQuadraturePoint &q)
{
  return ReferencePoint<2>(metric(q.covariant));
}
inline ReferencePoint<3> reference_point(std::integral_constant<int, 3>, const ReferenceQuadraturePoint &q)
{
  return ReferencePoint<3>(metric(q.covariant), q.curvature);
}

} // namespace internal

/// What does not change in time at the quadrature points of one element.
template <class Model>
struct ElementData
{
  static constexpr int n_q = ShapeValues<Model::degree>::n_points;

  ElementGeometry<Model::degree, Model::spacedim>  geometry;
  std::array<ReferencePoint<Model::spacedim>, n_q> reference;
  std::array<double, n_q>                          toughness; ///< Gc [energy/length]
};

/// @throws InvalidParameter   degenerate geometry, a toughness that is not positive and finite
template <class Model>
ElementData<Model> element_data(const Model &model, const Surface<Model::degree, Model::spacedim> &surface, int element)
{
  ElementData<Model> data;
  data.geometry = element_geometry(surface, element);
  for (int q = 0; q < data.n_q; ++q)
    {
      data.reference[q] =
          internal::reference_point(std::integral_constant<int, Model::spacedim>(), data.geometry.reference[q]);
      data.toughness[q] = model.toughness(data.geometry.position(q));
    }
  return data;
}

/// Fields and responses at one quadrature point.
template <class Model>
struct PointState
{
  SurfaceFrame<Model::spacedim>  frame;
  Point<Model::spacedim>         inertia; ///< acceleration
  double                         phi, phi_1, phi_2, laplacian;
  SplitResponse<Model::spacedim> response;
  double                         driving; ///< H, trial value
};

/// Deformed surface at quadrature point @p q. @param position   Bernstein coefficients of x, shape=(spacedim, n_b)
template <int degree, int spacedim>
SurfaceFrame<spacedim> surface_frame(const ShapeValues<degree> &s,
                                     const double (&position)[spacedim][ShapeValues<degree>::n_functions], int q)
{
  constexpr int n_b = ShapeValues<degree>::n_functions;
  const auto    a1  = internal::interpolate<spacedim, n_b>(s.d1[q], position);
  const auto    a2  = internal::interpolate<spacedim, n_b>(s.d2[q], position);
  if constexpr (spacedim == 2)
    return {a1, a2};
  else
    return {a1, a2, internal::interpolate<spacedim, n_b>(s.d11[q], position),
            internal::interpolate<spacedim, n_b>(s.d22[q], position),
            internal::interpolate<spacedim, n_b>(s.d12[q], position)};
}

/// Evaluates one quadrature point. @p laplace holds the Laplacians of the shape functions there, shape=(n_b).
template <class Model>
PointState<Model> evaluate_point(const Model &model, const ElementData<Model> &data,
                                 const ShapeValues<Model::degree> &s, const ElementFields<Model> &fields,
                                 const double *laplace, double accepted_history, int q)
{
  constexpr int     n_b     = ElementFields<Model>::n_b;
  const auto        frame   = surface_frame<Model::degree, Model::spacedim>(s, fields.position, q);
  const auto        inertia = internal::interpolate<Model::spacedim, n_b>(s.value[q], fields.acceleration);
  PointState<Model> p{frame, inertia, 0., 0., 0., 0., model.split.respond(surface_point(data.reference[q], frame)), 0.};
  for (int b = 0; b < n_b; ++b)
    {
      p.phi += s.value[q][b] * fields.phase[b];
      p.phi_1 += s.d1[q][b] * fields.phase[b];
      p.phi_2 += s.d2[q][b] * fields.phase[b];
      p.laplacian += laplace[b] * fields.phase[b];
    }
  p.driving = model.irreversibility.trial(accepted_history, p.response.energy_active);
  return p;
}

/// Laplacian of every shape function on the reference surface, A^ab (S,ab - Gamma^c_ab S,c). Source: theory A.2.
template <int degree>
std::array<double, ShapeValues<degree>::n_functions> shape_laplacians(const ShapeValues<degree>      &s,
                                                                      const ReferenceQuadraturePoint &reference, int q)
{
  std::array<double, ShapeValues<degree>::n_functions> laplace;
  const auto                                          &A = reference.contravariant;
  for (int b = 0; b < s.n_functions; ++b)
    laplace[b] = A[0] * s.d11[q][b] + A[1] * s.d22[q][b] + 2. * A[2] * s.d12[q][b] - reference.laplace_1 * s.d1[q][b] -
                 reference.laplace_2 * s.d2[q][b];
  return laplace;
}

/// Internal and inertial force of one element and the phase residual,
///
///   f_A    = int rho N_A a + tau^ab N_A,a a_b + M_0^ab N_A;ab n dA,
///   fphi_A = int g' H N_A + Gc/(2 l0) [(phi - 1) N_A + c1 A^ab N_A,a phi,b + c2 lap N_A lap phi] dA.
///
/// @param history   accepted H at the quadrature points, shape=(n_q)
/// @param force     overwritten
///
/// Source: theory E.1; paper Eqs. (5), (12).
template <class Model>
void element_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                   const double *history, ElementVector<Model> &force);

/// The same, and its tangent with respect to (x, phi); mass_weight rho N_A N_B is added to the displacement block
/// (theory E.2, F.2). The phase row has the derivative of H where it loads.
///
/// @param matrix   overwritten; d force[i][A] / d field j of B at row i*n_b + A, column j*n_b + B
///
/// Source: theory E.1, E.2.
template <class Model>
void element_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                     const double *history, double mass_weight, PhaseTangent phase_tangent, ElementVector<Model> &force,
                     ElementMatrix<Model> &matrix);

} // namespace sherd

#include <sherd/forms/shell_element.templates.h>
