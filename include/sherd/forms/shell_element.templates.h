#pragma once

#include <optional>

#include <sherd/forms/shell_element.h>
#include <sherd/forms/tangent_tables.h>
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
/// @param p       PointState, for the phase alone PhasePoint
/// @param total   stress of the damaged surface times dA; of no account for the phase alone
template <Unknowns part, class Model, class State>
void add_point_force(const Model &model, const ElementData<Model> &data, const ShapeValues<Model::degree> &s,
                     const State &p, const Stress<Model::spacedim> &total, int q, ForceSum<Model> &force)
{
  constexpr int dim       = Model::spacedim;
  const auto   &reference = data.geometry.reference[q];
  const double  dA        = reference.dA;

  FieldPack n{}, n1{}, n2{}, n11{}, n22{}, n12{};
  if constexpr (has_phase(part))
    {
      const double l0        = model.length_scale;
      const double stiffness = data.toughness[q] / (2. * l0) * dA;
      const auto  &A         = reference.contravariant;
      const double c1        = stiffness * model.crack_density.c1(l0);
      const double bend      = stiffness * model.crack_density.c2(l0) * p.laplacian;

      n[dim] = (model.degradation.first(p.phi) * p.driving + p.resistance) * dA +
               stiffness * (.5 * model.crack_density.local_first(p.phi));
      n1[dim]  = c1 * (A[0] * p.phi_1 + A[2] * p.phi_2) - bend * reference.laplace_1;
      n2[dim]  = c1 * (A[2] * p.phi_1 + A[1] * p.phi_2) - bend * reference.laplace_2;
      n11[dim] = bend * A[0];
      n22[dim] = bend * A[1];
      n12[dim] = 2. * bend * A[2];
    }
  if constexpr (has_displacement(part))
    {
      const Voigt &tau = total.membrane;
      for (int d = 0; d < dim; ++d)
        {
          n[d]  = dA * model.mass * p.inertia[d];
          n1[d] = tau[0] * p.frame.a1[d] + tau[2] * p.frame.a2[d];
          n2[d] = tau[2] * p.frame.a1[d] + tau[1] * p.frame.a2[d];
        }
    }
  if constexpr (dim == 3 && has_displacement(part))
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

/// What N_A N_B has in the phase block: kappa, or what takes its place, and the stiffness of the resistance, times dA.
template <class Model>
double phase_value_stiffness(const Model &model, const ElementData<Model> &data, const PhasePoint &p, double history,
                             PhaseTangent phase_tangent, int q)
{
  const double l0 = model.length_scale, Gc = data.toughness[q];
  const double local =
      phase_tangent == PhaseTangent::consistent
          ? branch::stiffness(model.degradation, model.crack_density, p.driving, p.phi, Gc, l0)
          : branch::switched_stiffness(model.degradation, model.crack_density, p.driving, p.phi, Gc, l0);
  return data.geometry.reference[q].dA * (local + Gc / l0 * model.irreversibility.resistance_stiffness(history, p.phi));
}

/// What the derivatives of N_A and N_B have in it.
template <class Model>
std::array<DerivativePack, n_derivatives> phase_gradient_stiffness(const Model &model, const ElementData<Model> &data,
                                                                   int q)
{
  const double l0        = model.length_scale;
  const auto  &reference = data.geometry.reference[q];
  const double stiffness = data.toughness[q] / (2. * l0) * reference.dA;
  return phase_stiffness(reference, stiffness * model.crack_density.c1(l0), stiffness * model.crack_density.c2(l0));
}

} // namespace internal

template <Unknowns part, class Model>
void element_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                   const double *history, ElementVector<Model> &force)
{
  static_assert(has_displacement(part), "the phase alone: element_phase_force");
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  internal::ForceSum<Model>                 sum;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto p     = evaluate_point(model, data, interpolation.at(s, q), history[q], q);
      const auto total = data.geometry.reference[q].dA * degraded_stress(p.response, model.degradation.value(p.phi));
      internal::add_point_force<part>(model, data, s, p, total, q, sum);
    }
  sum.store(force);
}

template <class Model>
void element_phase_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                         const double *history, const double *energy, ElementVector<Model> &force)
{
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  internal::ForceSum<Model>                 sum;
  for (int q = 0; q < s.n_points; ++q)
    {
      const auto p = evaluate_phase(model, data, interpolation.at(s, q), history[q], energy[q], q);
      internal::add_point_force<Unknowns::phase>(model, data, s, p, Stress<Model::spacedim>::zero(), q, sum);
    }
  sum.store(force);
}

template <class Model, Unknowns part>
void element_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                     const double *history, double mass_weight, PhaseTangent phase_tangent, ElementVector<Model> &force,
                     ElementMatrix<Model, part> &matrix)
{
  static_assert(has_displacement(part), "the phase alone: element_phase_tangent");
  using Tables = internal::TangentTables<Model, part>;
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  internal::ForceSum<Model>                 sum;
  Tables                                    tables(data.geometry);

  for (int first_point = 0; first_point < s.n_points; first_point += Tables::n_points)
    {
      tables.begin(s, first_point);
      for (int k = 0; k < Tables::n_points; ++k)
        {
          const int    q     = first_point + k;
          const auto   p     = evaluate_point(model, data, interpolation.at(s, q), history[q], q);
          const double dA    = data.geometry.reference[q].dA;
          const double g     = model.degradation.value(p.phi);
          const auto   total = dA * degraded_stress(p.response, g);
          internal::add_point_force<part>(model, data, s, p, total, q, sum);

          const double kappa = internal::phase_value_stiffness(model, data, p, history[q], phase_tangent, q);
          internal::PointSlope<Model::spacedim> coupling{}, driving{};
          if constexpr (part == Unknowns::all)
            {
              const double g1      = model.degradation.first(p.phi);
              const bool   loading = model.irreversibility.is_loading(history[q], p.response.energy_active);
              coupling             = internal::point_slope(p.frame, dA * g1 * p.response.stress_active);
              driving              = internal::point_slope(p.frame, (loading ? dA * g1 : 0.) * p.response.driving);
            }
          tables.set(k, p.frame, dA * degraded_tangent(p.response, g), total,
                     internal::phase_gradient_stiffness(model, data, q), kappa, mass_weight * model.mass * dA, coupling,
                     driving);
        }
      tables.multiply();
    }
  sum.store(force);
  tables.store(matrix);
}

template <class Model>
void element_phase_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                           const double *history, const double *energy, PhaseTangent phase_tangent,
                           ElementVector<Model> &force, ElementMatrix<Model, Unknowns::phase> &matrix)
{
  using Tables = internal::TangentTables<Model, Unknowns::phase>;
  std::optional<ShapeValues<Model::degree>> storage;
  const auto                               &s = data.geometry.shapes(storage);
  const FieldInterpolation<Model>           interpolation(fields);
  internal::ForceSum<Model>                 sum;
  Tables                                    tables(data.geometry);
  for (int first_point = 0; first_point < s.n_points; first_point += Tables::n_points)
    {
      tables.begin(s, first_point);
      for (int k = 0; k < Tables::n_points; ++k)
        {
          const int  q = first_point + k;
          const auto p = evaluate_phase(model, data, interpolation.at(s, q), history[q], energy[q], q);
          internal::add_point_force<Unknowns::phase>(model, data, s, p, Stress<Model::spacedim>::zero(), q, sum);
          tables.set(k, internal::phase_gradient_stiffness(model, data, q),
                     internal::phase_value_stiffness(model, data, p, history[q], phase_tangent, q));
        }
      tables.multiply();
    }
  sum.store(force);
  tables.store(matrix);
}

} // namespace sherd
