#pragma once

#include <array>

#include <sherd/forms/brittle_shell.h>
#include <sherd/forms/element_arrays.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/kinematics/surface_frame.h>

namespace sherd
{

namespace internal
{

/// All fields of one point side by side: displacements, then the phase. One vector register.
typedef double FieldPack __attribute__((vector_size(32)));

template <int spacedim>
inline Point<spacedim> point_of(const FieldPack &pack)
{
  Point<spacedim> point;
  for (int d = 0; d < spacedim; ++d)
    point[d] = pack[d];
  return point;
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
  std::array<double, n_q>                          stiffness; ///< factor of the moduli
};

/// @throws InvalidParameter   degenerate geometry, a toughness or stiffness that is not positive and finite
template <class Model>
ElementData<Model> element_data(const Model &model, const Surface<Model::degree, Model::spacedim> &surface, int element)
{
  ElementData<Model> data;
  data.geometry = element_geometry(surface, element);
  for (int q = 0; q < data.n_q; ++q)
    {
      data.reference[q] =
          internal::reference_point(std::integral_constant<int, Model::spacedim>(), data.geometry.reference[q]);
      const auto position = data.geometry.position(q);
      data.toughness[q]   = model.toughness(position);
      data.stiffness[q]   = model.stiffness(position);
    }
  return data;
}

/// Displacements and phase with their derivatives at one point, and the acceleration.
template <int spacedim>
struct PointFields
{
  internal::FieldPack value, d1, d2, d11, d22, d12; ///< (x, phi) and derivatives by the coordinates of the element
  internal::FieldPack rate;                         ///< (a, 0)

  double phi() const { return value[spacedim]; }
};

/// The fields of an element, arranged so that all of them are interpolated together.
template <class Model>
class FieldInterpolation
{
public:
  static constexpr int n_b      = ElementFields<Model>::n_b;
  static constexpr int spacedim = Model::spacedim;

  explicit FieldInterpolation(const ElementFields<Model> &fields)
  {
    for (int b = 0; b < n_b; ++b)
      {
        values_[b] = rates_[b] = internal::FieldPack{};
        for (int d = 0; d < spacedim; ++d)
          {
            values_[b][d] = fields.position[d][b];
            rates_[b][d]  = fields.acceleration[d][b];
          }
        values_[b][spacedim] = fields.phase[b];
      }
  }

  /// Fields at quadrature point @p q.
  PointFields<spacedim> at(const ShapeValues<Model::degree> &s, int q) const
  {
    PointFields<spacedim> p{};
    for (int b = 0; b < n_b; ++b)
      {
        p.value += s.value[q][b] * values_[b];
        p.d1 += s.d1[q][b] * values_[b];
        p.d2 += s.d2[q][b] * values_[b];
        p.d11 += s.d11[q][b] * values_[b];
        p.d22 += s.d22[q][b] * values_[b];
        p.d12 += s.d12[q][b] * values_[b];
        p.rate += s.value[q][b] * rates_[b];
      }
    return p;
  }

private:
  internal::FieldPack values_[n_b], rates_[n_b];
};

/// Deformed surface at a point.
template <int spacedim>
SurfaceFrame<spacedim> surface_frame(const PointFields<spacedim> &p)
{
  using internal::point_of;
  if constexpr (spacedim == 2)
    return {point_of<2>(p.d1), point_of<2>(p.d2)};
  else
    return {point_of<3>(p.d1), point_of<3>(p.d2), point_of<3>(p.d11), point_of<3>(p.d22), point_of<3>(p.d12)};
}

/// The phase and what acts on it at one quadrature point.
struct PhasePoint
{
  double phi, phi_1, phi_2, laplacian;
  double driving;    ///< H, trial value
  double resistance; ///< against healing, force on the phase by area [force/length]
};

/// Fields and responses at one quadrature point.
template <class Model>
struct PointState : PhasePoint
{
  SurfaceFrame<Model::spacedim>  frame;
  Point<Model::spacedim>         inertia;  ///< acceleration
  SplitResponse<Model::spacedim> response; ///< with the factor of the moduli there
};

/// The phase at quadrature point @p q from the fields there, where the active energy Psi+ is known. Its Laplacian on
/// the reference surface is A^ab (phi,ab - Gamma^c_ab phi,c). Source: theory A.2.
template <class Model>
PhasePoint evaluate_phase(const Model &model, const ElementData<Model> &data,
                          const PointFields<Model::spacedim> &fields, double accepted_history, double active_energy,
                          int q)
{
  constexpr int dim       = Model::spacedim;
  const auto   &reference = data.geometry.reference[q];
  const auto   &A         = reference.contravariant;
  const double  laplacian = A[0] * fields.d11[dim] + A[1] * fields.d22[dim] + 2. * A[2] * fields.d12[dim] -
                           reference.laplace_1 * fields.d1[dim] - reference.laplace_2 * fields.d2[dim];
  const double resistance =
      data.toughness[q] / model.length_scale * model.irreversibility.resistance(accepted_history, fields.phi());
  return {fields.phi(),
          fields.d1[dim],
          fields.d2[dim],
          laplacian,
          model.irreversibility.trial(accepted_history, active_energy),
          resistance};
}

/// Evaluates quadrature point @p q from the fields there.
template <class Model>
PointState<Model> evaluate_point(const Model &model, const ElementData<Model> &data,
                                 const PointFields<Model::spacedim> &fields, double accepted_history, int q)
{
  const auto        frame = surface_frame(fields);
  PointState<Model> p{{},
                      frame,
                      internal::point_of<Model::spacedim>(fields.rate),
                      data.stiffness[q] * model.split.respond(surface_point(data.reference[q], frame))};
  static_cast<PhasePoint &>(p) = evaluate_phase(model, data, fields, accepted_history, p.response.energy_active, q);
  return p;
}

} // namespace sherd
