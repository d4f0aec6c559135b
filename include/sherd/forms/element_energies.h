#pragma once

#include <sherd/forms/shell_element.h>

namespace sherd
{

/// Energies of a body or of a part of it, [energy].
struct Energies
{
  double active    = 0.; ///< int g Psi+ dA
  double passive   = 0.; ///< int Psi- dA
  double kinetic   = 0.; ///< int rho v.v / 2 dA
  double fracture  = 0.; ///< int Psi_frac dA
  double withheld  = 0.; ///< int g'(phi) (H - Psi+) dphi dA over the step, the work that the history withholds

  double elastic() const { return active + passive; }

  Energies &operator+=(const Energies &other)
  {
    active += other.active;
    passive += other.passive;
    kinetic += other.kinetic;
    fracture += other.fracture;
    withheld += other.withheld;
    return *this;
  }
};

/// Energies of one element. The fields hold the end of the step, with the velocity in place of the acceleration;
/// @p previous_phase is phi at its beginning, shape=(n_b), and @p history the H of the step, shape=(n_q).
///
/// Source: theory D (energy balance), J.7 (vi).
template <class Model>
Energies element_energies(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                          const double *previous_phase, const double *history)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s  = data.geometry.shapes(storage);
  const double                              l0 = model.length_scale;
  Energies                                  sum;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto  &reference = data.geometry.reference[q];
      const auto   laplace   = shape_laplacians(s, reference, q);
      const auto   p         = evaluate_point(model, data, s, fields, laplace.data(), history[q], q);
      const double Gc        = data.toughness[q];
      const auto  &A         = reference.contravariant;
      double       before    = 0.;
      for (int b = 0; b < s.n_functions; ++b)
        before += s.value[q][b] * previous_phase[b];

      const double gradient = A[0] * p.phi_1 * p.phi_1 + A[1] * p.phi_2 * p.phi_2 + 2. * A[2] * p.phi_1 * p.phi_2;
      sum.active += reference.dA * model.degradation.value(p.phi) * p.response.energy_active;
      sum.passive += reference.dA * p.response.energy_passive;
      sum.kinetic += reference.dA * .5 * model.mass * p.inertia.squaredNorm();
      sum.fracture += reference.dA * crack_energy(model.crack_density, Gc, l0, p.phi, gradient, p.laplacian);
      sum.withheld += reference.dA * model.degradation.first(.5 * (before + p.phi)) *
                      (history[q] - p.response.energy_active) * (p.phi - before);
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
  std::array<double, ElementData<Model>::n_q> energy;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto laplace = shape_laplacians(s, data.geometry.reference[q], q);
      energy[q]          = evaluate_point(model, data, s, fields, laplace.data(), 0., q).response.energy_active;
    }
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
