#pragma once

#include <sherd/forms/point_state.h>

namespace sherd
{

/// Energies of a body or of a part of it, [energy].
struct Energies
{
  double active         = 0.; ///< int g Psi+ dA
  double passive        = 0.; ///< int Psi- dA
  double kinetic        = 0.; ///< int rho v.v / 2 dA
  double fracture       = 0.; ///< int Psi_frac dA
  double constraint     = 0.; ///< of penalties and multipliers on interfaces and edges, theory G
  double bending        = 0.; ///< part of the elastic energy that the change of curvature adds; 0 in the plane
  double diffuse_length = 0.; ///< int Psi_frac / Gc dA [length]

  double elastic() const { return active + passive; }
  double membrane() const { return elastic() - bending; } ///< elastic energy of the same metric, k_ab = 0

  Energies &operator+=(const Energies &other)
  {
    active += other.active;
    passive += other.passive;
    kinetic += other.kinetic;
    fracture += other.fracture;
    constraint += other.constraint;
    bending += other.bending;
    diffuse_length += other.diffuse_length;
    return *this;
  }
};

namespace internal
{

/// A point of the same metric without change of curvature.
inline SurfacePoint<3> without_bending(const SurfacePoint<3> &point, const ReferencePoint<3> &reference)
{
  return {reference, point.metric, reference.curvature};
}

/// g Psi+ + Psi-
template <int spacedim>
inline double degraded_energy(const SplitResponse<spacedim> &response, double g)
{
  return g * response.energy_active + response.energy_passive;
}

} // namespace internal

/// int_e Psi dA / int_e dA of an element with Psi = g Psi+ + Psi- (elastic) and Psi_frac (fracture) [energy/area].
struct ElementDensities
{
  double elastic, fracture;
};

/// Energies of one element. Membrane energy is that of the point with k_ab = 0, bending energy the rest: exact where
/// the law separates them; where layers crack one by one, the way in which the degraded energy is shared. The fields
/// hold the end of the step, with the velocity in place of the acceleration.
///
/// Source: theory D (energy balance), J.7 (vi).
template <class Model>
Energies element_energies(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  Energies                                  sum;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto  &reference = data.geometry.reference[q];
      const auto   p         = evaluate_point(model, data, interpolation.at(s, q), 0., q);
      const auto  &A         = reference.contravariant;
      const double gradient  = A[0] * p.phi_1 * p.phi_1 + A[1] * p.phi_2 * p.phi_2 + 2. * A[2] * p.phi_1 * p.phi_2;
      sum.active += reference.dA * model.degradation.value(p.phi) * p.response.energy_active;
      sum.passive += reference.dA * p.response.energy_passive;
      if constexpr (Model::spacedim == 3)
        {
          const double g    = model.degradation.value(p.phi);
          const auto   flat = model.split.respond(
                internal::without_bending(surface_point(data.reference[q], p.frame), data.reference[q]));
          sum.bending += reference.dA * (internal::degraded_energy(p.response, g) -
                                         data.stiffness[q] * internal::degraded_energy(flat, g));
        }
      sum.kinetic += reference.dA * .5 * model.mass * p.inertia.squaredNorm();
      const double crack =
          crack_energy(model.crack_density, data.toughness[q], model.length_scale, p.phi, gradient, p.laplacian);
      sum.fracture += reference.dA * crack;
      sum.diffuse_length += reference.dA * crack / data.toughness[q];
    }
  return sum;
}

/// Work that the history withholds in a step, int g'(phi) (H - Psi+) dphi dA over one element [energy]: not positive
/// while the phase falls.
///
/// @param phase, previous_phase   phi at the end of the step and at its beginning, shape=(n_b)
/// @param history                 H of the step, shape=(n_q)
/// @param energy                  Psi+ at the level of the balance, where it belongs to the same deformation as H:
///                                Psi+ = H where the point loads; shape=(n_q)
///
/// Source: theory D (energy balance).
template <class Model>
double element_withheld_work(const Model &model, const ElementData<Model> &data, const double *phase,
                             const double *previous_phase, const double *history, const double *energy)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s   = data.geometry.shapes(storage);
  double                                    sum = 0.;
  for (int q = 0; q < s.n_points; ++q)
    {
      double now = 0., before = 0.;
      for (int b = 0; b < s.n_functions; ++b)
        {
          now += s.value[q][b] * phase[b];
          before += s.value[q][b] * previous_phase[b];
        }
      sum += data.geometry.reference[q].dA * model.degradation.first(.5 * (before + now)) *
             (model.irreversibility.trial(history[q], energy[q]) - energy[q]) * (now - before);
    }
  return sum;
}

/// Work of the inertial force of a step, int rho a . dx dA over one element [energy].
/// @param fields   the displacement of the step in place of the position, the acceleration
template <class Model>
double element_inertial_work(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s   = data.geometry.shapes(storage);
  double                                    sum = 0.;
  for (int q = 0; q < s.n_points; ++q)
    for (int d = 0; d < Model::spacedim; ++d)
      {
        double dx = 0., a = 0.;
        for (int b = 0; b < s.n_functions; ++b)
          {
            dx += s.value[q][b] * fields.position[d][b];
            a += s.value[q][b] * fields.acceleration[d][b];
          }
        sum += data.geometry.reference[q].dA * model.mass * dx * a;
      }
  return sum;
}

/// Active energy Psi+ at the quadrature points of one element, shape=(n_q), [energy/area].
template <class Model>
std::array<double, ElementData<Model>::n_q> element_active_energy(const Model &model, const ElementData<Model> &data,
                                                                  const ElementFields<Model> &fields)
{
  std::optional<ShapeValues<Model::degree>>   storage;
  const auto                                 &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>             interpolation(fields);
  std::array<double, ElementData<Model>::n_q> energy;
  for (int q = 0; q < s.n_points; ++q)
    energy[q] = evaluate_point(model, data, interpolation.at(s, q), 0., q).response.energy_active;
  return energy;
}

/// Phase at the quadrature points of one element, shape=(n_q).
template <class Model>
std::array<double, ElementData<Model>::n_q> element_phase(const ElementData<Model>   &data,
                                                          const ElementFields<Model> &fields)
{
  std::optional<ShapeValues<Model::degree>>   storage;
  const auto                                 &s = data.geometry.shapes(storage);
  std::array<double, ElementData<Model>::n_q> phase{};
  for (int q = 0; q < s.n_points; ++q)
    for (int b = 0; b < s.n_functions; ++b)
      phase[q] += s.value[q][b] * fields.phase[b];
  return phase;
}

} // namespace sherd
