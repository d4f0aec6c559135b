#pragma once

#include <sherd/forms/point_state.h>

namespace sherd
{

/// Energies of a body or of a part of it, [energy].
struct Energies
{
  double active     = 0.; ///< int g Psi+ dA
  double passive    = 0.; ///< int Psi- dA
  double kinetic    = 0.; ///< int rho v.v / 2 dA
  double fracture   = 0.; ///< int Psi_frac dA
  double constraint = 0.; ///< of the continuity across interfaces, theory G

  double elastic() const { return active + passive; }

  Energies &operator+=(const Energies &other)
  {
    active += other.active;
    passive += other.passive;
    kinetic += other.kinetic;
    fracture += other.fracture;
    constraint += other.constraint;
    return *this;
  }
};

/// Energies of one element. The fields hold the end of the step, with the velocity in place of the acceleration.
///
/// Source: theory J.7 (vi).
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
      sum.kinetic += reference.dA * .5 * model.mass * p.inertia.squaredNorm();
      sum.fracture += reference.dA * crack_energy(model.crack_density, data.toughness[q], model.length_scale, p.phi,
                                                  gradient, p.laplacian);
    }
  return sum;
}

/// Work that the history withholds in a step, int g'(phi) (H - Psi+) dphi dA over one element [energy]: not positive
/// while the phase falls.
///
/// @param fields          at the level of the balance, where H and Psi+ belong to the same deformation: Psi+ = H where
///                        the point loads
/// @param previous_phase  phi at the beginning of the step, shape=(n_b)
/// @param history         H of the step, shape=(n_q)
///
/// Source: theory D (energy balance).
template <class Model>
double element_withheld_work(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                             const double *previous_phase, const double *history)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  double                                    sum = 0.;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto p      = evaluate_point(model, data, interpolation.at(s, q), 0., q);
      double     before = 0.;
      for (int b = 0; b < s.n_functions; ++b)
        before += s.value[q][b] * previous_phase[b];
      sum += data.geometry.reference[q].dA * model.degradation.first(.5 * (before + p.phi)) *
             (model.irreversibility.trial(history[q], p.response.energy_active) - p.response.energy_active) *
             (p.phi - before);
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
